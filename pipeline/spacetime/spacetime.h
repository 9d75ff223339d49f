// The spacetime of a show: flat, or one of the kinds in the variant.  Who is not tied to one kind
// asks it here.  A new kind is a class with the same answers and a place in the variant.  What else
// depends on the kind, such as its lens, visits the variant and does not compile without it.
//
// Radii are in units of M (c = G = 1).  In flat space r is kFlatSpace, which exceeds every place
// that marks a hole, and proper time is in seconds.
#pragma once

#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "pipeline/spacetime/charged.h"
#include "pipeline/spacetime/radius.h"
#include "pipeline/spacetime/regions.h"
#include "pipeline/spacetime/schwarzschild.h"
#include "pipeline/spacetime/spinning_hole.h"
#include "pipeline/spacetime/wormhole.h"

namespace domefall {

struct FlatSpace {
  bool operator==(const FlatSpace&) const = default;

  static std::optional<double> solar_masses() { return std::nullopt; }
  static double seconds_per_m() { return 1; }
  static std::vector<double> parameters() { return {}; }
  static double horizon() { return 0; }
  static double inner_horizon() { return 0; }
  static double above_horizon(double r) { return r; }
  static double light_circle() { return 0; }
  static double last_stable_orbit() { return 0; }
  static double circling_time(double) { return 0; }
  static StaticTime static_time(double) { return {}; }
  static double fall_celerity(double) { return 0; }
  static double lapse_squared(double) { return 1; }
  static double lapse_squared_above(double, double) { return 1; }
  static double resting_celerity(double) { return 0; }
  static double moving_celerity(double, double radial, double, bool) { return radial; }
  static double tortoise(double r) { return r; }
  static PerSky<bool> seen_skies(Region, Tetrad tetrad, int universe, double) {
    PerSky<bool> seen;
    seen[own_sky(tetrad, universe)] = true;
    return seen;
  }
};

class Spacetime {
 public:
  using Kind = std::variant<FlatSpace, Schwarzschild, ChargedHole, Wormhole, SpinningHole>;

  Spacetime() = default;                                 // flat
  Spacetime(const Kind& kind) : kind_(kind) {}           // NOLINT: each kind is a spacetime
  Spacetime(const FlatSpace& kind) : kind_(kind) {}      // NOLINT
  Spacetime(const Schwarzschild& kind) : kind_(kind) {}  // NOLINT
  Spacetime(const ChargedHole& kind) : kind_(kind) {}    // NOLINT
  Spacetime(const Wormhole& kind) : kind_(kind) {}       // NOLINT
  Spacetime(const SpinningHole& kind) : kind_(kind) {}   // NOLINT

  bool operator==(const Spacetime&) const = default;

  const Kind& kind() const { return kind_; }
  bool is_flat() const { return is<FlatSpace>(); }
  template <class One>
  bool is() const {
    return std::holds_alternative<One>(kind_);
  }

  // Returns the mass of the hole, or nothing without one.
  std::optional<double> solar_masses() const {
    return std::visit([](const auto& kind) { return kind.solar_masses(); }, kind_);
  }
  // Returns the seconds of one unit of proper time, which is one M.
  double seconds_per_m() const {
    return std::visit([](const auto& kind) { return kind.seconds_per_m(); }, kind_);
  }
  // Returns the numbers beside its mass that tell a spacetime from others of its kind.  All frames
  // depend on them.
  std::vector<double> parameters() const {
    return std::visit([](const auto& kind) { return kind.parameters(); }, kind_);
  }

  // Returns the r that region I, and what can rest, lies above.
  double horizon() const {
    return std::visit([](const auto& kind) { return kind.horizon(); }, kind_);
  }
  // Returns r minus that, with the digits that r has lost beside it.
  double above_horizon(double r) const {
    return std::visit([r](const auto& kind) { return kind.above_horizon(r); }, kind_);
  }
  // Returns the r inside which things rest again, or 0.
  double inner_horizon() const {
    return std::visit([](const auto& kind) { return kind.inner_horizon(); }, kind_);
  }
  double light_circle() const {
    return std::visit([](const auto& kind) { return kind.light_circle(); }, kind_);
  }
  double last_stable_orbit() const {
    return std::visit([](const auto& kind) { return kind.last_stable_orbit(); }, kind_);
  }
  // Returns the proper time, over r, in which a free circular orbit turns by one radian.  Where there
  // is no such orbit it is NaN, or 0.
  double circling_time(double r) const {
    return std::visit([r](const auto& kind) { return kind.circling_time(r); }, kind_);
  }

  StaticTime static_time(double r) const {
    return std::visit([r](const auto& kind) { return kind.static_time(r); }, kind_);
  }
  // Returns f, of either sign.  Its root is the rate of a clock at rest.
  double lapse_squared(double r) const {
    return std::visit([r](const auto& kind) { return kind.lapse_squared(r); }, kind_);
  }
  // Returns f of a place whose distance above the horizon is known better than by its r.
  double lapse_squared_above(double r, double above) const {
    return std::visit([=](const auto& kind) { return kind.lapse_squared_above(r, above); }, kind_);
  }
  // Returns the frequency of light from infinity for the observer at rest, over that at infinity:
  // 1/(1 + z_grav) = 1/sqrt(f), [Riazuelo] eq. zgrav, for r above the horizon.
  double gravitational_ratio(double r) const { return 1 / std::sqrt(lapse_squared(r)); }
  // Returns gamma v along R, against the rain tetrad, of what is at rest in r outside the horizon
  // or in t inside.  Against the outgoing tetrad it has the opposite sign.
  double resting_celerity(double r) const {
    return std::visit([r](const auto& kind) { return kind.resting_celerity(r); }, kind_);
  }
  // Returns gamma v along R, against the rain tetrad or the outgoing one, of what moves with dr/dtau
  // and r dphi/dtau and has an energy above 0.
  double moving_celerity(double r, double radial, double tangential, bool outgoing) const {
    return std::visit(
        [=](const auto& kind) { return kind.moving_celerity(r, radial, tangential, outgoing); },
        kind_);
  }
  // Returns gamma v along R, against rain, of free fall from rest at infinity.
  double fall_celerity(double r) const {
    return std::visit([r](const auto& kind) { return kind.fall_celerity(r); }, kind_);
  }
  // Returns r*, with which v = t + r* and u = t - r* are the times of light that falls and rises.
  double tortoise(double r) const {
    return std::visit([r](const auto& kind) { return kind.tortoise(r); }, kind_);
  }

  // Says whether universes follow each other through a hole.
  bool leads_on() const {
    const auto* hole = std::get_if<ChargedHole>(&kind_);
    return hole && !hole->is_naked();
  }

  // Says which skies of exteriors are seen at r of a region, where light is bent.
  PerSky<bool> seen_skies(Region region, Tetrad tetrad, int universe, double r) const {
    return std::visit(
        [=](const auto& kind) { return kind.seen_skies(region, tetrad, universe, r); }, kind_);
  }

 private:
  Kind kind_;
};

}  // namespace domefall
