// These functions read the sections of a show, as docs/show-format.md describes them.  A section in
// error leaves its defaults, so that what depends on it is still checked.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "pipeline/show/file/lookup.h"
#include "pipeline/show/file/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// ---- the picture ----

// Reads `stars`: the point-spread law, the saturation and the least radius of stars.  Also sets the
// gain that they have in skies for which read_sky() finds none.
void read_stars(const Section& show, Show& to);
// The disc of `of` must have been read.
Exposure read_exposure(const Section& show, const Show& of);
// The bodies and the disc of `of` must have been read.
Glare read_glare(const Section& show, const Show& of);
Effects read_effects(const Section& show);
// Reports `lensing: false` if a frame lies on or inside a horizon, where no frame is at rest whose
// straight lines light could follow.  `root` is the whole file, and `show` must have been read
// without a mistake.
void check_effects(const Item& root, const Show& show);
// Reads `grade`.  The shipped configuration stands in where none is named.
GradeSettings read_grade(const Section& show, const Lookup& lookup);
// Only a domemaster can have the light of the dome simulated or compensated.
DomeSettings read_dome(const Section& show, const Projection& projection);
Output read_output(const Section& show);

// ---- what is seen ----

// Reads `sky` into `show`.  A shipped file that is missing is reported at `root`, the whole file,
// since the section may be left out.
void read_sky(const Item& root, const Section& section, Lookup& lookup, Show& show);
// Reports the sky of a next universe that cannot be reached.
void fail_next_sky(const Item& next, const Spacetime& spacetime);
// Reads the background that a segment has in a region.  That of the show stands for what the keys of
// the region leave out.
void read_segment_background(const Section& keys, SkyRegion region, const Lookup& lookup,
                             const RegionSky& of_show, std::optional<SkyBackground>& background);

// An OrbitPlane is that of what rises to the north at `node` and circles counter-clockwise about
// `normal`, both on the sky.
struct OrbitPlane {
  SkyDirection node, normal;
};
// Reads `inclination_deg` and `node_deg`, which are against the plane of an orbit that sets out as
// `to` says.
OrbitPlane read_orbit_plane(const Section& s, const Show& to);

// Reads `disc`, or returns nothing where the show has none.  The black hole of `to` must have been
// read, here and for `bodies`.
std::optional<Disc> read_disc(const Section& show, const Show& to, const Lookup& lookup);
// Reads `halo` and `jet`, after the disc of `to`, which they must be able to shine through.
std::optional<Halo> read_halo(const Section& show, const Show& to);
std::optional<Jet> read_jet(const Section& show, const Show& to);

std::vector<Body> read_bodies(const Section& show, const Show& to, Lookup& lookup);
// Reports a body that is so large that it reaches the hole, and one with more light than the
// renderer's floats hold, at `light` or, if it has a size of its own, at `own_size`.
void check_body(const Body& body, const Spacetime& spacetime, const Item& light,
                const Item* own_size);

// A TitleSpan is the part of the show that titles belong to, in show seconds.  Their times count
// from its beginning, and none lasts beyond its end.
struct TitleSpan {
  double begin_s, end_s;
};
// Reads the titles of a section of a show whose projection and markers are known.
std::vector<Title> read_titles(const Section& section, const TitleSpan& span, const Show& show,
                               Lookup& lookup);

// ---- cameras ----

// CameraKeys hold what a camera section says.  Those of a segment are laid over the show's, key by
// key.
struct CameraKeys {
  std::optional<Attitude> attitude;
  std::optional<CameraFrame> frame{};
  std::vector<AttitudeKey> track;  // of `file`, which excludes an attitude; empty without one
  ChannelValues values;            // of kRoll, kElevation, kDomeTilt and kFov
};

// A ShowCamera is what the show's own sections say, from which all other cameras start.  Camera
// sections may refer by name to the entries of `cameras`, to keyframes that bear a name, and to
// bodies.
struct ShowCamera {
  Projection projection;
  double frames_per_second = 0;
  CameraKeys keys;
  std::map<std::string, CameraKeys, std::less<>> cameras;
  std::map<std::string, Attitude, std::less<>> keyframes;
  std::map<std::string, std::shared_ptr<const Body>, std::less<>> bodies;
};

