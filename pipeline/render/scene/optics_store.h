// The tables of light for one radius, which are kept while frames stay there.
#pragma once

#include <optional>

#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene/frame_plan.h"

namespace domefall {

class OpticsStore {
 public:
  // The optics at a frame's observer, with the tables that its plan asks for.  The reference is
  // valid until the next call.
  const HoleOptics& optics_for(const ObserverState& observer, const FramePlan& plan);

  // How many tables the last call made.  The others were kept from before.
  int tables_made() const { return tables_made_; }

 private:
  std::optional<HoleOptics> kept_;
  int tables_made_ = 0;
};

}  // namespace domefall
