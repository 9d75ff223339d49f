#include "pipeline/python/show_object.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "pipeline/image/errors.h"
#include "pipeline/python/interruptible.h"
#include "pipeline/python/record_array.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/render/rendered_frame.h"
#include "pipeline/show/frame_size.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/read_show.h"
#include "pipeline/show/show_time.h"
#include "pipeline/show/state_columns.h"

namespace py = pybind11;

namespace domefall {
namespace {

constexpr int kMostThreads = 1024;

// Returns an integer of Python or numpy.  One beyond the range of Py_ssize_t becomes its end.
// Raises TypeError for anything else.
long long whole_number(const py::handle& value) {
  const py::ssize_t number = PyNumber_AsSsize_t(value.ptr(), nullptr);
  if (number == -1 && PyErr_Occurred()) throw py::error_already_set();
  return number;
}

int frame_number(const Show& show, long long number) {
  const int count = frame_count(show);
  if (number < 0 || number >= count)
    throw InputError(fmt::format("frame {}: the show has {} frames, the first is 0, the last is {}",
                                 number, count, count - 1));
  return static_cast<int>(number);
}

// Returns a size in the form that --size takes.
std::string size_text(const py::object& size) {
  if (size.is_none()) return {};
  if (py::isinstance<py::str>(size)) return size.cast<std::string>();
  if (!py::isinstance<py::sequence>(size)) return fmt::to_string(whole_number(size));
  const auto sides = py::reinterpret_borrow<py::sequence>(size);
  if (sides.size() != 2)
    throw InputError(fmt::format(
        "size must be a number of pixels, (width, height) or a text such as '4k', got {}",
        std::string(py::repr(size))));
  return fmt::format("{}x{}", whole_number(sides[0]), whole_number(sides[1]));
}

struct WantedStates {
  std::vector<int> frames;
  std::vector<py::ssize_t> shape;
};

WantedStates wanted_states(const Show& show, const py::object& frames) {
  WantedStates wanted;
  if (frames.is_none()) {
    wanted.shape = {frame_count(show)};
    for (int n = 0; n < frame_count(show); ++n) wanted.frames.push_back(n);
    return wanted;
  }
  const py::array given = py::array::ensure(frames);
  if (!given) throw py::error_already_set();
  // A list without elements becomes an array of floats in numpy.
  const char kind = given.dtype().kind();
  if (kind != 'i' && kind != 'u' && given.size() > 0)
    throw py::type_error(fmt::format("frames must be integers, got an array of {}",
                                     std::string(py::str(given.dtype()))));
  for (const py::handle number : given.attr("ravel")().attr("tolist")())
    wanted.frames.push_back(frame_number(show, whole_number(number)));
  wanted.shape.assign(given.shape(), given.shape() + given.ndim());
  return wanted;
}

// Any state of the show tells what kind of cells each column has.
std::vector<RecordColumn> state_record(const Show& show) {
  const auto cells = state_cells(frame_state(show, 0));
  std::vector<RecordColumn> columns;
  for (std::size_t k = 0; k < cells.size(); ++k)
    columns.push_back({kStateColumns[k], std::holds_alternative<int>(cells[k]) ? CellKind::kCount
                                         : std::holds_alternative<StateNumber>(cells[k])
                                             ? CellKind::kNumber
                                             : CellKind::kText});
  return columns;
}

void add_cell(RecordArray& records, const StateCell& cell) {
  if (const auto* count = std::get_if<int>(&cell))
    records.add(*count);
  else if (const auto* number = std::get_if<StateNumber>(&cell))
    records.add(number->value);
  else
    records.add(std::string_view(std::get<const char*>(cell)));
}

// Returns an array of numpy that owns the picture's memory.
template <class T>
py::array picture_array(ImageRgb<T>&& picture) {
  auto kept = std::make_unique<ImageRgb<T>>(std::move(picture));
  const std::vector<py::ssize_t> shape{kept->height, kept->width, 3};
  const T* pixels = kept->pixels.data();
  const py::capsule owner(kept.get(), [](void* held) { delete static_cast<ImageRgb<T>*>(held); });
  (void)kept.release();
  return py::array_t<T>(shape, pixels, owner);
}

}  // namespace

// A later change of the working directory must not move the show's assets.
ShowObject::ShowObject(const std::filesystem::path& file, int threads)
    : show_(interruptible(
          [&](const std::atomic<bool>&) { return read_show(std::filesystem::absolute(file)); })),
      threads_(threads) {
  if (threads < 0 || threads > kMostThreads)
    throw InputError(fmt::format("threads must be from 0 to {}, got {}", kMostThreads, threads));
}

py::array ShowObject::states(const py::object& frames) const {
  const WantedStates wanted = wanted_states(show_, frames);
  RecordArray records(state_record(show_), wanted.shape);
  interruptible([&](const std::atomic<bool>& stop) {
    for (std::size_t k = 0; k < records.size() && !stop; ++k) {
      records.start(k);
      for (const StateCell& cell : state_cells(frame_state(show_, wanted.frames[k])))
        add_cell(records, cell);
    }
  });
  return records.array();
}

FrameState ShowObject::state_of(const py::object& number, const py::object& size) const {
  const int frame = frame_number(show_, whole_number(number));
  const std::string text = size_text(size);
  if (text.empty()) return frame_state(show_, frame);
  Show show = show_;
  show.projection = resized(show_.projection, text, "size");
  return frame_state(show, frame);
}

void ShowObject::with_renderer(const std::atomic<bool>& stop,
                               const std::function<void(Renderer&)>& use) {
  std::unique_lock turn(turn_, std::defer_lock);
  while (!turn.try_lock_for(std::chrono::milliseconds(50)))
    if (stop) throw RenderStopped{};
  if (!renderer_) renderer_.emplace(show_, threads_);
  renderer_->stop_when(&stop);
  try {
    use(*renderer_);
  } catch (...) {
    renderer_->stop_when(nullptr);
    throw;
  }
  renderer_->stop_when(nullptr);
}

py::array ShowObject::frame(const py::object& number, const py::object& size) {
  const FrameState state = state_of(number, size);
  return picture_array(interruptible([&](const std::atomic<bool>& stop) {
    FloatImage picture;
    with_renderer(stop, [&](Renderer& renderer) { renderer.render(state, picture); });
    return picture;
  }));
}

py::array ShowObject::graded(const py::object& number, const py::object& size) {
  const FrameState state = state_of(number, size);
  return picture_array(interruptible([&](const std::atomic<bool>& stop) {
    GradedFrame picture;
    with_renderer(stop, [&](Renderer& renderer) {
      if (!grader_) grader_.emplace(show_.grade);
      if (!grading_) grading_.emplace(*grader_, renderer.threads());
      RenderedFrame frame;
      render_for_files(renderer, show_, state, frame);
      grading_->grade(frame.half, state, [&](const RowPicture& rows) {
        picture = GradedFrame(rows.width, rows.height);
        rows.rows(0, rows.height, picture.row(0));
      });
    });
    return picture;
  }));
}

}  // namespace domefall
