#include "pipeline/program/python/show_object.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"
#include "pipeline/program/python/arguments.h"
#include "pipeline/program/python/record_array.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/render/rendered_frame.h"
#include "pipeline/show/file/frame_size.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/state_columns.h"

namespace py = pybind11;

namespace domefall {
namespace {

constexpr int kMostThreads = 1024;

std::optional<int> number_of(const std::string& digits) {
  int number = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

int thread_number(const py::object& threads) {
  const std::string digits = digits_of(threads);
  const int number = number_of(digits).value_or(-1);
  if (number < 0 || number > kMostThreads)
    throw InputError(fmt::format("threads must be from 0 to {}, got {}", kMostThreads, digits));
  return number;
}

int frame_number(const Show& show, const py::handle& frame) {
  const int count = frame_count(show);
  const std::string digits = digits_of(frame);
  const int number = number_of(digits).value_or(-1);
  if (number < 0 || number >= count)
    throw InputError(fmt::format("frame {}: the show has {} frames, the first is 0, the last is {}",
                                 digits, count, count - 1));
  return number;
}

// Returns the path of a str, bytes or os.PathLike.  Raises TypeError for anything else.
std::filesystem::path path_of(const py::object& file) {
  PyObject* bytes = nullptr;
  if (!PyUnicode_FSConverter(file.ptr(), &bytes)) {
    if (!PyErr_ExceptionMatches(PyExc_ValueError)) throw py::error_already_set();
    const py::error_already_set error;  // of a null character, or one that no file name has
    throw InputError(fmt::format("file {} is no path: {}", utf8_text(py::repr(file)),
                                 utf8_text(py::str(error.value()))));
  }
  const std::string path = py::reinterpret_steal<py::bytes>(bytes);
  if (path.empty()) throw InputError("file must be the path of a show, got an empty one");
  refuse_control_characters(path, "file ");
  return path;
}

std::optional<std::string> size_text(const py::object& size) {
  if (size.is_none()) return std::nullopt;
  const auto fail = [&] {
    throw InputError(fmt::format(
        "size must be a number of pixels, (width, height) or a text such as '4k', got {}",
        shown(utf8_text(py::repr(size)))));
  };
  if (py::isinstance<py::str>(size)) {
    const std::string text = shown(utf8_text(size));
    if (text.empty()) fail();
    return text;
  }
  // Bytes are a sequence of integers, too.
  if (!py::isinstance<py::sequence>(size) || py::isinstance<py::bytes>(size) ||
      py::isinstance<py::bytearray>(size))
    return digits_of(size);
  const py::list sides(size);
  if (sides.size() != 2) fail();
  return digits_of(sides[0]) + 'x' + digits_of(sides[1]);
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
  // A list without elements becomes an array of floats in numpy, and one with integers of more than
  // 64 bits an array of objects.
  const char kind = given.dtype().kind();
  if (kind != 'i' && kind != 'u' && kind != 'O' && given.size() > 0)
    throw py::type_error(fmt::format("frames must be integers, got an array of {}",
                                     std::string(py::str(given.dtype()))));
  for (const py::handle number : given.attr("ravel")().attr("tolist")())
    wanted.frames.push_back(frame_number(show, number));
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
ShowObject::ShowObject(const py::object& file, const py::object& threads)
    : threads_(thread_number(threads)),
      show_(interruptible([path = path_of(file)](const std::atomic<bool>&) {
        return read_show(std::filesystem::absolute(path));
      })) {}

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
  const int frame = frame_number(show_, number);
  const auto text = size_text(size);
  if (!text) return frame_state(show_, frame);
  Show show = show_;
  show.projection = resized(show_.projection, *text, "size");
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
      RenderedFrame frame(show_);
      render_for_files(renderer, show_, state, frame);
      grading_->grade(frame.half.picture, state, [&](const RowPicture& rows) {
        picture = GradedFrame(rows.width, rows.height);
        rows.rows(0, rows.height, picture.row(0));
      });
    });
    return picture;
  }));
}

}  // namespace domefall
