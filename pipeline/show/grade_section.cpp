#include "pipeline/show/grade_section.h"

#include "pipeline/show/assets.h"
#include "pipeline/show/channel_values.h"

namespace domefall {
GradeSettings read_grade(const Section& show, const Lookup& lookup) {
  const Section s = subsection(show, "grade", {"config", "display", "view", "cdl"});
  GradeSettings grade;
  grade.config = shipped_asset(kDomeConfig);
  grade.shipped = true;
  if (const Item* config = s.find("config"))
    if (const auto name = read_text(*config))
      if (const auto file = lookup.file(*config, *name))
        grade.config = *file, grade.shipped = false;
  // Only the configuration knows its displays and views, so these names are checked when it is
  // loaded.
  if (const Item* display = s.find("display")) grade.display = read_text(*display).value_or("");
  if (const Item* view = s.find("view")) grade.view = read_text(*view).value_or("");
  ChannelValues values;
  read_cdl(s, values);
  // Numbers that the show does not give leave the picture as it is.
  grade.cdl =
      cdl_from([&](Channel channel, double neutral) { return values[channel].value_or(neutral); });
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
  // Every part of the dome lights every other one, so that the sum needs the whole half sphere.
  if (dome.light != kNone && !std::holds_alternative<Domemaster>(projection))
    s.find("light")->fail(has_zenith(projection)
                              ? "is for a whole half sphere, which the projection domemaster shows"
                              : "is for domes; this projection is flat");
  return dome;
}

}  // namespace domefall
