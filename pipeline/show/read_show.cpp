#include "pipeline/show/read_show.h"

#include <fmt/format.h>

#include "pipeline/show/bodies_section.h"
#include "pipeline/show/camera_track.h"
#include "pipeline/show/disc_section.h"
#include "pipeline/show/effects_section.h"
#include "pipeline/show/exposure_section.h"
#include "pipeline/show/grade_section.h"
#include "pipeline/show/observer_track.h"
#include "pipeline/show/output_section.h"
#include "pipeline/show/show_time.h"
#include "pipeline/show/sky_section.h"
#include "pipeline/show/stars_section.h"
#include "pipeline/show/timeline_section.h"
#include "pipeline/show/titles_section.h"
#include "pipeline/show/yaml_document.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

// The origin of galactic coordinates (J2000) lies 0.07 degrees from Sagittarius A*.
constexpr double kGalacticCentreRaDeg = 266.405, kGalacticCentreDecDeg = -28.936;
constexpr double kHeadingDeg = 90, kMostSolarMasses = 1e13;
// This mass still keeps proper times finite.  Holes as light as this have long evaporated.
constexpr double kFewestSolarMasses = 1e-20;

// Reads the hole and how the first orbit lies about it.  Without a mass the show is in flat space.
void read_black_hole(const Section& section, Lookup& lookup, Show& show) {
  const Section s = subsection(section, "black_hole", {"mass_solar", "at", "heading_deg"});
  show.hole_at = sky_direction(kGalacticCentreRaDeg, kGalacticCentreDecDeg);
  if (const Item* at = s.find("at"))
    show.hole_at = read_sky_place(*at, lookup).value_or(show.hole_at);
  show.heading = radians(s.number("heading_deg", kDegrees.within(-360, 360), kHeadingDeg));
  // With a mass that is misspelt or in error, the rest of the show is still checked as one with a
  // hole.
  if (!s.find("mass_solar") && !s.is_misspelt("mass_solar")) return;
  // A mass of 0 is flat space, so the range begins there, and the gap up to the lightest hole is
  // reported by itself.
  const auto mass =
      s.number("mass_solar", Range{"solar masses; 0 is flat space"}.within(0, kMostSolarMasses));
  if (mass && *mass > 0 && *mass < kFewestSolarMasses)
    s.find("mass_solar")
        ->fail(fmt::format("must be 0 (flat space) or at least {} (solar masses), got {}",
                           short_number(kFewestSolarMasses), as_written(*s.find("mass_solar"))));
  if (mass.value_or(1) > 0) show.mass_solar = mass.value_or(1);
}

// Reads all sections of a show.  A section in error leaves its defaults, so that those after it are
// still checked.
void read_sections(const Item& root, Lookup& lookup, Show& show) {
  const Section section(root, {"title",       "frames_per_second",
                               "size",        "black_hole",
                               "timeline",    "camera",
                               "cameras",     "keyframes",
                               "markers",     "fade_in_s",
                               "fade_out_s",  "effects",
                               "sky",         "stars",
                               "disc",        "bodies",
                               "begins_year", "exposure",
                               "grade",       "dome",
                               "titles",      "output"});
  if (!root.node.IsMap()) return;
  show.title = show.file.stem().string();
  if (const Item* title = section.find("title")) show.title = read_text(*title).value_or("");
  show.frames_per_second =
      section.number("frames_per_second", Range{"frames per second"}.within(1, 240), 30);
  // The order matters: bodies need the hole, cameras the bodies, and segments all that a show
  // gives.
  show.markers = read_markers(section);
  show.fades = read_fades(section);
  read_black_hole(section, lookup, show);
  show.bodies = read_bodies(section, show, lookup);
  const ShowCamera camera = read_show_camera(section, show.bodies, lookup);
  show.projection = camera.projection;
  read_stars(section, show);
  read_sky(root, section, lookup, show);
  show.disc = read_disc(section, show);
  show.exposure = read_exposure(section);
  show.effects = read_effects(section);
  show.grade = read_grade(section, lookup);
  show.timeline = read_timeline(section, show, camera, lookup);
  // A timeline that is missing has a message of its own, which is enough.
  if (!show.timeline.empty()) show.titles = read_titles(section, {0, end_of(show)}, show);
  show.grade.dome = read_dome(section, show.projection);
  show.output = read_output(section);
}

}  // namespace

Show read_show(const std::filesystem::path& file) {
  // Errors of syntax end the reading at once, and those of content are gathered and raised
  // together.
  const std::string text = read_show_text(file);
  Problems problems(file.string(), text);
  const YAML::Node node = parse_yaml(text, problems);
  if (!node.IsDefined() || node.IsNull())
    problems.add({}, "the show is empty; it needs a timeline at least");
  problems.raise();

  Show show;
  show.file = file;
  Lookup lookup(file.parent_path());
  const TextPlace start{node.Mark().line, node.Mark().column};
  const Item root{node, start, "", &problems};
  read_sections(root, lookup, show);
  problems.raise();
  // From here on the observer is followed along the timeline, which must be free of mistakes.
  join_segments(show);
  check_effects(root, show);
  problems.raise();
  follow_turns(show);
  return show;
}

}  // namespace domefall
