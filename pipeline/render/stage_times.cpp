#include "pipeline/render/stage_times.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {

void StageTimes::add(const StageTimes& other) {
  // Instants are rendered one after another, so that their times add up.  Of a part, a size or a
  // level the largest one stands for all.
  load_s += other.load_s;
  tables_s += other.tables_s;
  stars_s += other.stars_s;
  grid_s += other.grid_s;
  disc_s += other.disc_s;
  pixels_s += other.pixels_s;
  glare_s += other.glare_s;
  traced_fraction = std::max(traced_fraction, other.traced_fraction);
  table_nodes = std::max(table_nodes, other.table_nodes);
  images += other.images;
  tables_made += other.tables_made;
  for (const SkyRegion sky : kEverySky) black[sky] = std::max(black[sky], other.black[sky]);
}

std::string describe(const FramePlan& plan, const StageTimes& t) {
  std::string skies, tables;
  for (const SkyRegion which : kEverySky) {
    const FramePlan::Sky& sky = plan[which];
    // Only a charged hole leads to it.
    if (which == SkyRegion::kNext && !sky.background && !sky.stars) continue;
    skies += fmt::format("{}sky {}: {}, {}", skies.empty() ? "" : "; ", name_of(which),
                         sky.background ? "background" : "no background",
                         sky.stars ? "stars" : "no stars");
    if (sky.lit()) tables += fmt::format("{}sky {}", tables.empty() ? "" : " and ", name_of(which));
  }
  if (tables.empty()) tables = "all skies black: none";
  // Straight light needs no table, whichever skies are lit.
  if (!plan.gravity) tables = "straight light: none";
  std::string text = fmt::format("load    {:8.3f} s  {}\n", t.load_s, skies);
  for (const SkyRegion sky : kEverySky)
    if (t.black[sky] > 0)
      text +=
          fmt::format("black   {:.3g} cd/m^2 of the map of sky {}\n", t.black[sky], name_of(sky));
  text += fmt::format("tables  {:8.5f} s  {}, {} nodes, {} made\n", t.tables_s, tables,
                      t.table_nodes, t.tables_made);
  text += fmt::format("stars   {:8.4f} s  {} images\n", t.stars_s, t.images);
  // A frame of one instant says nothing of its shutter.
  if (t.instants > 1) text += fmt::format("shutter open: the mean of {} instants\n", t.instants);
  text += fmt::format("grid    {:8.4f} s\n", t.grid_s);
  if (plan.disc || plan.gas)
    text += fmt::format("disc    {:8.4f} s  drawn with the pixels\n", t.disc_s);
  text += fmt::format("pixels  {:8.4f} s  {:.1f} % traced one by one; loops: {}\n", t.pixels_s,
                      100 * t.traced_fraction, name_of(simd_in_use()));
  if (t.glare_s > 0) text += fmt::format("glare   {:8.4f} s\n", t.glare_s);
  return text;
}

}  // namespace domefall
