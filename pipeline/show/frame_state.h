// A FrameState holds what the renderer needs of one frame.  It is a pure function of show and frame
// number.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

// FrameSettings hold the exposure and the numbers of skies, disc, bodies and titles at one instant,
// which keyframes may have changed.
struct FrameSettings {
  struct Sky {
    double background_gain = 1, star_gain = 1;
    double max_magnitude = 9;
    // True if the limit is keyframed.  Stars then fade in over the last half magnitude before it,
    // so that none appears at once.  Otherwise all stars up to the limit have their whole light.
    bool soft_limit = false;
  };
  double ev = 0;
  PerSky<Sky> sky;  // of region IV only background_gain is used
  // The disc's light is that of Show::disc times the gain.
  double disc_gain = 1, disc_opacity = 1;
  // These are factors on the light and the opacity of all titles.
  double title_gain = 1, title_opacity = 1;
  std::vector<double> magnitudes;  // of the show's bodies; empty where none is keyframed
};

struct FrameState {
  int frame = 0;
  double show_time_s = 0;
  int segment = 0;  // index into the timeline; during a dissolve the later one
  ObserverState observer;
  // The rotation vector of the sky against the axes R, Theta, Phi of the tetrad at this instant, in
  // radians per frame.  It is 0 for an observer who stays on one line through the hole.
  V3d sky_turn{0, 0, 0};
  Projection projection;
  M33d camera_from_audience;  // audience_axes() of camera.h
  FrameSettings settings;
  Cdl cdl;
  // Whether it is for a passing look, for which light about a spin is known well enough if it is to a
  // twentieth of a pixel.
  bool draft = false;
  double fade = 1;  // the part of its light that is left in a fade from or to black
  // During a dissolve, `vanishing` is the state in the segment that vanishes, and `vanishing_part`
  // is the part of the light that still comes from it.  Otherwise they are null and 0.
  std::shared_ptr<const FrameState> vanishing;
  double vanishing_part = 0;
};

// Returns the bodies of a show with the magnitudes that they have then.
std::vector<Body> bodies_at(const Show& show, const FrameSettings& settings);

// Returns the state of a frame, from 0 to frame_count(show) - 1.  Frame n shows the instant n /
// frames_per_second.
FrameState frame_state(const Show& show, int frame);

// Returns the states in the middles of `count` (>= 1) equal parts of the time for which the shutter
// of a state's frame is open.  That time is cut off at the ends of the frame's segment, so that a cut
// is not blurred.  They have the state's projection, which a caller may have changed, with fields
// of view of their own where it has a variable one, and everything else of the show.
std::vector<FrameState> exposure_states(const Show& show, const FrameState& state, int count);

// A CameraMotion says whether a camera moves on with time, or stays as it is: at its r or l, with its
// speed and its axes, while the sky turns and time goes on as they do for the observer.
enum class CameraMotion { kMoves, kStays };

// Returns the observer of a state's segment so many frames after the state's instant, or before it
// where that is negative, but within the segment.
ObserverState observer_after(const Show& show, const FrameState& state, double frames,
                             CameraMotion camera);
// Returns how many frames after the state's instant its segment begins (<= 0) and ends (>= 0).
struct SegmentSpan {
  double begin, end;
};
SegmentSpan segment_span(const Show& show, const FrameState& state);

// Returns the view that a dissolve shows more of: the state itself, or the vanishing one as long as
// that has more of the light.
inline const FrameState& dominant_view(const FrameState& state) {
  return state.vanishing_part > 0.5 ? *state.vanishing : state;
}

}  // namespace domefall
