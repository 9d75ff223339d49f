// Orbits of gas about a hole that spins, and the light of a disc there.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/sources/disc/disc_light.h"
#include "pipeline/sources/disc/gas_orbits.h"

namespace domefall {
namespace {

KerrHole hole_of(double spin, double charge = 0) { return {spin, charge}; }

// u^t and u^phi of gas, and u_r, whose product with k follows by the metric in the coordinates of Boyer
// and Lindquist.
double shift_by_metric(const GasOrbits& gas, const GasRay& ray, double r, bool outward) {
  const double a = gas.spin(), above = gas.delta(r), q2 = gas.charge_squared();
  const double square = r * r + a * a, drag = a * (2 * r - q2);
  const double tt = (square * square - above * a * a) / (above * r * r),
               tp = drag / (above * r * r), pp = (above - a * a) / (above * r * r);
  double energy = gas.plunge_energy(), momentum = gas.plunge_momentum();
  const bool falls = r < gas.last_stable();
  if (!falls) {
    const double w = std::sqrt(r - q2), n = r * std::sqrt(r * (r - 3) + 2 * q2 + 2 * a * w);
    energy = (r * (r - 2) + q2 + a * w) / n;
    momentum = (w * square - drag) / n;
  }
  const double p = square * ray.energy - a * ray.about_axis;
  const double k_r = std::sqrt(p * p - above * ray.momentum * ray.momentum) * (outward ? 1 : -1);
  const double u_r = falls ? -gas.plunge_speed(r) * r * r : 0;
  return tt * energy * ray.energy - tp * (energy * ray.about_axis + momentum * ray.energy) -
         pp * momentum * ray.about_axis - k_r * u_r / (above * r * r);
}

TEST(SpinningGas, ArePageAndThornesAboutASpin) {
  for (const double spin : {0.05, 0.5, 0.9, 0.998})
    for (const bool retrograde : {false, true}) {
      const KerrHole hole = hole_of(spin);
      const GasOrbits gas(hole, retrograde);
      const PageThorneProfile profile(false, gas);
      const double unit = page_thorne_flux(hole, profile.hottest(), !retrograde);
      for (const double part : {1.01, 1.1, 1.5, 3.0, 10.0, 100.0}) {
        const double r = part * gas.last_stable();
        EXPECT_NEAR(profile.flux(r) / (page_thorne_flux(hole, r, !retrograde) / unit), 1,
                    1e-9 + 1e-14 / std::pow(part - 1, 2))
            << spin << ' ' << retrograde << ' ' << part;
      }
    }
}

TEST(SpinningGas, GoOverIntoThoseWithoutSpin) {
  for (const double charge : {0.0, 0.6}) {
    const GasOrbits still(ChargedHole{1, charge}), slow(hole_of(1e-9, charge), false);
    const PageThorneProfile profile(true, still), other(true, slow);
    for (const double r : {2.0, 3.0, 5.0, 7.0, 20.0}) {
      EXPECT_NEAR(slow.angular_velocity(r), still.angular_velocity(r), 1e-8);
      EXPECT_NEAR(other.flux(r) / profile.flux(r), 1, 1e-7) << charge << ' ' << r;
    }
  }
}

// The same gas comes to all holes of a mass, and brings all its light from nearer to them.
TEST(SpinningGas, HaveOneFluxFarFromAllHoles) {
  for (const double charge : {0.0, 0.3})
    for (const bool plunging : {false, true}) {
      const PageThorneProfile still(plunging, GasOrbits(ChargedHole{1, charge}));
      double before = 0;
      for (const double spin :
           {1e-9, 0.5, 0.9, 0.94, charge > 0 ? 0.95 : 0.998, charge > 0 ? 0.951 : 0.999999})
        for (const bool retrograde : {false, true}) {
          const PageThorneProfile other(plunging, GasOrbits(hole_of(spin, charge), retrograde));
          EXPECT_NEAR(other.greatest() * other.flux(1e10) / (still.greatest() * still.flux(1e10)),
                      1, 1e-4)
              << charge << ' ' << spin << ' ' << retrograde;
          if (retrograde)
            EXPECT_LE(other.greatest(), still.greatest() * (1 + 1e-7));
          else
            EXPECT_GT(other.greatest(), before);
          if (!retrograde) before = other.greatest();
        }
    }
}

// Four-velocities have length 1, and shifts are inner products.
TEST(SpinningGas, ShiftLightByTheMetric) {
  for (const double spin : {-0.9, -0.3, 0.4, 0.95})
    for (const double charge : {0.0, 0.25}) {
      const GasOrbits gas(hole_of(std::abs(spin), charge), spin < 0);
      for (const double part : {0.2, 0.5, 0.8, 1.2, 3.0}) {
        const double r = part < 1 ? gas.horizon() + part * (gas.last_stable() - gas.horizon())
                                  : part * gas.last_stable();
        for (const bool outward : {false, true}) {
          const GasRay ray{1, 2, 0.7};
          EXPECT_NEAR(disc_shift(gas, ray, r, outward) / shift_by_metric(gas, ray, r, outward), 1,
                      1e-10)
              << spin << ' ' << charge << ' ' << r << ' ' << outward;
        }
      }
      const double r = (gas.horizon() + gas.last_stable()) / 2;
      // The gas's own constants take the place of the light's.
      const double y = gas.plunge_momentum() - spin * gas.plunge_energy();
      const double p = (r * r + spin * spin) * gas.plunge_energy() - spin * gas.plunge_momentum();
      const double speed = r * r * gas.plunge_speed(r);
      EXPECT_NEAR(p * p - speed * speed, gas.delta(r) * (r * r + y * y), 1e-11 * p * p);
    }
}

}  // namespace
}  // namespace domefall
