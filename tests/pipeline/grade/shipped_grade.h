// Grades of the shipped configuration, of one pixel or of all greys.
#pragma once

#include <array>
#include <string>

#include "pipeline/grade/grader.h"
#include "tests/source_tree.h"

namespace domefall {

inline const std::string kConfig = source_file("shows/assets/dome.ocio");
inline constexpr const char* kDisplays[] = {
    "Dome G2.2 Rec.709", "Dome G2.6 P3-D65", "sRGB - Display",    "Rec.1886 Rec.709 - Display",
    "Dome G2.4 Rec.709", "Dome G2.6 DCI-P3", "Dome G2.4 Rec.2020"};
inline constexpr const char* kViews[] = {"Dome", "ACES SDR", "Star field", "Un-tone-mapped", "Raw"};

inline GradeSettings settings(const std::string& view, const std::string& display = kDisplays[0]) {
  return {.config = kConfig, .shipped = true, .display = display, .view = view};
}

using Triple = std::array<double, 3>;

inline HalfFrame one_pixel(const Triple& rgb) {
  HalfFrame frame(1, 1);
  for (std::size_t c = 0; c < 3; ++c) frame.pixels[c] = static_cast<float>(rgb[c]);
  return frame;
}

inline Triple graded(const GradeSettings& s, const Triple& rgb) {
  const GradedFrame out = Grader(s).grade(one_pixel(rgb));
  return {out.pixels[0] / 65535.0, out.pixels[1] / 65535.0, out.pixels[2] / 65535.0};
}

inline Triple graded(const GradeSettings& s, double grey) {
  return graded(s, Triple{grey, grey, grey});
}

// Every half from 0 to the largest finite, as greys.
inline HalfFrame all_greys() {
  HalfFrame frame(0x7c00, 1);
  for (int bits = 0; bits < 0x7c00; ++bits)
    for (int c = 0; c < 3; ++c)
      frame.pixels[static_cast<std::size_t>(3 * bits + c)].setBits(
          static_cast<unsigned short>(bits));
  return frame;
}

}  // namespace domefall
