// The keys of `camera`, of the show and of a segment.
#pragma once

#include <map>

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// What a camera section says; a segment's is laid over the show's, key by key.
struct CameraKeys {
  std::optional<Attitude> attitude;
  ChannelValues values;  // of kRoll, kElevation, kDomeTilt and kFov
};

// What camera sections may name: the entries of `cameras`, and keyframes that bear a name.
struct NamedCameras {
  std::map<std::string, CameraKeys, std::less<>> cameras;
  std::map<std::string, Attitude, std::less<>> keyframes;
};

struct ShowCamera {
  Projection projection;
  CameraKeys keys;
  NamedCameras named;
};

// The show's `camera` and `cameras`.
ShowCamera read_show_camera(const Section& show, Lookup& lookup);

// A camera of a segment or a keyframe: the name of an entry of `cameras`, or a map.
CameraKeys read_camera(const Item& item, const ShowCamera& show, Lookup& lookup);

// One camera's keys with another's laid over them.  A new attitude replaces the old one; Euler
// angles drop the roll and elevation of a look-at attitude.
CameraKeys laid_over(CameraKeys keys, const CameraKeys& own);

// Fills in the defaults.
Camera camera_from(const CameraKeys& keys, const Projection& projection);

}  // namespace domefall
