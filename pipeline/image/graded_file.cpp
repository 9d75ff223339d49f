#include "pipeline/image/graded_file.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include "pipeline/image/digest.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/image_formats.h"
#include "pipeline/image/late_digest.h"

namespace domefall {
namespace {

std::string_view bytes_of(const unsigned short* rgb, std::size_t count) {
  return {reinterpret_cast<const char*>(rgb), count * sizeof(unsigned short)};
}

std::string digest_of(const GradedFrame& frame) {
  return Digest().add(bytes_of(frame.pixels.data(), frame.pixels.size())).hex();
}

// One line for each field; a line break in a title would make two of one.
std::string description_of(const GradedInfo& info) {
  std::string title = info.title;
  for (char& c : title)
    if (c == '\n' || c == '\r') c = ' ';
  return "show: " + title + "\nframe: " + std::to_string(info.frame) +
         "\ndisplay: " + info.display + "\nview: " + info.view + "\nsoftware: " + info.software +
         "\nkey: " + info.key + LateDigest::line() + "\n";
}

std::map<std::string, std::string> lines_of(const std::string& description) {
  std::map<std::string, std::string> lines;
  std::istringstream in(description);
  for (std::string line; std::getline(in, line);)
    if (const auto colon = line.find(": "); colon != std::string::npos)
      lines[line.substr(0, colon)] = line.substr(colon + 2);
  return lines;
}

}  // namespace

void check_graded_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".png" && extension != ".tif" && extension != ".tiff")
    throw InputError(path.string() + ": graded frames are .png, .tif or .tiff");
}

struct GradedFile::State {
  std::filesystem::path path;
  NewFile file;
  LateDigest sink;
  std::unique_ptr<ImageWriter> writer;
  Digest digest;
  std::size_t row_values;

  State(const std::filesystem::path& p, int width)
      : path(p), file(p), sink(file), row_values(3 * static_cast<std::size_t>(width)) {}

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
  state_ = std::make_unique<State>(path, width);
  State& s = *state_;
  s.encode([&] { s.writer = formats.create(path, s.sink, width, height, description_of(info)); });
  s.digest.add_length(sizeof(unsigned short) * s.row_values * static_cast<std::size_t>(height));
}

GradedFile::~GradedFile() = default;

void GradedFile::add(const unsigned short* rgb, int count) {
  State& s = *state_;
  s.digest.add_piece(bytes_of(rgb, s.row_values * static_cast<std::size_t>(count)));
  s.encode([&] { s.writer->write(rgb, count); });
}

void GradedFile::finish() {
  State& s = *state_;
  s.encode([&] { s.writer->close(); });
  s.sink.fill_in(s.digest.hex());
  s.file.commit();
}

void write_graded(const std::filesystem::path& path, const GradedFrame& frame,
                  const GradedInfo& info) {
  GradedFile file(path, frame.width, frame.height, info);
  for (int row = 0; row < frame.height; row += GradedFile::kRows)
    file.add(frame.row(row), std::min(GradedFile::kRows, frame.height - row));
  file.finish();
}

FrameCondition examine_graded(const std::filesystem::path& path, const std::string& key, int width,
                              int height) {
  if (!std::filesystem::exists(path)) return FrameCondition::kMissing;
  const ImageFormats& formats = image_formats();
  try {
    const auto in = formats.open(path);
    const ImageLayout& layout = in->layout();
    const auto lines = lines_of(layout.description);
    if (!lines.contains("key") || !lines.contains("pixels")) return FrameCondition::kDamaged;
    if (lines.at("key") != key || layout.width != width || layout.height != height ||
        layout.channels != 3 || layout.samples != SampleType::kUint16)
      return FrameCondition::kStale;
    GradedFrame frame(width, height);
    in->read(frame.pixels.data());
    return digest_of(frame) == lines.at("pixels") ? FrameCondition::kGood
                                                  : FrameCondition::kDamaged;
  } catch (const std::runtime_error&) {
    return FrameCondition::kDamaged;
  }
}

}  // namespace domefall
