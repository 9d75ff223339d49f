// An OpticsStore keeps the tables of light for one radius while frames stay there.
#pragma once

#include <optional>

#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene/frame_plan.h"

namespace domefall {

class OpticsStore {
 public:
  // Returns the optics at a frame's observer, with the tables that its plan asks for.  The
  // reference is valid until the next call.
  const HoleOptics& optics_for(const ObserverState& observer, const FramePlan& plan);

  // Returns how many tables the last call made.  The others were kept from before.
  int tables_made() const { return tables_made_; }

 private:
  std::optional<HoleOptics> kept_;
  int tables_made_ = 0;
};

}  // namespace domefall
