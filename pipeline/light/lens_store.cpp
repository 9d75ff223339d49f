#include "pipeline/light/lens_store.h"

#include "pipeline/light/hole_optics.h"
#include "pipeline/light/schwarzschild_lens.h"
#include "pipeline/light/straight_lens.h"

namespace domefall {

// Each kind of spacetime has its lens, or none is made of it.
std::shared_ptr<const Lens> LensStore::lens(const ObserverState& observer,
                                            const WantedSkies& wanted,
                                            const std::optional<StraightLight>& straight) {
  if (straight) return lens_of(FlatSpace{}, observer, wanted, *straight);
  return std::visit(
      [&](const auto& kind) {
        return lens_of(kind, observer, wanted, StraightLight{{}, 1});
      },
      observer.spacetime.kind());
}

std::shared_ptr<const Lens> LensStore::lens_of(const FlatSpace&, const ObserverState& observer,
                                               const WantedSkies&, const StraightLight& light) {
  kept_.reset();
  tables_made_ = 0;
  return std::make_shared<StraightLens>(observer.r, observer.tetrad, observer.sky_from_tetrad,
                                        light.rest, light.shift);
}

std::shared_ptr<const Lens> LensStore::lens_of(const Schwarzschild&, const ObserverState& observer,
                                               const WantedSkies& wanted, const StraightLight&) {
  const double r = observer.r;
  // Tables depend on the radius and the tetrad only.
  const bool same = kept_ && kept_->at.r == r && kept_->tetrad == observer.tetrad;
  const int before = same ? table_count(*kept_) : 0;
  if (!same) {
    kept_ = std::make_shared<HoleOptics>(make_hole_optics(r, observer.tetrad, wanted));
  } else {
    // A lens that is still in use goes on to know the skies that it was made for.
    if (lacks_tables(*kept_, wanted) && kept_.use_count() > 1)
      kept_ = std::make_shared<HoleOptics>(*kept_);
    add_tables(*kept_, wanted);
  }
  tables_made_ = table_count(*kept_) - before;
  return std::make_shared<SchwarzschildLens>(kept_, observer.sky_from_tetrad);
}

std::size_t LensStore::table_nodes() const { return kept_ ? node_count(*kept_) : 0; }

}  // namespace domefall
