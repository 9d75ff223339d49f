#include "pipeline/show/grade_section.h"

#include <array>

#include "pipeline/show/assets.h"

namespace domefall {
namespace {

// Reads one number for all channels, or a list of red, green and blue.
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

GradeSettings read_grade(const Section& show, const Lookup& lookup) {
  const Section s = subsection(show, "grade", {"config", "display", "view", "cdl"});
  GradeSettings grade;
  grade.config = shipped_asset(kDomeConfig);
  grade.shipped = true;
  if (const Item* config = s.find("config"))
    if (const auto name = read_text(*config))
      if (const auto file = lookup.file(*config, *name))
        grade.config = *file, grade.shipped = false;
  if (const Item* display = s.find("display")) grade.display = read_text(*display).value_or("");
  if (const Item* view = s.find("view")) grade.view = read_text(*view).value_or("");
  const Section cdl = subsection(s, "cdl", {"slope", "offset", "power", "saturation"});
  read_channels(cdl, "slope", kPureNumber.within(0, 1e6), grade.slope);
  read_channels(cdl, "offset", kPureNumber.within(-1e6, 1e6), grade.offset);
  read_channels(cdl, "power", kPureNumber.above(0).at_most(100), grade.power);
  grade.saturation = cdl.number("saturation", kPureNumber.within(0, 100), grade.saturation);
  return grade;
}

DomeSettings read_dome(const Section& show, const Projection& projection) {
  const Section s = subsection(show, "dome", {"light", "reflectance"});
  DomeSettings dome;
  using enum DomeSettings::Light;
  dome.light =
      s.word<DomeSettings::Light>(
           "light", {{"none", kNone}, {"simulate", kSimulate}, {"compensate", kCompensate}})
          .value_or(kNone);
  dome.reflectance = s.number("reflectance", kPureNumber.within(0, 1), dome.reflectance);
  if (dome.light != kNone && !std::holds_alternative<Domemaster>(projection))
    s.find("light")->fail("is for domes; this projection is flat");
  return dome;
}

GradedFormat read_graded_format(const Section& show) {
  using enum GradedFormat;
  return subsection(show, "output", {"graded"})
      .word<GradedFormat>("graded", {{"png", kPng}, {"tiff", kTiff}, {"none", kNone}})
      .value_or(kPng);
}

}  // namespace domefall
