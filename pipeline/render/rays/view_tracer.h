// Follows view rays from the camera back to the sky: through the axes of the camera, aberration and
// a lens.  This is the inner loop of Domefall.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pipeline/light/aberration.h"
#include "pipeline/light/lens_store.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/viewer.h"
#include "projections/projection.h"

namespace domefall {

// A FrameRayBatch holds directions of view in the frame of a lens.
struct FrameRayBatch : DirectionBatch {
  alignas(64) ViewRayBatch::Column<double> scale;      // angles in that frame per angle in the view
  alignas(64) ViewRayBatch::Column<double> frequency;  // as it is measured, over that in the frame
};

// Returns the lens of an observer under the effects that a show keeps, with the tables of `store`.
std::shared_ptr<const Lens> lens_of(const ObserverState& observer, const WantedSkies& wanted,
                                    const Effects& effects, LensStore& store);
inline std::shared_ptr<const Lens> lens_of(const ObserverState& observer, const WantedSkies& wanted,
                                           const Effects& effects) {
  LensStore store;
  return lens_of(observer, wanted, effects, store);
}

// Brings an image from the frame of a lens to that of the reference tetrad.
SkyImage out_of_lens(const Lens& lens, const SkyImage& image);

class ViewTracer {
 public:
  ViewTracer(const FrameState& state, std::shared_ptr<const Lens> lens, const Effects& effects);
  ViewTracer(const FrameState& state, const WantedSkies& wanted, const Effects& effects = {})
      : ViewTracer(state, lens_of(state.observer, wanted, effects), effects) {}

  // Traces one direction (Lens::ray).
  ViewRay trace(const CameraDirection& n) const;

  // Traces count <= ViewRayBatch::kSize directions by SIMD code (Lens::rays).
  void trace(const CameraDirection* n, int count, ViewRayBatch& batch) const;

  // Brings directions into the frame of the lens and traces them no further.  This serves what is
  // nearer than the skies.
  void into_frame(const CameraDirection* n, int count, FrameRayBatch& batch) const;

  // Returns FrameRayBatch::frequency of a direction in the frame of the lens.
  double frequency_from(const V3d& in_frame) const;

  // Return the curves of the lens, which works in the reference tetrad, as the camera sees them.
  std::vector<SkyBorder> borders() const;
  std::vector<ViewCurve> einstein_rings() const;
  std::optional<ViewCurve> ergosphere() const;

  // Says whether light near the hole goes straight, which a show may ask for.
  bool goes_straight() const { return to_lens_.has_value(); }

  // Returns the observers for whom the frame is drawn.
  const Viewer& viewer() const { return viewer_; }
  const std::shared_ptr<const Lens>& lens() const { return lens_; }

 private:
  ViewCurve seen(const ViewCurve& curve) const;
  // Returns the frequency of light from n for the observer who measures it, over that for the
  // observer whose directions are drawn.
  double measured_ratio(const CameraDirection& n) const;

  M33d tetrad_from_camera_;
  Viewer viewer_;
  std::shared_ptr<const Lens> lens_;
  Aberration to_tetrad_;
  std::optional<Aberration> to_measured_;  // to Viewer::measured, if there is one
  std::optional<Aberration> to_lens_;      // from the tetrad, if the lens has another frame
};

}  // namespace domefall
