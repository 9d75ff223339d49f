// The fixture of the tests of what show files mean.
#pragma once

#include <cmath>

#include "tests/pipeline/show/show_file.h"
#include "trajectories/degree.h"

namespace domefall {

class ShowKeys : public ShowFile {
 protected:
  // Reads a show with one segment and further lines.
  Show with(const std::string& more, const std::string& trajectory = "{type: infall, from_r: 30}",
            const std::string& hole = "{mass_solar: 4e6}") {
    return read("black_hole: " + hole +
                "\ntimeline:\n  - {duration_s: 10, trajectory: " + trajectory + "}\n" + more);
  }
  Segment segment(const std::string& trajectory, const std::string& hole = "{mass_solar: 4e6}") {
    return with("", trajectory, hole).timeline.at(0);
  }
  // The celerity of a segment of type `velocity`.
  V3d celerity(const std::string& keys, const std::string& hole = "{mass_solar: 4e6}") {
    return std::get<GivenVelocity>(segment("{type: velocity, " + keys + "}", hole).trajectory)
        .celerity;
  }
  std::filesystem::path asset(const std::string& name) { return folder_ / "assets" / name; }
};

// A .stars file rounds the components of directions to 2^-31.
inline constexpr double kStarPlace = 1e-9;

// This allows for products and quotients of a few rounded numbers.
inline void expect_near(const V3d& a, const V3d& b, double tolerance = 1e-14) {
  EXPECT_LE((a - b).length(), tolerance * std::max(1.0, b.length())) << a << " and " << b;
}

inline SkyDirection place(double ra_deg, double dec_deg) {
  const double ra = ra_deg * kDegree, dec = dec_deg * kDegree;
  return {V3d(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec))};
}

}  // namespace domefall
