#include "pipeline/render/disc/disc_strip.h"

#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {

DiscPass::Strip::Strip(const DiscPass& pass)
    : pass_(pass), disc_(pass.scene_.disc->disc()), effects_(pass.scene_.effects) {}

void DiscPass::Strip::gather() {
  light_.fill(WorkingRgb{0, 0, 0});
  looks_only_ = false;
  gather(nullptr);
}

void DiscPass::Strip::look(const bool* wanted) {
  for (Looks& looks : looks_) looks.count = 0;
  looks_only_ = true;
  gather(wanted);
}

void DiscPass::Strip::gather(const bool* wanted) {
  taken_.fill({});
  for (int k = 0; k < pixels_; ++k)
    left_[static_cast<std::size_t>(k)] = wanted && !wanted[k] ? 1 : gather_pixel(k);
  flush();
}

void DiscPass::Strip::add(int k, const Gas& gas, double weight, const PatternPlace& place) {
  const double g = gas.frequency_ratio;
  samples_.r[count_] = static_cast<float>(gas.r);
  samples_.g[count_] = static_cast<float>(colour_ratio(effects_, g));
  samples_.weight[count_] =
      static_cast<float>(weight * gas.absorbed * surface_brightness_ratio(effects_, g));
  samples_.pixel[count_] = k;
  samples_.place[count_] = place;
  if (++count_ == kSize) flush();
}

// Turns the waiting samples into light and adds it to their pixels.
void DiscPass::Strip::flush() {
  const std::size_t count = count_;
  pass_.scene_.disc->light({samples_.r.data(), count}, {samples_.g.data(), count},
                           {colour_.data(), count});
  count_ = 0;
  if (looks_only_) return note_looks(count);
  if (pass_.pattern_) {
    pass_.pattern_->factors({samples_.place.data(), count}, {factor_.data(), count});
    for (std::size_t k = 0; k < count; ++k) samples_.weight[k] *= factor_[k];
  }
  for (std::size_t k = 0; k < count; ++k) {
    WorkingRgb& light = light_[static_cast<std::size_t>(samples_.pixel[k])];
    const float weight = samples_.weight[k];
    light.r += weight * colour_[k].r;
    light.g += weight * colour_[k].g;
    light.b += weight * colour_[k].b;
  }
}

// Without a pattern a pixel has one look, with all its light.
void DiscPass::Strip::note_looks(std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    Looks& looks = looks_[static_cast<std::size_t>(samples_.pixel[k])];
    if (pass_.pattern_ || looks.count == 0) {
      if (looks.count++ >= kMostLooks) continue;
      looks.at[static_cast<std::size_t>(looks.count - 1)] = {{0, 0, 0}, samples_.place[k]};
    }
    WorkingRgb& light = looks.at[static_cast<std::size_t>(looks.count - 1)].light;
    light.r += samples_.weight[k] * colour_[k].r;
    light.g += samples_.weight[k] * colour_[k].g;
    light.b += samples_.weight[k] * colour_[k].b;
  }
}

}  // namespace domefall
