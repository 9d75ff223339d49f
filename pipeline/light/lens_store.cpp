#include "pipeline/light/lens_store.h"

#include "pipeline/light/charged_lens.h"
#include "pipeline/light/hole_optics.h"
#include "pipeline/light/kerr_lens.h"
#include "pipeline/light/schwarzschild_lens.h"
#include "pipeline/light/straight_lens.h"
#include "pipeline/light/wormhole_lens.h"

namespace domefall {
namespace {

// Each kind of spacetime has its optics and its lens, or none is made of it.
HoleOptics optics_of(const FlatSpace&, const ObserverState&) { return {}; }
HoleOptics optics_of(const Schwarzschild&, const ObserverState& observer) {
  return make_hole_optics(observer.r, observer.tetrad, {{}, false});
}
HoleOptics optics_of(const ChargedHole& hole, const ObserverState& observer) {
  return make_charged_optics(hole, observer);
}
HoleOptics optics_of(const Wormhole& wormhole, const ObserverState& observer) {
  return make_wormhole_optics(wormhole, observer);
}

// A chart takes their place.
HoleOptics optics_of(const SpinningHole&, const ObserverState&) { return {}; }

}  // namespace

HoleOptics optics_of(const ObserverState& observer) {
  return std::visit([&](const auto& kind) { return optics_of(kind, observer); },
                    observer.spacetime.kind());
}

std::shared_ptr<const Lens> LensStore::lens(const ObserverState& observer,
                                            const WantedSkies& wanted,
                                            const std::optional<StraightLight>& straight) {
  const bool flat = observer.spacetime.is_flat();
  if (straight || flat) {
    kept_.reset();
    place_.reset();
    tables_made_ = 0;
    const StraightLight light = straight.value_or(StraightLight{{}, 1});
    return std::make_shared<StraightLens>(observer, light.rest, light.shift);
  }
  if (const auto* hole = std::get_if<SpinningHole>(&observer.spacetime.kind()))
    return kerr_lens(*hole, observer, wanted);
  const Place place{observer.spacetime, observer.region, observer.tetrad,
                    observer.universe,  observer.r,      observer.l};
  const bool same = place_ == place;
  const int before = same ? table_count(*kept_) : 0;
  if (!same) {
    kept_ = std::make_shared<HoleOptics>(optics_of(observer));
    place_ = place;
  } else if (lacks_tables(*kept_, wanted) && kept_.use_count() > 1) {
    // A lens that is still in use goes on to know the skies that it was made for.
    kept_ = std::make_shared<HoleOptics>(*kept_);
  }
  add_tables(*kept_, wanted);
  tables_made_ = table_count(*kept_) - before;
  PerSky<M33d> axes;
  for (const SkyRegion sky : kEverySky) axes[sky] = sky_axes(observer, sky);
  if (observer.spacetime.is<Schwarzschild>())
    return std::make_shared<SchwarzschildLens>(kept_, axes);
  if (const auto* wormhole = std::get_if<Wormhole>(&observer.spacetime.kind()))
    return std::make_shared<WormholeLens>(kept_, axes, *wormhole, observer.l);
  // Discs and bodies are known above the inner horizon of the first universe alone.
  const auto* hole = std::get_if<ChargedHole>(&observer.spacetime.kind());
  if (hole && observer.universe == 0 && observer.r > hole->inner_horizon())
    return std::make_shared<ChargedLens>(kept_, axes, *hole, observer.r);
  return std::make_shared<SphericalLens>(kept_, axes);
}

std::shared_ptr<const Lens> LensStore::kerr_lens(const SpinningHole& hole,
                                                 const ObserverState& observer,
                                                 const WantedSkies& wanted) {
  const KerrPlace at = kerr_place(hole, observer);
  const int stride = kerr_stride(wanted.pixel);
  tables_made_ = 0;
  if (!charts_ || !charts_->are_of(at, stride))
    charts_ = std::make_shared<KerrCharts>(
        KerrCharts{at, stride, {}, {}, std::make_shared<KerrPlaneKeeper>()});
  const auto add = [&](bool seen, std::shared_ptr<const KerrChart>& chart, KerrEdge sky) {
    if (!seen || chart) return;
    chart = std::make_shared<const KerrChart>(at, sky, stride);
    ++tables_made_;
  };
  // A lens that is still in use goes on to know the skies that it was made for.
  if (charts_.use_count() > 1) charts_ = std::make_shared<KerrCharts>(*charts_);
  add(wanted.sky[SkyRegion::kI], charts_->own, KerrEdge::kSilhouette);
  add(wanted.sky[SkyRegion::kIII] && at.delta() < 0, charts_->beyond, KerrEdge::kRegionThree);
  return std::make_shared<KerrLens>(charts_, observer.sky_from_tetrad);
}

std::size_t LensStore::table_nodes() const {
  std::size_t nodes = kept_ ? node_count(*kept_) : 0;
  if (charts_)
    for (const auto& chart : {charts_->own, charts_->beyond})
      if (chart) nodes += static_cast<std::size_t>(chart->rows() * chart->columns());
  return nodes;
}

}  // namespace domefall
