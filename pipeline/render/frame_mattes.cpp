#include "pipeline/render/frame_mattes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "pipeline/render/overlay/frame_titles.h"
#include "pipeline/sources/colour/colour_space.h"
#include "projections/pixel_directions.h"

namespace domefall {

std::vector<Matte> mattes_of(const Show& show) {
  std::vector<Matte> mattes;
  const OutputData& data = show.output.data;
  if (data.mattes || data.cryptomatte)
    for (std::size_t k = 0; k < show.bodies.size(); ++k)
      mattes.push_back({fmt::format("body_{}", k + 1)});
  if (!data.mattes) return mattes;
  for (const SkyRegion sky : kExteriorSkies)
    if (sky != SkyRegion::kNext || show.spacetime.leads_on())
      mattes.push_back({fmt::format("sky_{}", name_of(sky))});
  mattes.push_back({"silhouette"});
  for (int order = 0; show.disc && order < PlaneImages::kOrders; ++order)
    mattes.push_back({fmt::format("disc_{}", order)});
  return mattes;
}

MattePass::MattePass(const FrameScene& scene, const DiscPass* disc)
    : scene_(scene),
      disc_(disc),
      borders_(scene.tracer, scene.projection()),
      seen_(seen_skies(scene.state.observer)) {
  const std::vector<BodyImages> images = images_of_bodies(scene, scene.bodies, disc);
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    bodies_.push_back(lay_bodies(scene, images, k));
}

void MattePass::fill_rows(int first, int end, const float* rgb, SplatBuffer& splats,
                          std::vector<Matte>& mattes) const {
  const std::size_t width = columns(scene_.projection());
  for (std::size_t body = 0; body < bodies_.size(); ++body)
    fill_body(body, first, end, rgb, splats, mattes[body].covered.data() + first * width);
  if (mattes.size() == bodies_.size()) return;
  const auto skies = static_cast<std::size_t>(std::ranges::count_if(
      mattes, [](const Matte& matte) { return matte.name.starts_with("sky_"); }));
  for (int row = first; row < end; ++row) {
    std::vector<float*> covered;
    for (std::size_t k = bodies_.size(); k < mattes.size(); ++k)
      covered.push_back(mattes[k].covered.data() + row * width);
    for (float* const values : covered) std::fill_n(values, width, 0.0f);
    // The skies are followed by the silhouette, and that by the orders of the disc.
    const std::span<float* const> all(covered);
    fill_skies(row, all.first(skies + 1));
    if (disc_) disc_->fill_orders(row, all.subspan(skies + 1));
  }
}

// The matte of a body is the part of a pixel's light that is the body's.
void MattePass::fill_body(std::size_t body, int first, int end, const float* rgb,
                          SplatBuffer& splats, float* covered) const {
  const auto luminance_at = [](const float* light) {
    return luminance({light[0], light[1], light[2]});
  };
  const std::size_t width = columns(scene_.projection());
  std::vector<float> own(3 * kBandRows * width);
  const std::size_t pixels = static_cast<std::size_t>(end - first) * width;
  draw_bodies(bodies_[body], first / kBandRows, pixels, splats, own.data(), nullptr);
  for (std::size_t k = 0; k < pixels; ++k) {
    const double light = luminance_at(&own[3 * k]), all = luminance_at(rgb + 3 * k);
    covered[k] = light > 0 ? static_cast<float>(std::min(light / all, 1.0)) : 0;
  }
}

void MattePass::fill_skies(int row, std::span<float* const> covered) const {
  const Projection& projection = scene_.projection();
  const ColumnRange inside = inside_columns(projection, row);
  for (int column = inside.first; column <= inside.last; ++column) {
    const PixelPosition pixel{column + 1.0, row + 1.0};
    const PerSky<double> parts =
        borders_.parts(direction_at(projection, pixel), pixel_angle(projection, pixel), seen_);
    double skies = 0;
    std::size_t matte = 0;
    for (; matte < covered.size() - 1; ++matte) {
      const double part = parts[kExteriorSkies[matte]];
      skies += part;
      covered[matte][column] = static_cast<float>(part);
    }
    covered[matte][column] = static_cast<float>(std::max(1 - skies, 0.0));
  }
}

std::vector<std::string> objects_of(const Show& show) {
  std::set<std::string> names;
  for (const Body& body : show.bodies) names.insert(body.name);
  const auto add_names = [&](const std::vector<Title>& titles) {
    for (const Title& title : titles)
      if (!title.text.empty()) names.insert(title.text);
  };
  add_names(show.titles);
  for (const Segment& segment : show.timeline) add_names(segment.titles);
  return {names.begin(), names.end()};
}

Cryptomatte identities(const Show& show, const FrameState& state,
                       const std::vector<Matte>& mattes) {
  Cryptomatte identities(columns(state.projection), rows(state.projection), objects_of(show));
  for (std::size_t k = 0; k < show.bodies.size(); ++k)
    identities.add(show.bodies[k].name, mattes[k].covered);
  for (const SeenTitle& seen : seen_titles(show, state))
    if (!seen.title->text.empty())
      identities.add_in_front(seen.title->text, covered_by(show, seen, state));
  return identities;
}

}  // namespace domefall
