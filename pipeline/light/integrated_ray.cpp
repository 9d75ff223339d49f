#include "pipeline/light/integrated_ray.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "pipeline/light/ray_methods.h"

namespace domefall {
namespace {

// Below this share of r max(|E|, |k^r|) an angular momentum sweeps less than 1e-20 radians even by
// the singularity (phi ~ b^(1/3) there), so the ray is radial.
constexpr double kRadialShare = 1e-60;

// Returns the same photon with its largest component 1, so that no product of them overflows.
PhotonAtObserver normalised(PhotonAtObserver photon) {
  const double radial_size = std::max(std::abs(photon.energy), std::abs(photon.radial));
  const double tangential = photon.angular_momentum / photon.r;
  const double size = std::max(radial_size, tangential);
  photon.energy /= size;
  photon.radial /= size;
  photon.angular_momentum =
      tangential < kRadialShare * radial_size ? 0 : photon.angular_momentum / size;
  if (photon.region == Region::kI) photon.energy = std::abs(photon.energy);
  if (photon.region == Region::kIII) photon.energy = -std::abs(photon.energy);
  return photon;
}

// Says whether light is along the horizon itself, for only there has light neither energy nor
// radial motion.
bool stays_on_the_horizon(const PhotonAtObserver& photon) {
  return photon.energy == 0 && photon.radial == 0;
}

[[maybe_unused]] bool is_light_of_its_region(const PhotonAtObserver& photon) {
  if (!(photon.r > 0) || !(photon.angular_momentum >= 0)) return false;
  if (photon.region == Region::kII) return photon.r <= 2 && photon.radial <= 0;
  if (photon.region == Region::kIV) return photon.r <= 2 && photon.radial >= 0;
  return photon.r >= 2;
}

}  // namespace

IntegratedRay integrate_ray(const PhotonAtObserver& photon, Integrator integrator,
                            double tolerance) {
  return integrate_ray_to(std::numeric_limits<double>::infinity(), photon, integrator, tolerance);
}

IntegratedRay integrate_ray_to(double psi, const PhotonAtObserver& photon, Integrator integrator,
                               double tolerance) {
  assert(is_light_of_its_region(photon));
  if (stays_on_the_horizon(photon)) return undecided_ray();
  const PhotonAtObserver start = normalised(photon);
  switch (integrator) {
    case Integrator::kPaperRk4:
      return paper_ray(start, tolerance, psi);
    case Integrator::kFullDopri5:
      return full_ray_dopri5(start, tolerance, psi);
    case Integrator::kFullRkf78:
      return full_ray_rkf78(start, tolerance, psi);
    case Integrator::kBinetDopri5:
      return binet_ray_dopri5(start, tolerance, psi);
    case Integrator::kBinetRkf78:
      return binet_ray_rkf78(start, tolerance, psi);
  }
  return undecided_ray();
}

}  // namespace domefall
