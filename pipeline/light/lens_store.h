// A LensStore makes the lens of each observer, and keeps the tables for one place while observers
// stay there.
#pragma once

#include <memory>
#include <optional>

#include "pipeline/light/lens.h"
#include "trajectories/observer_state.h"

namespace domefall {

struct HoleOptics;
struct KerrCharts;

// Returns the optics of an observer without tables, and without any zone in flat space.
HoleOptics optics_of(const ObserverState& observer);

// A StraightLight is for shows that leave lensing out near a hole: the celerity of the observer
// at rest, and the frequency ratio of all light in that observer's frame.
struct StraightLight {
  Celerity<ReferenceTetrad> rest;
  double shift;
};

class LensStore {
 public:
  // Returns the observer's lens.  In flat space light goes straight in any case.
  std::shared_ptr<const Lens> lens(const ObserverState& observer, const WantedSkies& wanted,
                                   const std::optional<StraightLight>& straight = {});

  // Returns how many tables the last lens has made, the others being kept from before, and how many
  // nodes all of its tables have.
  int tables_made() const { return tables_made_; }
  std::size_t table_nodes() const;

 private:
  // Tables depend on these only.
  struct Place {
    Spacetime spacetime;
    Region region;
    Tetrad tetrad;
    int universe;
    double r, l;

    bool operator==(const Place&) const = default;
  };

  std::shared_ptr<const Lens> kerr_lens(const SpinningHole& hole, const ObserverState& observer,
                                        const WantedSkies& wanted);

  std::shared_ptr<HoleOptics> kept_;
  std::shared_ptr<KerrCharts> charts_;  // of a hole that spins
  std::optional<Place> place_;          // of what is kept
  int tables_made_ = 0;
};

}  // namespace domefall
