#include "pipeline/show/stars_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace domefall {
namespace {

// The laws have these defaults.  The law of the size is the paper's, whose stars are white in their
// middle and of true colour at their edge.
constexpr double kPaperWhiteCore = 10, kSaturation = 0.8;
constexpr double kMinSigmaDeg = 0.04, kMaxSigmaDeg = 0.3;
constexpr double kHalo = 0.12, kHaloSigmaDeg = 0.08;
// This gain makes stars one magnitude fainter than in nature against the sky between them, since
// 10^-0.4 is about 0.4.  Without it, a dome of 4096 pixels shows stars of V = 9 as bright as the
// heart of the Milky Way, and fields of stars look uniform.  The law of the paper has its own
// balance.
constexpr double kStarGain = 0.4;
constexpr std::array<std::string_view, 3> kKeysOfSize{"growth", "reference_magnitude",
                                                      "max_sigma_deg"};
constexpr std::array<std::string_view, 2> kKeysOfPsf{"halo", "halo_sigma_deg"};

// Reads the point-spread law.  Keys that only the other law has are reported.
PointSpreadLaw read_point_spread(const Section& s) {
  // Without `law`, a key that only the law of the size has chooses that law.
  const bool sized = std::any_of(kKeysOfSize.begin(), kKeysOfSize.end(),
                                 [&](std::string_view key) { return s.find(key) != nullptr; });
  const bool psf = s.word<bool>("law", {{"size", false}, {"psf", true}}).value_or(!sized);
  const auto keys_of_other_law =
      psf ? std::span<const std::string_view>(kKeysOfSize) : std::span(kKeysOfPsf);
  for (const std::string_view key : keys_of_other_law)
    if (const Item* item = s.find(key))
      item->fail(psf ? "belongs to stars.law: size, but the law is psf"
                     : "belongs to stars.law: psf, but the law is size");
  const Range sigma = kDegrees.above(0).at_most(10);
  PointSpreadLaw law;
  const double least = s.number("min_sigma_deg", sigma, kMinSigmaDeg);
  // A show that widens only the faint stars need not give the widest blob as well.
  const double most = s.number("max_sigma_deg", sigma, std::max(kMaxSigmaDeg, least));
  if (!psf && most < least)
    s.find("max_sigma_deg")
        ->fail(fmt::format("must be at least min_sigma_deg = {} (degrees), got {}",
                           short_number(least), as_written(*s.find("max_sigma_deg"))));
  law.min_sigma = radians(least);
  law.max_sigma = radians(most);
  law.growth = s.number("growth", kPureNumber.within(0, 0.5), law.growth);
  law.reference_magnitude =
      s.number("reference_magnitude", Range{"magnitudes"}.within(-30, 40), law.reference_magnitude);
  law.white_core = s.number("white_core", kPureNumber.within(0, 1e6), psf ? 0 : kPaperWhiteCore);
  if (!psf) return law;
  law.halo = s.number("halo", kPureNumber.above(0).at_most(0.9), kHalo);
  law.halo_sigma = radians(s.number("halo_sigma_deg", kDegrees.above(0).at_most(3), kHaloSigmaDeg));
  return law;
}

}  // namespace

double default_star_gain(const PointSpreadLaw& law) { return law.halo > 0 ? kStarGain : 1; }

void read_stars(const Section& show, Show& to) {
  const Section s =
      subsection(show, "stars",
                 {"law", "min_sigma_deg", "growth", "reference_magnitude", "max_sigma_deg", "halo",
                  "halo_sigma_deg", "white_core", "saturation", "least_radius_deg"});
  to.point_spread = read_point_spread(s);
  to.star_saturation =
      s.number("saturation", kPureNumber.within(0, 2), to.point_spread.halo > 0 ? kSaturation : 1);
  const double gain = default_star_gain(to.point_spread);
  for (const SkyRegion region : kExteriorSkies) to.sky[region].star_gain = gain;
  to.least_star_radius =
      radians(s.number("least_radius_deg", kDegrees.above(0).at_most(1), kLeastStarRadiusDeg));
}

}  // namespace domefall
