#include <CLI/CLI.hpp>
#include <cstdio>

#include "pipeline/cli/frame_range.h"
#include "pipeline/cli/frame_size.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/image/errors.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/show/read_show.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

struct Options {
  std::string show, size, pixel;
  FrameChoice choice;
};

PixelPosition parse_pixel(const std::string& text) {
  PixelPosition at{};
  int used = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf%n", &at.i, &at.j, &used) != 2 ||
      used != static_cast<int>(text.size()) || !std::isfinite(at.i) || !std::isfinite(at.j))
    throw InputError("--pixel " + text + ": expected X,Y, counted from 1 at the top left");
  return at;
}

// Prints what becomes of a blackbody at the place that the ray hits, under the effects of the show.
void print_effects(const Effects& effects, const ViewRay& ray, double width) {
  const double g = ray.frequency_ratio, colour = colour_ratio(effects, g);
  const double colour2 = colour * colour;
  std::printf("thermal sky  temperature times %.6g, bolometric intensity times %.6g\n", colour,
              surface_brightness_ratio(effects, g) * colour2 * colour2);
  if (effects.amplification == Amplification::kEverything)
    std::printf("amplified    %.6g times, over the pixel's width\n",
                amplification(ray.bundle, width));
}

void probe(const Options& o) {
  Show show = read_show(o.show);
  show.projection = resized(show.projection, o.size);
  const int number = chosen_frame(o.choice, show);
  const FrameState state = frame_state(show, number);
  const PixelPosition pixel = parse_pixel(o.pixel);
  const HoleOptics optics =
      make_hole_optics(state.observer.r, state.observer.tetrad, {true, true, true});
  const ViewRay ray =
      ViewTracer(state, optics, show.effects).trace(direction_at(state.projection, pixel));
  std::printf("observer     region %s, r = %.9g M\n", region_name(state.observer.region),
              state.observer.r);
  if (!is_inside(state.projection, pixel)) std::puts("pixel        outside the dome");
  const Equatorial at = equatorial({ray.sky_direction});
  const bool singularity = ray.sky == SkyRegion::kIV;
  std::printf("sees         %s %s, RA %.6f deg, Dec %.6f deg\n",
              singularity ? "the past singularity, region" : "sky", name_of(ray.sky), at.ra_deg,
              at.dec_deg);
  if (!singularity) std::printf("1 + z        %.9g\n", 1 / ray.frequency_ratio);
  std::printf("compression  %.6g towards the hole, %.6g across\n", ray.radial_scale,
              ray.tangential_scale);
  if (!singularity && show.effects != Effects{})
    print_effects(show.effects, ray, pixel_angle(state.projection, pixel));
}

}  // namespace

void add_probe(CLI::App& app) {
  auto* verb = app.add_subcommand("probe", "What is seen at a pixel: sky, place, redshift");
  auto o = std::make_shared<Options>();
  verb->add_option("show", o->show, "show file (YAML)")->required();
  add_frame_choice(*verb, o->choice);
  verb->add_option("--pixel", o->pixel, "X,Y counted from 1 at the top left")->required();
  verb->add_option("--size", o->size, "as for render");
  verb->callback([o] { probe(*o); });
}

}  // namespace domefall
