#include "pipeline/show/picture_sections.h"

#include <array>
#include <span>
#include <string>

#include "pipeline/show/assets.h"
#include "pipeline/show/values_section.h"

namespace domefall {
namespace {

constexpr double kMinSigmaDeg = 0.05, kMaxSigmaDeg = 0.3;
constexpr double kHalo = 0.15, kHaloSigmaDeg = 0.2;
constexpr std::array<std::string_view, 3> kKeysOfSize{"growth", "reference_magnitude",
                                                      "max_sigma_deg"};
constexpr std::array<std::string_view, 2> kKeysOfPsf{"halo", "halo_sigma_deg"};

// One number for all channels, or a list of red, green and blue.
void read_channels(const Section& cdl, std::string_view key, const Range& range,
                   std::array<double, 3>& channels) {
  const Item* item = cdl.find(key);
  if (!item) return;
  if (item->node.IsSequence()) {
    const auto values = read_numbers(*item, 3, range);
    if (values) channels = {(*values)[0], (*values)[1], (*values)[2]};
  } else if (const auto value = read_number(*item, range)) {
    channels.fill(*value);
  }
}

}  // namespace

PointSpreadLaw read_point_spread(const Section& show) {
  const Section s = subsection(show, "stars",
                               {"law", "min_sigma_deg", "growth", "reference_magnitude",
                                "max_sigma_deg", "halo", "halo_sigma_deg", "white_core"});
  const bool psf = s.choice("law", {"size", "psf"}).value_or(0) == 1;
  const auto keys_of_other_law =
      psf ? std::span<const std::string_view>(kKeysOfSize) : std::span(kKeysOfPsf);
  for (const std::string_view key : keys_of_other_law)
    if (const Item* item = s.find(key))
      item->fail(std::string("belongs to stars.law: ") +
                 (psf ? "size, but the law is psf" : "psf, but the law is size"));
  const Range sigma = kDegrees.above(0).at_most(10);
  PointSpreadLaw law;
  const double least = s.number("min_sigma_deg", sigma, kMinSigmaDeg);
  const double most = s.number("max_sigma_deg", sigma, std::max(kMaxSigmaDeg, least));
  if (!psf && most < least)
    s.find("max_sigma_deg")
        ->fail("must be at least min_sigma_deg = " + short_number(least) + " (degrees), got " +
               short_number(most));
  law.min_sigma = radians(least);
  law.max_sigma = radians(most);
  law.growth = s.number("growth", kPureNumber.within(0, 0.5), law.growth);
  law.reference_magnitude =
      s.number("reference_magnitude", Range{"magnitudes"}.within(-30, 40), law.reference_magnitude);
  law.white_core = s.number("white_core", kPureNumber.within(0, 1e6), kWhiteCore);
  if (!psf) return law;
  law.halo = s.number("halo", kPureNumber.above(0).at_most(0.9), kHalo);
  law.halo_sigma = radians(s.number("halo_sigma_deg", kDegrees.above(0).at_most(3), kHaloSigmaDeg));
  return law;
}

Exposure read_exposure(const Section& show) {
  const Section s = subsection(show, "exposure", {"ev", "shutter_deg"});
  constexpr double kWholeTurn = 360;  // of a film camera's shutter: from one frame to the next
  return {s.number("ev", kStops, 0),
          s.number("shutter_deg", kDegrees.within(0, kWholeTurn), 0) / kWholeTurn};
}

GradeSettings read_grade(const Section& show, const Lookup& lookup) {
  const Section s = subsection(show, "grade", {"config", "display", "view", "cdl"});
  GradeSettings grade;
  grade.config = shipped_asset(kDomeConfig);
  if (const Item* config = s.find("config"))
    if (const auto name = read_text(*config))
      if (const auto file = lookup.file(*config, *name)) grade.config = *file;
  if (const Item* display = s.find("display")) grade.display = read_text(*display).value_or("");
  if (const Item* view = s.find("view")) grade.view = read_text(*view).value_or("");
  const Section cdl = subsection(s, "cdl", {"slope", "offset", "power", "saturation"});
  read_channels(cdl, "slope", kPureNumber.within(0, 1e6), grade.slope);
  read_channels(cdl, "offset", kPureNumber.within(-1e6, 1e6), grade.offset);
  read_channels(cdl, "power", kPureNumber.above(0).at_most(100), grade.power);
  grade.saturation = cdl.number("saturation", kPureNumber.within(0, 100), grade.saturation);
  return grade;
}

GradedFormat read_graded_format(const Section& show) {
  const Section s = subsection(show, "output", {"graded"});
  switch (s.choice("graded", {"png", "tiff", "none"}).value_or(0)) {
    case 1:
      return GradedFormat::kTiff;
    case 2:
      return GradedFormat::kNone;
    default:
      return GradedFormat::kPng;
  }
}

}  // namespace domefall
