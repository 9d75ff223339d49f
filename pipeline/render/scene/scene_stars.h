// Holds the stars of one sky as columns of numbers, in the units in which their images are
// computed.
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {

// A SceneStar is one star as it is without any redshift.
struct SceneStar {
  SkyDirection direction;
  double magnitude;       // V
  double flux;            // bolometric, W/m^2
  double temperature;     // K
  double angular_radius;  // radians; that of a blackbody of this flux and temperature
};

// The stars are sorted by magnitude, brightest first.  Directions are rounded to floats, by up to
// 6e-8 radians, which is less than the error of catalogues and the same in every frame.
class SceneStars {
 public:
  SceneStars() = default;
  // Takes stars in any order.
  explicit SceneStars(const std::vector<Star>& stars);
  explicit SceneStars(std::vector<SceneStar> stars);

  std::size_t size() const { return magnitude_.size(); }
  bool empty() const { return magnitude_.empty(); }
  SceneStar operator[](std::size_t k) const;
  // Returns the number of stars with V <= limit, which are the first ones.
  std::size_t count_to_magnitude(double limit) const;
  // Returns an upper bound of the flux of the star `first` and of each one that follows it.
  double most_flux_from(std::size_t first) const { return most_flux_[first / kBlock]; }

  double most_angular_radius() const { return most_angular_radius_; }

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
  void find_bounds();

  std::vector<float> x_, y_, z_, magnitude_, flux_, temperature_, angular_radius_;
  std::vector<double> most_flux_;  // of each block of kBlock stars and all that follow
  double most_angular_radius_ = 0;
};

// Gives the length 1 again, within 2e-14, to a unit vector whose components were rounded to floats.
// This is one step of Newton's iteration for 1/sqrt(length2), which leaves an error of 3/8 of the
// square of the error of length2.
inline V3d renormalized(const V3d& v) { return v * (1.5 - 0.5 * v.length2()); }

}  // namespace domefall
