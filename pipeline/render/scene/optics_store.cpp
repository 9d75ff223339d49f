#include "pipeline/render/scene/optics_store.h"

namespace domefall {
namespace {

int table_count(const HoleOptics& optics) {
  return int{optics.home_sky.has_value()} + int{optics.far_sky.has_value()} +
         int{optics.white_hole.has_value()} + int{optics.emission_times.has_value()};
}

}  // namespace

const HoleOptics& OpticsStore::optics_for(const ObserverState& observer, const FramePlan& plan) {
  WantedSkies wanted;
  for (const SkyRegion sky : kEverySky) wanted.sky[sky] = plan[sky].lit();
  wanted.emission_times = plan[SkyRegion::kIV].lit() && plan[SkyRegion::kIV].rings;
  const double r = plan.gravity ? observer.r : kFlatSpace;
  const bool same = kept_ && kept_->at.r == r && kept_->tetrad == observer.tetrad;
  const int before = same ? table_count(*kept_) : 0;
  if (same)
    add_tables(*kept_, wanted);
  else
    kept_ = make_hole_optics(r, observer.tetrad, wanted);
  tables_made_ = table_count(*kept_) - before;
  return *kept_;
}

std::size_t node_count(const HoleOptics& optics) {
  return (optics.home_sky ? optics.home_sky->node_count() : 0) +
         (optics.far_sky ? optics.far_sky->node_count() : 0) +
         (optics.white_hole ? optics.white_hole->node_count() : 0) +
         (optics.emission_times ? optics.emission_times->node_count() : 0);
}

}  // namespace domefall
