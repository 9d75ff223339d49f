// A BlackbodyTable has the light of blackbodies by temperature.  It is fast enough for millions of
// stars in each frame, because its intervals are found from the bits of the temperature, without
// the logarithm that BlackbodyColours takes.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace domefall {

class BlackbodyTable {
 public:
  // A Light is the working-space light of a unit of bolometric flux, and its luminance, in lm/W.
  struct Light {
    float r, g, b, luminance;
  };

  // Interpolates blackbody_colours() at any temperature >= 0.  The measured relative error is below
  // 1e-4 above 3000 K, and below 4e-4 above 1000 K.
  Light operator()(double temperature) const {
    // The key holds the exponent and the first kBits of the mantissa.  Between two keys the
    // temperature grows linearly with the rest of the bits, which become the weight w.  A key below
    // the table wraps around to a large number.
    const auto bits = std::bit_cast<std::uint64_t>(temperature);
    const std::uint64_t key = bits >> kShift;
    if (key - first_ >= lights_.size() - 1) return beyond_table(temperature);
    const Light &a = lights_[key - first_], &b = lights_[key - first_ + 1];
    const auto w = static_cast<float>(bits & ((std::uint64_t{1} << kShift) - 1)) *
                   (1.0f / static_cast<float>(std::uint64_t{1} << kShift));
    return {a.r + w * (b.r - a.r), a.g + w * (b.g - a.g), a.b + w * (b.b - a.b),
            a.luminance + w * (b.luminance - a.luminance)};
  }

  // Returns the largest luminance of a unit of flux at any temperature, in lm/W.
  double most_luminance() const { return most_; }

 private:
  friend const BlackbodyTable& blackbody_table();
  BlackbodyTable();
  static Light beyond_table(double temperature);

  static constexpr int kBits = 9;  // 512 intervals in each octave
  static constexpr int kShift = 52 - kBits;
  std::uint64_t first_;
  std::vector<Light> lights_;
  double most_ = 0;
};

const BlackbodyTable& blackbody_table();

}  // namespace domefall
