// The keys of `camera`, of the show and of a segment.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// What a camera section says; a segment's is laid over the show's, key by key.
struct CameraKeys {
  std::optional<Attitude> attitude;
  std::optional<double> roll, elevation, dome_tilt;  // radians
};

struct ShowCamera {
  Projection projection;
  CameraKeys keys;
};

ShowCamera read_show_camera(const Section& show, Lookup& lookup);

// The show's keys with a segment's laid over them.  A new attitude replaces the old one; Euler
// angles drop the roll and elevation of a look-at attitude.
CameraKeys read_segment_camera(const Item* item, const ShowCamera& show, Lookup& lookup);

// Fills in the defaults.
Camera camera_from(const CameraKeys& keys, const Projection& projection);

}  // namespace domefall
