#include "pipeline/image/graded_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "pipeline/image/errors.h"
#include "pipeline/image/frame_head.h"
#include "pipeline/image/frame_seal.h"
#include "pipeline/image/image_formats.h"
#include "pipeline/image/new_file.h"

namespace domefall {
namespace {

// One line for each field.
std::string description_of(const GradedInfo& info) {
  return fmt::format("{}{}\nframe: {}\n{}{}\ndisplay: {}\nview: {}\nsoftware: {}\n{}{}\n{}{}\n",
                     kTitleLine, one_line(info.title), info.frame, kProjectionLine, info.projection,
                     one_line(info.display), one_line(info.view), info.software, kKeyLine, info.key,
                     kDigestLine, kBlankDigest);
}

// The file as an encoder sees it.
class Sink : public ImageSink {
 public:
  explicit Sink(NewFile& file) : file_(file) {}
  void write(std::string_view piece) override { file_.write(piece); }
  void seek(std::uint64_t position) override { file_.seek(position); }
  std::uint64_t position() const override { return file_.position(); }
  std::uint64_t size() const override { return file_.size(); }

 private:
  NewFile& file_;
};

}  // namespace

void check_graded_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".png" && extension != ".tif" && extension != ".tiff")
    throw InputError(path.string() + ": graded frames are .png, .tif or .tiff");
}

struct GradedFile::State {
  std::filesystem::path path;
  NewFile file;
  Sink sink;
  std::unique_ptr<ImageWriter> writer;

  explicit State(const std::filesystem::path& p) : path(p), file(p), sink(file) {}

  // Puts the file's name before the encoder's reason.
  template <class Step>
  void encode(Step step) {
    try {
      step();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(path.string() + ": " + error.what());
    }
  }
};

GradedFile::GradedFile(const std::filesystem::path& path, int width, int height,
                       const GradedInfo& info) {
  check_graded_name(path);
  const ImageFormats& formats = image_formats();
  state_ = std::make_unique<State>(path);
  State& s = *state_;
  s.encode([&] { s.writer = formats.create(path, s.sink, width, height, description_of(info)); });
}

GradedFile::~GradedFile() = default;

void GradedFile::add(const unsigned short* rgb, int count) {
  State& s = *state_;
  s.encode([&] { s.writer->write(rgb, count); });
}

void GradedFile::finish() {
  State& s = *state_;
  s.encode([&] { s.writer->close(); });
  seal_frame(s.file);
  s.file.commit();
}

void write_graded(const std::filesystem::path& path, const GradedFrame& frame,
                  const GradedInfo& info) {
  GradedFile file(path, frame.width, frame.height, info);
  for (int row = 0; row < frame.height; row += GradedFile::kRows)
    file.add(frame.row(row), std::min(GradedFile::kRows, frame.height - row));
  file.finish();
}

}  // namespace domefall
