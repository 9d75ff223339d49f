#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"
#include "pipeline/program/cli/frame_choice.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/render/pixel_probe.h"
#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/show/file/frame_size.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/show/show.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInDegrees = 180 / std::numbers::pi;

struct ProbeOptions {
  std::string show, size, pixel;
  FrameChoice choice;
  bool json = false;
};

PixelPosition parse_pixel(const std::string& text) {
  PixelPosition at{};
  int used = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf%n", &at.i, &at.j, &used) != 2 ||
      used != static_cast<int>(text.size()) || !std::isfinite(at.i) || !std::isfinite(at.j))
    throw InputError("--pixel " + text + ": expected X,Y, counted from 1 at the top left");
  return at;
}

// Probed is what is known of the pixel that is asked for.
struct Probed {
  const Show& show;
  FrameState state;
  PixelPosition pixel;
  ViewRay ray;
  std::vector<DiscAtPixel> disc;
  double left_of_sky;     // the part of its light that the disc lets through
  double left_by_bodies;  // and that bodies do
  std::vector<StarAtPixel> stars;
  std::vector<BodyAtPixel> bodies;
  std::vector<std::string> titles;

  bool inside() const { return is_inside(state.projection, pixel); }
  double width() const { return pixel_angle(state.projection, pixel); }
  bool from_singularity() const { return ray.sky == SkyRegion::kIV; }
  bool is_straight() const { return is_flat(state.observer) || !show.effects.lensing; }
};

void print_effects(const Effects& effects, const ViewRay& ray, double width) {
  const double g = ray.frequency_ratio, colour = colour_ratio(effects, g);
  const double colour2 = colour * colour;
  fmt::print("thermal sky  temperature times {:.6g}, bolometric intensity times {:.6g}\n", colour,
             surface_brightness_ratio(effects, g) * colour2 * colour2);
  if (effects.amplification == Amplification::kEverything)
    fmt::print("amplified    {:.6g} times, over the pixel's width\n",
               amplification(ray.bundle, width));
}

void print_sky(const Probed& p) {
  if (!p.ray.known) {
    fmt::print("sees         no light of any sky\n");
    return;
  }
  const Equatorial at = equatorial({p.ray.sky_direction});
  fmt::print("sees         {} {}, RA {:.6f} deg, Dec {:.6f} deg\n",
             p.from_singularity() ? "the past singularity, region" : "sky", name_of(p.ray.sky),
             at.ra_deg, at.dec_deg);
  if (!p.from_singularity()) fmt::print("1 + z        {:.9g}\n", 1 / p.ray.frequency_ratio);
  fmt::print("compression  {:.6g} towards the hole, {:.6g} across\n", p.ray.scale_along,
             p.ray.scale_across);
  if (!p.from_singularity() && p.show.effects != Effects{})
    print_effects(p.show.effects, p.ray, p.width());
}

void print_text(const Probed& p) {
  const ObserverState& observer = p.state.observer;
  const std::string region = region_name(observer.region, observer.universe);
  if (observer.spacetime.is<Wormhole>())
    fmt::print("observer     region {}, l = {:.9g}, r = {:.9g} radii of the throat\n", region,
               observer.l, observer.r);
  else
    fmt::print("observer     region {}, r = {:.9g} M\n", region, observer.r);
  if (!p.inside()) fmt::print("pixel        outside the dome\n");
  for (const std::string& title : p.titles) fmt::print("title        {}\n", printable(title));
  for (const DiscAtPixel& disc : p.disc)
    fmt::print(
        "disc         r = {:.6g} M, azimuth {:.6g} deg, 1 + z {:.6g}, {:.5g} K, image {}, in "
        "{:.4g} "
        "of the pixel\n",
        disc.r, disc.azimuth_deg, 1 / disc.frequency_ratio, disc.temperature, disc.order,
        disc.covered);
  if (!p.disc.empty()) fmt::print("behind it    {:.4g} of the light is left\n", p.left_of_sky);
  print_sky(p);
  // Under thin gas or far from the hole hundreds of faint ones may be there.
  constexpr std::size_t kMostStars = 12;
  for (const StarAtPixel& star : std::span(p.stars).first(std::min(p.stars.size(), kMostStars))) {
    const std::string name = star.names.empty() ? "without a name" : star.names.front();
    fmt::print("star         {}, V {:.2f} seen as V {:.2f}, image {} at {:.2f},{:.2f}\n",
               printable(name), star.v, star.seen_v, star.order, star.at.i, star.at.j);
  }
  if (p.stars.size() > kMostStars)
    fmt::print("stars        {} fainter ones\n", p.stars.size() - kMostStars);
  for (const BodyAtPixel& body : p.bodies)
    fmt::print(
        "body         {}, at {:.6g} M, 1 + z {:.6g}, seen as V {:.2f}, image {} at {:.2f},{:.2f}\n",
        printable(body.name), body.r, 1 / body.frequency_ratio, body.seen_v, body.order, body.at.i,
        body.at.j);
  if (p.left_by_bodies < 1)
    fmt::print("behind them  {:.4g} of the light is left\n", p.left_by_bodies);
}

Json json_of_star(const StarAtPixel& star) {
  return {{"names", star.names},
          {"sky", name_of(star.sky)},
          {"ra_deg", star.ra_deg},
          {"dec_deg", star.dec_deg},
          {"v", star.v},
          {"temperature_k", star.temperature},
          {"seen_v", star.seen_v},
          {"order", star.order},
          {"pixel", {star.at.i, star.at.j}}};
}

