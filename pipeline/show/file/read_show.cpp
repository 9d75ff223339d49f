#include "pipeline/show/file/read_show.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/errors.h"
#include "pipeline/show/file/frame_size.h"
#include "pipeline/show/file/sections.h"
#include "pipeline/show/file/show_time.h"
#include "pipeline/show/file/yaml_document.h"
#include "pipeline/show/observer_track.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

// The origin of galactic coordinates (J2000) lies 0.07 degrees from Sagittarius A*.
constexpr double kGalacticCentreRaDeg = 266.405, kGalacticCentreDecDeg = -28.936;
// This mass still keeps proper times finite.  Holes as light as this have long evaporated.
constexpr double kFewestSolarMasses = 1e-20;

// With a spin in error the rest of the show is still checked as one with a hole that spins.
double read_spin(const Section& s, double charge) {
  const Item* given = s.find("spin");
  const auto read = s.given(
      "spin", s.range("spin").because("a hole that turns the other way has the other end of its "
                                      "axis as `axis`"));
  constexpr double kInError = 0.1;  // so that the rest is checked as about a spin
  if (given && !read) return kInError;
  const double spin = read.value_or(0);
  if (spin == 0) {
    if (const Item* axis = s.find("axis"))
      axis->fail("is that of a hole that spins; give it a spin above 0");
    return 0;
  }
  if (charge > 1) return given->fail("is not of a hole whose charge exceeds 1"), kInError;
  constexpr double kMost = 0.999999;
  if (charge > 0 && spin * spin + charge * charge > kMost * kMost)
    given->fail(fmt::format(
        "must be at most {} with a charge of {}, got {}: the squares of both may not exceed {}, or "
        "the horizons would meet",
        short_number(std::sqrt(std::max(0.0, kMost * kMost - charge * charge))),
        short_number(charge), as_written(*given), short_number(kMost * kMost)));
  return spin;
}

// Reads the spacetime.  With a mass that is misspelt or in error, the rest of the show is still
// checked as one with a hole.
Spacetime read_spacetime(const Section& s) {
  if (!s.find("mass_solar") && !s.is_misspelt("mass_solar")) {
    for (const char* key : {"charge", "naked", "spin", "axis"})
      if (const Item* given = s.find(key)) given->fail("is of a hole, which needs mass_solar");
    return FlatSpace{};
  }
  // A mass of 0 is flat space, so the range begins there, and the gap up to the lightest hole is
  // reported by itself.
  const auto mass = s.given("mass_solar");
  if (mass && *mass > 0 && *mass < kFewestSolarMasses)
    s.find("mass_solar")
        ->fail(fmt::format("must be 0 (flat space) or at least {} (solar masses), got {}",
                           short_number(kFewestSolarMasses), as_written(*s.find("mass_solar"))));
  const auto charge_given = s.given("charge");
  const double charge = charge_given.value_or(0);
  const bool naked = s.flag("naked");
  if (!(mass.value_or(1) > 0)) {
    const bool charged = charge > 0, spins = s.number("spin") > 0;
    for (const auto& [key, asked] : {std::pair("charge", charged), {"spin", spins}, {"axis", true}})
      if (const Item* given = s.find(key); given && asked)
        given->fail("is of a hole, which needs a mass_solar above 0");
    return FlatSpace{};
  }
  if (charge > 1 && !naked)
    s.find("charge")->fail(fmt::format(
        "must be at most 1, got {}: with more no horizon hides the singularity; if that "
        "is meant, say naked: true",
        as_written(*s.find("charge"))));
  if (naked && !(charge > 1) && (charge_given || !s.find("charge")))
    s.find("naked")->fail("is for a charge above 1; with less, a horizon hides the singularity");
  const double spin = read_spin(s, charge);
  if (spin > 0) return SpinningHole{mass.value_or(1), {spin, charge > 1 ? 0 : charge}};
  if (charge > 0) return ChargedHole(mass.value_or(1), charge);
  return Schwarzschild{mass.value_or(1)};
}

void read_black_hole(const Section& section, Lookup& lookup, Show& show) {
  const Section s(section.find("black_hole"), {"black_hole"});
  show.hole_at = sky_direction(kGalacticCentreRaDeg, kGalacticCentreDecDeg);
  if (const Item* at = s.find("at"))
    show.hole_at = read_sky_place(*at, lookup).value_or(show.hole_at);
  show.heading = s.angle("heading_deg");
  show.spacetime = read_spacetime(s);
  if (!show.spacetime.is<SpinningHole>()) return;
  SpinningHole hole = std::get<SpinningHole>(show.spacetime.kind());
  // The north of an orbit is against Theta.
  V3d axis = -column(place_tetrad(show.hole_at, show.heading, 0), 1);
  if (const Item* given = s.find("axis"))
    axis = read_sky_place(*given, lookup).value_or(SkyDirection{axis}).v;
  hole.axis = {axis.x, axis.y, axis.z};
  show.spacetime = hole;
}

