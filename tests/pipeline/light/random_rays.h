// Random observers and rays of every kind: near and far, next to the horizon and the light circle,
// and rays down to 1e-15 radians off an edge.  The same in every run.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/ray_orbits.h"
#include "trajectories/directions.h"

namespace domefall {

inline V3d random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return V3d(normal(random), normal(random), normal(random)).normalized();
}

class RandomRays {
 public:
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  bool one_in(int n) { return unit() * n < 1; }
  double logarithmic(double low, double high) { return low * std::pow(high / low, unit()); }

  Radius radius() {
    if (one_in(2)) return logarithmic(1e-6, 1e8);
    const double off = logarithmic(1e-9, 1);
    return (one_in(2) ? 2 : 3) + (one_in(2) ? off : -off);
  }

  NullRay ray(const Radius& at, bool outgoing) {
    const RadialFrame frame{outgoing, false};
    const NullRay any = ray_at(at, std::numbers::pi * unit(), frame);
    if (one_in(3)) return any;
    const Critical edge = one_in(2) ? Critical::kFirst : Critical::kSecond;
    const double offset = logarithmic(1e-15, 0.1) * (one_in(2) ? 1 : -1);
    const double alpha = 2 * std::atan(tan_half_critical(at, edge)) + offset;
    return alpha > 0 && alpha < std::numbers::pi ? ray_off_edge(at, edge, offset, frame) : any;
  }

  // An angle on the ray's path: anywhere, near its beginning or near its end.
  double psi(const NullRay& ray) {
    const double phi = std::min(exact_azimuth(ray), 100.0);
    if (one_in(3)) return phi * unit();
    return phi * (one_in(2) ? logarithmic(1e-6, 1) : 1 - logarithmic(1e-4, 1));
  }

  // Rays of one observer, each with an angle on its path.
  struct Run {
    std::vector<NullRay> rays;
    std::vector<double> psi;
  };
  Run run(const Radius& at, bool outgoing, int count) {
    Run run;
    for (int k = 0; k < count; ++k) {
      run.rays.push_back(ray(at, outgoing));
      run.psi.push_back(psi(run.rays.back()));
    }
    return run;
  }

 private:
  std::mt19937_64 engine_{18};
};

// The orbits of rays of one observer, with all that a NullRay knows.
inline RayOrbits orbits_of(const std::vector<NullRay>& rays) {
  std::vector<double> sine, cosine, first, second;
  for (const NullRay& ray : rays) {
    sine.push_back(ray.sin_half);
    cosine.push_back(ray.cos_half);
    first.push_back(ray.gap_first);
    second.push_back(ray.gap_second);
  }
  RayOrbits orbits;
  orbits.set(rays[0].at, rays[0].outgoing,
             {sine.data(), cosine.data(), first.data(), second.data()},
             static_cast<int>(rays.size()));
  return orbits;
}

inline RayPlaces places_of(const std::vector<NullRay>& rays, const std::vector<double>& psi) {
  const RayOrbits orbits = orbits_of(rays);
  RayPlaces places;
  orbits.find(psi.data(), places);
  return places;
}

inline RayPlaces place_of(const NullRay& ray, double psi) { return places_of({ray}, {psi}); }

}  // namespace domefall
