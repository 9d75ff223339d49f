// The stars of one sky, ready to be shifted.
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/sky/catalogue/star_catalogue.h"

namespace domefall {

// Bolometric flux (W/m^2) and temperature at no redshift.
struct SceneStar {
  SkyDirection direction;
  double magnitude;  // V
  double flux;
  double temperature;
  double angular_radius;  // radians, of a blackbody of this flux and temperature
};

// In columns, brightest first (smallest V).  Directions are rounded to floats: by 6e-8 rad, less than
// catalogues know them, the same in every frame.
class SceneStars {
 public:
  SceneStars() = default;
  // Of a catalogue's stars, in whatever order they come.
  explicit SceneStars(const std::vector<Star>& stars);
  explicit SceneStars(std::vector<SceneStar> stars);

  std::size_t size() const { return magnitude_.size(); }
  bool empty() const { return magnitude_.empty(); }
  SceneStar operator[](std::size_t k) const;
  // How many have V <= limit: the first ones.
  std::size_t brighter_than(double limit) const;
  // No star from `first` on, rounded down to a multiple of kBlock, has more flux than this.
  double most_flux_from(std::size_t first) const { return most_flux_[first / kBlock]; }

  static constexpr std::size_t kBlock = 256;

  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  const float* magnitude() const { return magnitude_.data(); }
  const float* flux() const { return flux_.data(); }
  const float* temperature() const { return temperature_.data(); }

 private:
  void reserve(std::size_t count);
  void push_back(const V3d& direction, double magnitude, double flux, double temperature);
  void find_most_flux();

  std::vector<float> x_, y_, z_, magnitude_, flux_, temperature_, angular_radius_;
  std::vector<double> most_flux_;  // by block
};

// Lengthens or shortens a vector that was rounded to floats to 1, within 2e-14.
inline V3d straightened(const V3d& v) { return v * (1.5 - 0.5 * v.length2()); }

}  // namespace domefall
