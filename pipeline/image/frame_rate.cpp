#include "pipeline/image/frame_rate.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace domefall {
namespace {

// No fraction whose denominator is as small or smaller is nearer than a convergent of the continued
// fraction.
FrameRate nearest_fraction(double value) {
  constexpr double kTolerance = 1e-9;
  FrameRate before{1, 0};
  FrameRate now{std::llround(std::floor(value)), 1};
  double rest = value - std::floor(value);
  while (std::abs(static_cast<double>(now.frames) / static_cast<double>(now.seconds) - value) >
         kTolerance * value) {
    const double inverse = 1 / rest;
    const std::int64_t whole = std::llround(std::floor(inverse));
    const FrameRate next{whole * now.frames + before.frames, whole * now.seconds + before.seconds};
    before = now, now = next;
    rest = inverse - std::floor(inverse);
  }
  return now;
}

}  // namespace

FrameRate frame_rate_of(double frames_per_second) {
  constexpr double kNtsc = 1.001, kTolerance = 2e-6;
  const std::int64_t whole = std::llround(frames_per_second * kNtsc);
  const bool usual = whole % 24 == 0 || whole % 30 == 0;
  if (usual && std::abs(frames_per_second * kNtsc / static_cast<double>(whole) - 1) <= kTolerance) {
    const std::int64_t common = std::gcd(whole * 1000, std::int64_t{1001});
    return {whole * 1000 / common, 1001 / common};
  }
  return nearest_fraction(frames_per_second);
}

std::string text_of(const FrameRate& rate) {
  return rate.seconds == 1 ? fmt::to_string(rate.frames)
                           : fmt::format("{}/{}", rate.frames, rate.seconds);
}

double duration_of(std::int64_t frames, const FrameRate& rate) {
  return static_cast<double>(frames) * static_cast<double>(rate.seconds) /
         static_cast<double>(rate.frames);
}

}  // namespace domefall
