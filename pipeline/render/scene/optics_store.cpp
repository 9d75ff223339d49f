#include "pipeline/render/scene/optics_store.h"

namespace domefall {

const HoleOptics& OpticsStore::optics_for(const ObserverState& observer, const FramePlan& plan) {
  WantedSkies wanted;
  for (const SkyRegion sky : kEverySky) wanted.sky[sky] = plan[sky].lit();
  wanted.emission_times = plan[SkyRegion::kIV].lit() && plan[SkyRegion::kIV].rings;
  // Tables depend on the radius and the tetrad only, so frames that share both share tables.
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

}  // namespace domefall
