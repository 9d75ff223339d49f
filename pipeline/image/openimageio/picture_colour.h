// A PictureColour turns the numbers of a picture into light, by what its file says of them.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/image/image_formats.h"
#include "pipeline/image/openimageio/picture_claims.h"

namespace domefall {

class PictureColour {
 public:
  // What a PNG says counts in the order cICP, iCCP, sRGB, gAMA and cHRM (PNG, third edition, 4.3).
  // What no file says is taken as sRGB for integers and as linear Rec.709 for floats.  An encoding
  // that the user gives counts instead of the file's and of its profile.  `profile` are the bytes
  // of an ICC profile, where the claims have one.  Throws std::runtime_error with the reason if
  // the file says what cannot be obeyed.
  PictureColour(const PictureClaims& claims, const std::string& profile, PixelEncoding encoding,
                bool is_floating, int colours);

  // Reads `pixels` pixels of `colours` samples, followed by alpha if has_alpha, and writes light
  // in linear RGB.  Alpha is multiplied in, so that the picture lies over black.
  void light(const float* samples, std::size_t pixels, bool has_alpha, float* rgb) const;

  // CIE x, y of red, green, blue and white.
  const std::array<double, 8>& xy() const { return xy_; }
  // Says whether light is what is stored, but for alpha.
  bool is_plain() const { return curve_ == Curve::kLinear && !transform_ && is_unscaled(); }
  // Say how values are taken and which primaries they have, for people.
  const std::vector<std::string>& words() const { return words_; }

 private:
  bool is_unscaled() const { return scale_ == std::array{1.0f, 1.0f, 1.0f}; }
  enum class Curve { kLinear, kSrgb, kPower, kRec709 };
  void take_code_points(const CodePoints& code);
  void take_profile(const std::string& bytes);
  void take_curve(const PictureClaims& claims, PixelEncoding encoding, bool is_floating);
  void take_primaries(const PictureClaims& claims);
  float linear(float value) const;
  void colours(const float* samples, std::size_t pixels, std::size_t step, float* rgb) const;

  int colours_;
  Curve curve_ = Curve::kSrgb;
  float exponent_ = 1;                                 // of kPower
  std::shared_ptr<void> transform_;                    // of Little CMS, to linear ACEScg
  bool is_grey_profile_ = false, is_bounded_ = false;  // of values from 0 to 1 alone
  std::array<double, 8> xy_;
  std::array<float, 3> scale_;
  Alpha alpha_;
  std::vector<std::string> words_;
};

}  // namespace domefall
