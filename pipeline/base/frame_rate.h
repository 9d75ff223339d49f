// A FrameRate is a show's frames per second as the fraction that video counts in.
#pragma once

#include <cstdint>
#include <string>

namespace domefall {

struct FrameRate {
  std::int64_t frames = 30, seconds = 1;  // positive, without a common factor

  bool operator==(const FrameRate&) const = default;
};

// Takes 1 <= frames_per_second <= 1000.  Decimals such as 23.976, 23.98, 29.97 and 59.94 stand for
// the rates of NTSC.  So what is n 1000/1001, n being a multiple of 24 or 30, within 2e-6, or
// rounded to two decimals or more, becomes that rate.  Otherwise it becomes the first convergent of
// the number's continued fraction that is within 1e-12 of the number, which is any fraction of
// numbers up to a million.
FrameRate frame_rate_of(double frames_per_second);

// Returns the fraction of a text such as 24000/1001, or 0/0 for any other text.
FrameRate parse_frame_rate(const std::string& text);

double per_second(const FrameRate& rate);

// Returns "30" or "24000/1001", as ffmpeg reads it.
std::string text_of(const FrameRate& rate);

// Returns "30", or "29.97 (30000/1001)".
std::string rate_text(const FrameRate& rate);

// Returns the time that so many frames take, in seconds.
double duration_of(std::int64_t frames, const FrameRate& rate);

}  // namespace domefall
