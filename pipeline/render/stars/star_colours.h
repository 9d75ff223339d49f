// The light of thermal stars by temperature, for millions of look-ups a frame: the table's interval
// comes from the temperature's bits.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace domefall {

class StarColours {
 public:
  // Working-space light per unit of bolometric flux (lm/W), and its luminance.
  struct Light {
    float r, g, b, luminance;
  };

  // blackbody_colours(), interpolated once more.  Measured: within 1e-4 of it above 3000 K, 4e-4
  // above 1000 K.  Any temperature >= 0.
  Light operator()(double temperature) const {
    const auto bits = std::bit_cast<std::uint64_t>(temperature);
    const std::uint64_t key = bits >> kShift;
    if (key - first_ >= table_.size() - 1) return outside(temperature);
    const Light &a = table_[key - first_], &c = table_[key - first_ + 1];
    const auto w = static_cast<float>(bits & ((std::uint64_t{1} << kShift) - 1)) *
                   (1.0f / static_cast<float>(std::uint64_t{1} << kShift));
    return {a.r + w * (c.r - a.r), a.g + w * (c.g - a.g), a.b + w * (c.b - a.b),
            a.luminance + w * (c.luminance - a.luminance)};
  }

  // No temperature has more luminance per flux: lm/W.
  double most_luminance() const { return most_; }

 private:
  friend const StarColours& star_colours();
  StarColours();
  static Light outside(double temperature);

  static constexpr int kBits = 9;  // 512 intervals an octave
  static constexpr int kShift = 52 - kBits;
  std::uint64_t first_;
  std::vector<Light> table_;
  double most_ = 0;
};

const StarColours& star_colours();

}  // namespace domefall
