// A LensStore makes the lens of each observer, and keeps the tables for one radius while observers
// stay there.
#pragma once

#include <memory>
#include <optional>

#include "pipeline/light/lens.h"
#include "trajectories/observer_state.h"

namespace domefall {

struct HoleOptics;

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
  // Makes the lens of one kind of spacetime; a kind without one does not compile.
  std::shared_ptr<const Lens> lens_of(const FlatSpace& kind, const ObserverState& observer,
                                      const WantedSkies& wanted, const StraightLight& light);
  std::shared_ptr<const Lens> lens_of(const Schwarzschild& kind, const ObserverState& observer,
                                      const WantedSkies& wanted, const StraightLight& light);

  std::shared_ptr<HoleOptics> kept_;
  int tables_made_ = 0;
};

}  // namespace domefall
