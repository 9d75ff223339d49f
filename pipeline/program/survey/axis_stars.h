// A star straight behind the hole is seen as a ring, which blinds where the sky stands still or
// moves slowly.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pipeline/program/survey/show_warnings.h"
#include "pipeline/render/scene/scene_stars.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// A star is reported if all its images together are brighter than this magnitude at 0 EV.  The
// images of a star of first magnitude behind a hole at 14 M have -6.4 with a radius of 0.05
// degrees, which makes a calm ring.
inline constexpr double kBlindingMagnitude = -7.5;

// An AxisStars is shown the states of a show one by one, in the order of frames.  It remembers
// those in which a star comes so near to the axis of the lens that its light may blind, which takes
// a microsecond for each state.  The brightest frame of each such passage is then looked at in
// full.
class AxisStars {
 public:
  // Reads the bright stars of the show's catalogues.  The show must outlive this object.  Throws
  // InputError if a catalogue cannot be read.
  explicit AxisStars(const Show& show);

  void add(const FrameState& state);

  // Returns one warning for each passage, in the order of time, but 50 at most.  A warning gives
  // the radius (stars.least_radius_deg) that would dim the star enough.
  std::vector<ShowWarning> warnings() const;

 private:
  struct Candidate {
    SceneStar star;
    double window;  // the largest sine of its angle from the axis at which it may blind
  };
  // The stars of a class have about the same brightness.  They are sorted by the z of their
  // directions.
  struct Class {
    std::vector<Candidate> stars;
    double window = 0;  // the largest window of its stars
  };
  struct Passage {
    SkyRegion region;
    const Candidate* star;
    int frame, last_frame;
    bool vanishes;  // whether the star is in the view that vanishes in that frame
    double light;   // about proportional to the star's light in that frame
  };

  void read(SkyRegion region);
  std::string name_of(const Passage& passage) const;
  void add(const FrameState& state, bool vanishes);
  void note(const Passage& found);
  double magnitude(const Show& show, const Passage& passage) const;

  const Show& show_;
  PerSky<std::vector<Class>> stars_;
  PerSky<std::vector<NamedStar>> names_;
  std::vector<Passage> passages_;
  std::vector<std::size_t> recent_;  // indices of passages seen in the last two frames
};

}  // namespace domefall
