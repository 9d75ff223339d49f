// The tables of light for one radius, kept while frames stay there.
#pragma once

#include <optional>

#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene/frame_plan.h"

namespace domefall {

class OpticsStore {
 public:
  // The optics at the observer of a frame, with the tables that its plan asks for.  Good until the next
  // call.
  const HoleOptics& optics_for(const ObserverState& observer, const FramePlan& plan);

  // How many tables the last call made; the others were kept.
  int tables_made() const { return tables_made_; }

 private:
  std::optional<HoleOptics> kept_;
  int tables_made_ = 0;
};

// The number of nodes of all tables.
std::size_t node_count(const HoleOptics& optics);

}  // namespace domefall
