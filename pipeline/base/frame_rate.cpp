#include "pipeline/base/frame_rate.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numeric>

namespace domefall {
namespace {

// No fraction whose denominator is as small or smaller is nearer than a convergent of the continued
// fraction.
FrameRate nearest_fraction(double value) {
  constexpr double kTolerance = 1e-12;
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

// Says whether a number is another one with fewer digits: rounded, or cut off, behind its second to
// sixth decimal, or better known than that.
bool is_written_for(double written, double meant) {
  constexpr double kSame = 1e-9, kFine = 2e-6;
  if (std::abs(written / meant - 1) <= kFine) return true;
  for (double scale = 1e2; scale <= 1e6; scale *= 10)
    if (std::abs(written - std::round(meant * scale) / scale) < kSame ||
        std::abs(written - std::floor(meant * scale) / scale) < kSame)
      return true;
  return false;
}

}  // namespace

FrameRate frame_rate_of(double frames_per_second) {
  constexpr double kNtsc = 1.001;
  const std::int64_t whole = std::llround(frames_per_second * kNtsc);
  const bool usual = whole % 24 == 0 || whole % 30 == 0;
  if (!usual || !is_written_for(frames_per_second, static_cast<double>(whole) / kNtsc))
    return nearest_fraction(frames_per_second);
  const std::int64_t common = std::gcd(whole * 1000, std::int64_t{1001});
  return {whole * 1000 / common, 1001 / common};
}

FrameRate parse_frame_rate(const std::string& text) {
  FrameRate rate{0, 0};
  const char *end = text.data() + text.size(), *at = text.data();
  const auto take = [&](std::int64_t& number) {
    const auto [after, error] = std::from_chars(at, end, number);
    at = after;
    return error == std::errc() && number > 0;
  };
  if (!take(rate.frames) || at == end || *at++ != '/' || !take(rate.seconds) || at != end)
    return {0, 0};
  const std::int64_t common = std::gcd(rate.frames, rate.seconds);
  return {rate.frames / common, rate.seconds / common};
}

double per_second(const FrameRate& rate) {
  return static_cast<double>(rate.frames) / static_cast<double>(rate.seconds);
}

std::string text_of(const FrameRate& rate) {
  return rate.seconds == 1 ? fmt::to_string(rate.frames)
                           : fmt::format("{}/{}", rate.frames, rate.seconds);
}

std::string rate_text(const FrameRate& rate) {
  if (rate.seconds == 1) return text_of(rate);
  return fmt::format("{:.6g} ({})", per_second(rate), text_of(rate));
}

double duration_of(std::int64_t frames, const FrameRate& rate) {
  return static_cast<double>(frames) * static_cast<double>(rate.seconds) /
         static_cast<double>(rate.frames);
}

}  // namespace domefall
