// A sphere near the hole, to which rays are followed by steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/body_image.h"
#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/ray_times.h"

namespace domefall {

inline constexpr double kPixel = std::numbers::pi / 4096;  // of a dome of 4096 pixels

// On a circular orbit, at the azimuth phi when v = 0.
inline BodyMotion circling(double r, double phi) {
  const double s = std::sqrt(2 / r), around = 1 / std::sqrt(r - 3),
               gamma = std::sqrt((1 + around * around) / (1 - s * s));
  return {[=](double tau) {
            const double angle = phi + tau * around / r;
            return BodyPoint{V3d(std::cos(angle), std::sin(angle), 0),
                             r,
                             tau / std::sqrt(1 - 3 / r),
                             gamma,
                             gamma * s,
                             V3d(0, 0, r * around)};
          },
          -HUGE_VAL, HUGE_VAL};
}

// v - T within a slice of the rain, in closed form.
inline double slice(double r) {
  return r - 2 * std::sqrt(2 * r) + 4 * std::log(1 + std::sqrt(r / 2));
}

// A SphereScene traces rays to a sphere by steps along them.
struct SphereScene {
  double observer;
  BodyMotion motion;
  double radius;

  // Returns q/a of the place v, X, which is beyond 1 outside the sphere.
  V3d on_sphere(double v, double r, const V3d& x) const {
    // T grows with tau at a steady rate on these orbits.
    const auto time = [&](double tau) {
      const BodyPoint body = motion.at(tau);
      return body.null_time - slice(body.r);
    };
    const double tau = (v - slice(r) - time(0)) / (time(1) - time(0));
    const BodyPoint body = motion.at(tau);
    const V3d u = body.celerity(), d = x - body.direction * body.r;
    return (d + u * (u.dot(d) / (body.gamma + 1))) / radius;
  }

  // Returns q/a along the ray at this angle from the hole, by psi.
  struct Path {
    Path(const SphereScene& scene, const V3d& e, double alpha)
        : scene(scene), e(e), ray(ray_at(Radius(scene.observer), alpha, {false, false})) {
      orbits.set(ray.at, false, {&ray.sin_half, &ray.cos_half, &ray.gap_first, &ray.gap_second}, 1);
    }
    V3d q(double psi) const {
      const RayTimes times(orbits);
      RayPlaces places;
      orbits.find(&psi, places);
      const double r = places.r[0];
      if (!(r > 2 && r < 1e9)) return V3d(1e9, 0, 0);
      double v = 0;
      times.find(&psi, places, &v);
      return scene.on_sphere(v, r, (V3d(std::cos(psi), 0, 0) + e * std::sin(psi)) * r);
    }
    const SphereScene& scene;
    V3d e;
    NullRay ray;
    RayOrbits orbits;
  };

  // Finds where the ray at this angle from the hole is first within the sphere, for psi in a range;
  // `depth` is the least |q/a|.
  bool meets(const V3d& e, double alpha, double from, double to, V3d* first = nullptr) const {
    constexpr int kSteps = 2000;
    const Path path(*this, e, alpha);
    const auto q = [&](double psi) { return path.q(psi); };
    double least = HUGE_VAL, at = from;
    // Rays that are nearly radial sweep little.
    to = std::min(to, exact_azimuth(path.ray));
    const double step = (to - from) / kSteps;
    for (int k = 0; k <= kSteps; ++k) {
      const double psi = from + step * k, depth = q(psi).length();
      if (depth < least) least = depth, at = psi;
      if (depth < 1) break;
    }
    double low = at - step, high = least < 1 ? at : at + step;
    if (least >= 1) {  // a minimum between steps
      for (int n = 0; n < 60; ++n) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (q(a).length() < q(b).length() ? high : low) = q(a).length() < q(b).length() ? b : a;
      }
      at = (low + high) / 2;
      if (!(q(at).length() < 1)) return false;
      low = at - step, high = at;
    }
    for (int n = 0; first && n < 60; ++n) {
      const double middle = (low + high) / 2;
      (q(middle).length() < 1 ? high : low) = middle;
    }
    if (first) *first = q(high);
    return true;
  }

  // Returns q/a where the ray meets the plane at right angles to `normal`, next to a place of it.
  V3d on_plane(const V3d& e, double alpha, const V3d& normal, const V3d& near) const {
    constexpr int kSteps = 1500;
    const Path path(*this, e, alpha);
    const double end = std::min(std::numbers::pi * 2, exact_azimuth(path.ray));
    V3d nearest(1e9, 0, 0);
    V3d before = path.q(0);
    for (int k = 1; k <= kSteps; ++k) {
      double low = end * (k - 1) / kSteps, high = end * k / kSteps;
      const V3d now = path.q(high);
      const bool crosses = before.length() < 1e6 && now.length() < 1e6 &&
                           (before.dot(normal) > 0) != (now.dot(normal) > 0);
      const bool above = before.dot(normal) > 0;
      before = now;
      if (!crosses) continue;
      for (int n = 0; n < 60; ++n) {
        const double middle = (low + high) / 2;
        ((path.q(middle).dot(normal) > 0) == above ? low : high) = middle;
      }
      const V3d met = path.q(high);
      if ((met - near).length() < (nearest - near).length()) nearest = met;
    }
    return nearest;
  }
};

}  // namespace domefall