// A show has a black hole or a wormhole.
void read_place(const Section& section, Lookup& lookup, Show& show) {
  const Item* item = section.find("wormhole");
  section.one_of({"black_hole", "wormhole"});
  if (item == nullptr) return read_black_hole(section, lookup, show);
  const Section s(item, {"wormhole"});
  show.hole_at = sky_direction(kGalacticCentreRaDeg, kGalacticCentreDecDeg);
  if (const Item* at = s.find("at"))
    show.hole_at = read_sky_place(*at, lookup).value_or(show.hole_at);
  show.heading = s.angle("heading_deg");
  show.spacetime = read_wormhole(s);
}

std::vector<std::filesystem::path> read_audio(const Section& section, const Lookup& lookup) {
  std::vector<std::filesystem::path> files;
  const Item* given = section.find("audio");
  if (!given) return files;
  const auto list = given->node.IsSequence() ? read_list(*given) : std::vector{*given};
  for (const Item& item : list.value_or(std::vector<Item>{}))
    if (const auto name = read_text(item))
      if (const auto file = lookup.file(item, *name)) files.push_back(*file);
  return files;
}

void read_sections(const Item& root, Lookup& lookup, Show& show) {
  const Section section(root, {"show"});
  if (!root.node.IsMap()) return;
  show.title = show.file.stem().string();
  if (section.find("title")) show.title = section.text("title");
  read_frame_rate(section, show);
  // The order matters: bodies need the hole, cameras the bodies, and segments all that a show
  // gives.  Any place may be a planet's, which needs the year.
  show.begins_year = section.given("begins_year");
  lookup.set_year(show.begins_year);
  show.markers = read_markers(section, lookup);
  show.fades = read_fades(section);
  show.audio = read_audio(section, lookup);
  read_place(section, lookup, show);
  for (const Marker& marker : show.markers)
    if (marker.event && marker.event->l && !show.spacetime.is<Wormhole>())
      peek(*section.find("markers"), marker.name)
          ->fail("has an l, which is a place in a wormhole; events near a hole have an r");
  show.bodies = read_bodies(section, show, lookup);
  const ShowCamera camera = read_show_camera(section, show, lookup);
  show.projection = camera.projection;
  read_stars(section, show);
  read_sky(root, section, lookup, show);
  show.disc = read_disc(section, show, lookup);
  show.halo = read_halo(section, show);
  show.jet = read_jet(section, show);
  show.exposure = read_exposure(section, show);
  show.glare = read_glare(section, show);
  show.effects = read_effects(section);
  show.grade = read_grade(section, lookup);
  show.draws_titles = section.flag("draw_titles");
  read_timeline(section, camera, lookup, show);
  // The observer is followed along a timeline without mistakes.
  if (root.problems->count() == 0) join_segments(show);
  if (!show.timeline.empty()) show.titles = read_titles(section, {0, end_of(show)}, show, lookup);
  show.grade.dome = read_dome(section, show.projection);
  show.output = read_output(section);
}

void overlay(Show& show, const std::string& names) {
  if (names.empty()) return;
  try {
    show.overlays = parse_overlays(names);
  } catch (const InputError& error) {
    throw InputError("--overlay " + names + ": " + error.what());
  }
  if (std::ranges::count(show.overlays, OverlayKind::kErgosphere) > 0 &&
      !show.spacetime.is<SpinningHole>())
    throw InputError("--overlay " + names +
                     ": only a hole that spins has an ergosphere; give black_hole a spin, or leave "
                     "ergosphere out");
  const bool flat = std::ranges::all_of(
      show.overlays, [](OverlayKind kind) { return kind >= OverlayKind::kBurnIn; });
  if (traits_of(show.projection).has_faces && !flat)
    throw InputError("--overlay " + names +
                     ": only burn-in can be drawn on a cubemap, whose faces would cut the others; "
                     "look at them in another projection");
  show.title += " (overlay " + overlay_names(show.overlays) + ")";
}

}  // namespace

Show read_show(const std::filesystem::path& file) {
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
  check_effects(root, show);
  problems.raise();
  follow_turns(show);
  return show;
}

Show read_show(const std::filesystem::path& file, const std::string& size,
               const std::string& overlays) {
  Show show = read_show(file);
  overlay(show, overlays);
  show.projection = resized(show.projection, size);
  return show;
}

}  // namespace domefall
