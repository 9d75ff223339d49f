#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/report/extreme_cases.h"
#include "pipeline/report/ray_errors.h"

namespace domefall {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// A SweptWorst collects the largest errors of table and integral, as Worst does for a hole.
class SweptWorst {
 public:
  void add(const AnyRay& ray, bool table = true) {
    const SweptAzimuth truth = swept_truth(ray);
    if (truth.sky != ReferenceSky::kOwn && truth.sky != ReferenceSky::kOther) return;
    const bool own = truth.sky == ReferenceSky::kOwn;
    const auto phi = static_cast<double>(truth.azimuth);
    const auto methods = compared_methods(
        std::holds_alternative<ChargedRequest>(ray) ? RayKind::kCharge : RayKind::kWormhole, true);
    const auto error = [&](const RayMethod& method) {
      const FollowedRay found = method.follow(ray, method.default_setting);
      const bool right = found.origin == (own ? SkyRegion::kI : SkyRegion::kIII);
      return right && std::isfinite(found.phi) ? std::abs(found.phi - phi) / std::max(1.0, phi)
                                               : kNever;
    };
    if (table) table_ = std::max(table_, error(methods[0]));
    exact_ = std::max(exact_, error(methods[1]));
    ++rays_;
  }
  ExtremeResult result(const std::string& more) const {
    constexpr double kExactBound = 1e-12;  // as docs/accuracy.md has it of all such rays
    return {exact_ <= kExactBound ? table_ : kNever,
            fmt::format("{} rays; integral within {:.1e}, tables {:.1e}. ", rays_, exact_, table_) +
                more};
  }

 private:
  double exact_ = 0, table_ = 0;
  int rays_ = 0;
};

// Adds rays over the whole view and on both sides of each edge, down to a part of 1e-15.
void add_charged(SweptWorst& worst, const ChargedHole& hole, const ChargedRadius& at,
                 bool table = true) {
  for (const double delta :
       {1e-9, 1e-5, 0.01, 0.3, 0.7, 1.1, 1.5, 1.9, 2.3, 2.8, 3.1, std::numbers::pi - 1e-5})
    worst.add(ChargedRequest{hole, at, delta, {}, 0}, table);
  if (!table) return;
  for (int decade = 0; decade <= 15; ++decade)
    worst.add(ChargedRequest{hole, at, 0, Critical::kFirst, 1e-3 * std::pow(10, -decade)});
  // Between the horizons the other exterior's sky is a disc.
  const auto disc = static_cast<double>(-2 * charged_edges(hole.charge_long(), at.r).second);
  for (int decade = 0; decade <= 15 && disc > 0; ++decade)
    worst.add(ChargedRequest{hole, at, 0, Critical::kSecond,
                             -std::min(1e-3, disc / 2) * std::pow(10, -decade)});
}

void add_within(SweptWorst& worst, const Wormhole& wormhole, double l) {
  const double edge = std::asin(1 / wormhole.radius(l));
  for (const double part :
       {-0.999999, -0.5, -1e-3, -1e-6, -1e-12, 1e-12, 1e-6, 1e-3, 0.5, 0.999999}) {
    const double offset = part * (part < 0 ? edge : std::numbers::pi - edge);
    worst.add(WormholeRequest{wormhole, l, edge + offset, offset});
  }
}

ExtremeResult next_to_extremal() {
  SweptWorst worst;
  const ChargedHole nearly(1, 1 - 1e-12L), extremal(1, 1);
  for (const ChargedHole& hole : {nearly, extremal})
    for (const double r : {1.001, 1.5, 2.0, 10.0, 1e6}) add_charged(worst, hole, hole.at(r));
  add_charged(worst, nearly, nearly.at(1));
  return worst.result(fmt::format("The horizons of the first are {:.2g} M apart",
                                  nearly.horizon() - nearly.inner_horizon()));
}

ExtremeResult above_the_inner_horizon() {
  SweptWorst worst;
  const ChargedHole hole(1, 0.8L);
  for (const double above : {1e-3, 1e-6, 1e-9, 1e-12})
    add_charged(worst, hole, hole.at(ChargedMark::kInnerHorizon, above));
  return worst.result(
      "The other exterior's sky shrinks to a point ahead, whose light is bluer without bound");
}

ExtremeResult near_the_centre() {
  SweptWorst worst;
  for (const double q : {0.8, 1.0, 1.05, 2.0}) {
    const ChargedHole hole(1, q);
    for (const double part : {1e-3, 0.01, 0.5})
      add_charged(worst, hole, hole.at(part * (q <= 1 ? hole.inner_horizon() : q * q)), false);
  }
  return worst.result("Every ray but the radial one is turned by the centre");
}

ExtremeResult throats() {
  SweptWorst worst;
  for (const double length : {0.0, 1e-6, 1e3})
    for (const double width : {1e-4, 0.05, 1e3})
      for (const double l : {length / 2, length / 2 + 1e-3, length / 2 + 10})
        add_within(worst,
                   {.profile = Wormhole::Profile::kDngr, .length = length, .lensing_width = width},
                   l);
  return worst.result("Beside the edge light circles in the throat, through a long one on a helix");
}

ExtremeResult far_from_the_throat() {
  SweptWorst worst;
  for (const double l : {1e9, -1e9}) {
    add_within(worst, {.profile = Wormhole::Profile::kEllis}, l);
    add_within(worst, {.profile = Wormhole::Profile::kDngr}, l);
  }
  return worst.result("The throat is a disc of 2e-9 rad");
}

}  // namespace

std::vector<ExtremeCase> extreme_swept() {
  const std::string phi = "error of phi, of max(1, phi)";
  constexpr double kBound = 1e-8;  // for the tables
  return {{"NextToExtremal", "q = 1 - 1e-12 and 1, between the horizons and from r = 1.001 to 1e6",
           phi, kBound, next_to_extremal},
          {"AboveTheInnerHorizon", "q = 0.8, r = r_- + 1e-3 to r_- + 1e-9", phi, 1e-5,
           above_the_inner_horizon},
          {"NearTheCentre", "q = 0.8 to 2, r = a thousandth of r_- or q^2, by the integral alone",
           phi, kBound, near_the_centre},
          {"Throats", "lengths of 0, 1e-6 and 1e3, lensing widths of 1e-4 to 1e3", phi, kBound,
           throats},
          {"FarFromTheThroat", "l = 1e9 and -1e9", phi, kBound, far_from_the_throat}};
}

}  // namespace domefall
