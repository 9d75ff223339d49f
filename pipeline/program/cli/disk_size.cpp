#include <fmt/format.h>

#include "pipeline/program/cli/check_page.h"

namespace domefall {
namespace {

// Returns the size of a pixel without any compression.
double pixel_bytes(GradedKind kind) {
  constexpr double kBytes16 = 6, kBytes8 = 3;
  return kind == GradedKind::kPng16 || kind == GradedKind::kTiff16 ? kBytes16 : kBytes8;
}

}  // namespace

DiskSize disk_size(const CheckReport& report) {
  const Show& show = report.show;
  constexpr double kHalfPixel = 6, kFloatPixel = 12;
  const double pixels = 1.0 * columns(show.projection) * rows(show.projection);
  DiskSize size;
  size.frames = frame_count(show);
  size.measured = report.time.has_value();
  if (report.time) {
    size.linear = report.time->linear_bytes, size.graded = report.time->graded_bytes;
    return size;
  }
  if (const auto& linear = show.output.linear)
    size.linear = (linear->pixels == ExrPixels::kFloat ? kFloatPixel : kHalfPixel) * pixels;
  if (show.output.graded) size.graded = pixel_bytes(show.output.graded->kind) * pixels;
  return size;
}

std::string lack_of_room(const CheckReport& report) {
  const DiskSize size = disk_size(report);
  if (!report.room || size.total() <= report.room->free + report.room->taken) return {};
  return fmt::format(
      "all {} frames take {} {}, and the disk of {} has {} free; another --out, or an output that "
      "keeps less (linear: none; graded: png8 or jpeg), will do",
      size.frames, size.measured ? "about" : "at most", bytes_text(size.total()),
      report.room->folder.string(), bytes_text(report.room->free));
}

}  // namespace domefall