// Reads the camera of `to`, its `cameras`, and its `size`, which depends on the projection.  The
// rate and the bodies of `to` must have been read.
ShowCamera read_show_camera(const Section& show, const Show& to, Lookup& lookup);

// Reads the camera of a segment or a keyframe, which is the name of an entry of `cameras` or a map.
CameraKeys read_camera(const Item& item, const ShowCamera& show, Lookup& lookup);

// Returns one camera's keys with those of another, `own`, laid over them.  A new attitude replaces
// the old one.  Euler angles drop the roll and the elevation that went with a target.
CameraKeys laid_over(CameraKeys keys, const CameraKeys& own);

// Returns the camera with its defaults filled in.  By default it looks at the hole, which stands 45
// degrees above the rim of a dome.
Camera camera_from(const CameraKeys& keys, const Projection& projection);

// ---- what changes along the show ----

// Reads `cdl: {slope, offset, power, saturation}` of a section `grade` into the CDL's channels.
void read_cdl(const Section& grade, ChannelValues& values);

// Reads `exposure: {ev}`, `grade: {cdl}` and the numbers of `sky`, `disc` and `title_light` of a
// segment or a keyframe of `show`.  For a segment, whose skies may have backgrounds, `read_background` is called
// with the keys of each region.
using BackgroundReader = std::function<void(SkyRegion region, const Section& keys)>;
ChannelValues read_values(const Section& section, const Show& show,
                          const BackgroundReader& read_background = {});

// Magnitudes are those that a segment or a keyframe gives to the bodies of its show, in their order.
using Magnitudes = std::vector<std::optional<double>>;
Magnitudes read_magnitudes(const Section& section, const Show& show);

struct Keyframe {
  double at_s = 0;  // show seconds
  Ease ease = Ease::kSmooth;
  std::optional<Attitude> attitude;
  ChannelValues values;
  Magnitudes magnitudes;
};

// A KeyframeSpan is the part of the show for which a list of keyframes is given.
struct KeyframeSpan {
  double start = 0;   // the show's second from which at_s counts
  double latest = 0;  // the largest at_s allowed
};

// Reads a list of keyframes, whose times must ascend.  Keyframes that bear a name are entered into
// `camera`.
std::vector<Keyframe> read_keyframes(const Item& item, const KeyframeSpan& span, const Show& show,
                                     ShowCamera& camera, Lookup& lookup);

// Returns the curve through the keyframes that give a number, or nothing if none does.  The curve
// begins at `start` with `value_there`, the value without keyframes, unless a keyframe stands there.
using NumberOf = std::function<std::optional<double>(const Keyframe&)>;
std::optional<Curve> curve_through(const std::vector<Keyframe>& keyframes,
                                   const NumberOf& number_of, double start, double value_there);
// Returns the attitudes of the keyframes that give one, which begin in the same way with
// `attitude_there`.  The list is empty if no keyframe gives one.
std::vector<AttitudeKey> attitudes_through(const std::vector<Keyframe>& keyframes, double start,
                                           const Attitude& attitude_there);

// ---- the timeline ----

// Reads `fade_in_s` and `fade_out_s` of a show, a segment or a title.
Fades read_fades(const Section& section);
// Reports fades that together last longer than the show, segment or title which they begin and end.
// `of` is its name in the message ("the show").
void check_fades(const Section& section, const Fades& fades, double duration, const char* of);

// Reads the segments of a `show` that has everything else already, except for its titles, its
// output and the settings of its dome, and finds the times of markers that name events.
void read_timeline(const Section& section, const ShowCamera& camera, Lookup& lookup, Show& show);

// Reads the section `wormhole`, but not where it stands.
Wormhole read_wormhole(const Section& s);

}  // namespace domefall