Json json_of_body(const BodyAtPixel& body) {
  return {{"name", body.name},     {"r", body.r},         {"one_plus_z", 1 / body.frequency_ratio},
          {"seen_v", body.seen_v}, {"order", body.order}, {"pixel", {body.at.i, body.at.j}}};
}

bool has_titles(const Show& show) {
  return !show.titles.empty() || std::ranges::any_of(show.timeline, [](const Segment& segment) {
    return !segment.titles.empty();
  });
}

Json json_of_disc(const DiscAtPixel& disc) {
  return {{"r", disc.r},
          {"azimuth_deg", disc.azimuth_deg},
          {"one_plus_z", 1 / disc.frequency_ratio},
          {"temperature_k", disc.temperature},
          {"order", disc.order},
          {"covered", disc.covered}};
}

// Light from the singularity has no redshift, no order and no amplification.
void add_shift(const Probed& p, Json& json) {
  constexpr const char* kKeys[] = {"one_plus_z",    "temperature_ratio", "intensity_ratio",
                                   "amplification", "swept_azimuth_deg", "order"};
  for (const char* key : kKeys) json[key] = nullptr;
  if (p.from_singularity()) return;
  const double g = p.ray.frequency_ratio, colour = colour_ratio(p.show.effects, g);
  json["one_plus_z"] = 1 / g;
  json["temperature_ratio"] = colour;
  json["intensity_ratio"] = surface_brightness_ratio(p.show.effects, g) * std::pow(colour, 4);
  json["amplification"] = amplification(p.ray.bundle, p.width());
  if (p.is_straight()) return;
  json["swept_azimuth_deg"] = p.ray.swept * kInDegrees;
  json["order"] = static_cast<int>(p.ray.swept / std::numbers::pi);
}

void print_probe_json(const Probed& p) {
  const ObserverState& observer = p.state.observer;
  const Equatorial at = equatorial({p.ray.sky_direction});
  const V3d& to = p.ray.sky_direction;
  const bool known = p.ray.known;
  Json json = {{"frame", p.state.frame},
               {"pixel", {p.pixel.i, p.pixel.j}},
               {"inside", p.inside()},
               {"region",
                is_flat(observer) ? Json() : Json(region_name(observer.region, observer.universe))},
               {"r", observer.r},
               {"l", observer.l},
               {"sky", known ? Json(name_of(p.ray.sky)) : Json()},
               {"direction", known ? Json({to.x, to.y, to.z}) : Json()},
               {"ra_deg", known ? Json(at.ra_deg) : Json()},
               {"dec_deg", known ? Json(at.dec_deg) : Json()},
               {"compression_towards_hole", known ? Json(p.ray.scale_along) : Json()},
               {"compression_across", known ? Json(p.ray.scale_across) : Json()},
               {"to_edge_deg", p.ray.to_edge * kInDegrees}};
  add_shift(p, json);
  json["stars"] = Json::array();
  for (const StarAtPixel& star : p.stars) json["stars"].push_back(json_of_star(star));
  // A show without bodies has no such key.
  if (!p.show.bodies.empty()) json["bodies"] = Json::array();
  for (const BodyAtPixel& body : p.bodies) json["bodies"].push_back(json_of_body(body));
  if (!p.show.bodies.empty()) json["left_behind_bodies"] = p.left_by_bodies;
  // Likewise a show without a disc, and one without titles.
  if (p.show.disc) {
    json["disc"] = Json::array();
    for (const DiscAtPixel& disc : p.disc) json["disc"].push_back(json_of_disc(disc));
    json["left_behind_disc"] = p.left_of_sky;
  }
  if (has_titles(p.show)) json["titles"] = p.titles;
  // A catalogue's names need not be UTF-8.
  std::puts(json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void probe(const ProbeOptions& o) {
  const Show show = read_show(o.show, o.size, {});
  const FrameState state = frame_state(show, chosen_frame(o.choice, show));
  const PixelPosition pixel = parse_pixel(o.pixel);
  const int width = columns(state.projection), height = rows(state.projection);
  if (!(pixel.i >= 0.5 && pixel.i <= width + 0.5 && pixel.j >= 0.5 && pixel.j <= height + 0.5))
    throw InputError(fmt::format("--pixel {} is outside of the frame, which has {} x {}", o.pixel,
                                 width, height));
  const PixelProbe probe(show, state, pixel);
  const Probed probed{show,
                      state,
                      pixel,
                      probe.ray(),
                      probe.disc(),
                      probe.left_of_sky(),
                      probe.left_by_bodies(),
                      probe.stars(),
                      probe.bodies(),
                      probe.titles()};
  o.json ? print_probe_json(probed) : print_text(probed);
}

}  // namespace

void add_probe(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "probe", "What is seen at a pixel: sky, disc, bodies, stars, titles, and their redshifts");
  auto o = std::make_shared<ProbeOptions>();
  add_show(*verb, o->show)->required();
  add_frame_choice(*verb, o->choice);
  verb->add_option("--pixel", o->pixel, "X,Y counted from 1 at the top left")
      ->type_name("X,Y")
      ->required();
  verb->add_option("--size", o->size, "as for render")->type_name("SIZE");
  verb->add_flag("--json", o->json, "the same facts as JSON with all digits, for other programs");
  verb->callback([o] { probe(*o); });
}

}  // namespace domefall
