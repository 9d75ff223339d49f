// These functions read the section `camera` of a show, a segment or a keyframe, and the show's
// `cameras`.
#pragma once

#include <map>

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// CameraKeys hold what a camera section says.  Those of a segment are laid over the show's, key by
// key.
struct CameraKeys {
  std::optional<Attitude> attitude;
  ChannelValues values;  // of kRoll, kElevation, kDomeTilt and kFov
};

// Camera sections may refer by name to the entries of `cameras`, to keyframes that bear a name, and
// to bodies.
struct NamedCameras {
  std::map<std::string, CameraKeys, std::less<>> cameras;
  std::map<std::string, Attitude, std::less<>> keyframes;
  std::map<std::string, std::shared_ptr<const Body>, std::less<>> bodies;
};

// A ShowCamera is what the show's own sections say, from which all other cameras start.
struct ShowCamera {
  Projection projection;
  CameraKeys keys;
  NamedCameras named;
};

// Reads the show's `camera`, its `cameras`, and its `size`, which depends on the projection.
// Cameras may look at the bodies.
ShowCamera read_show_camera(const Section& show, const std::vector<Body>& bodies, Lookup& lookup);

// Reads the camera of a segment or a keyframe, which is the name of an entry of `cameras` or a map.
CameraKeys read_camera(const Item& item, const ShowCamera& show, Lookup& lookup);

// Returns one camera's keys with those of another, `own`, laid over them.  A new attitude replaces
// the old one.  Euler angles drop the roll and the elevation that went with a target.
CameraKeys laid_over(CameraKeys keys, const CameraKeys& own);

// Returns the camera with its defaults filled in.  By default it looks at the hole, which stands 45
// degrees above the rim of a dome.
Camera camera_from(const CameraKeys& keys, const Projection& projection);

}  // namespace domefall
