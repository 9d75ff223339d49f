#include <fmt/format.h>

#include "pipeline/program/cli/check_page.h"
#include "pipeline/render/rendered_frame.h"

namespace domefall {
namespace {

// Returns the size of a pixel without any compression.
double graded_pixel_bytes(const GradedFormat& format) {
  const bool wide = format.kind == GradedKind::kPng16 || format.kind == GradedKind::kTiff16;
  return (wide ? 2 : 1) * (format.alpha ? 4 : 3);
}

}  // namespace

DiskSize disk_size(const CheckReport& report) {
  const Show& show = report.show;
  // These are the most that a file has beside its pixels: its header, and for each row where it
  // stands and how long it is.
  constexpr double kHeader = 8192, kRow = 16;
  const double height = rows(show.projection), pixels = columns(show.projection) * height;
  const auto files = [&](std::size_t count, double pixel_bytes) {
    return pixel_bytes * pixels + static_cast<double>(count) * (kHeader + kRow * height);
  };
  DiskSize size;
  size.frames = frame_count(show);
  size.measured = report.time.has_value();
  if (report.time) {
    size.linear = report.time->linear_bytes, size.graded = report.time->graded_bytes;
    return size;
  }
  const Output& output = show.output;
  if (output.linear)
    size.linear = files(1 + (output.layer_files ? output.layers.size() : 0),
                        static_cast<double>(linear_pixel_bytes(show)));
  if (output.graded) size.graded = files(1, graded_pixel_bytes(*output.graded));
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
