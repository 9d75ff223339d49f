// A show as data: everything a YAML show file says, validated and in inside units (M, radians),
// with every default filled in.  docs/show-format.md describes the file key by key.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/grade/grade_settings.h"
#include "pipeline/show/camera.h"
#include "pipeline/show/channel.h"
#include "pipeline/show/curve.h"
#include "pipeline/show/placement.h"
#include "pipeline/sky/catalogue/star_catalogue.h"
#include "projections/projection.h"
#include "trajectories/sky_region.h"
#include "trajectories/trajectory.h"

namespace domefall {

// ---- the timeline ----

// How proper time runs from a segment's first to its last instant.
enum class Pace {
  kSteady,   // evenly, or by rates that change smoothly from the first instant's to the last one's
  kEased,    // from standing still to standing still
  kSlowing,  // so that the time left to the singularity shrinks by equal factors in equal show
             // times: a fall in which log r falls evenly, and the end is no flash
  kQuickening  // the same backwards, from the past singularity on
};

// Which part of its trajectory a segment shows, and how the observer's clock runs meanwhile.
struct Timing {
  // Proper time of the trajectory at the segment's first and last instant, units of M (seconds in
  // flat space).
  double tau_begin = 0, tau_end = 0;
  Pace pace = Pace::kSteady;
  // kSteady: how fast proper time runs at both ends, as parts of the mean; 2 in sum.
  double rate_begin = 1, rate_end = 1;
};

// A direction of view from an instant on.
struct AttitudeKey {
  double at_s;  // show seconds
  Attitude attitude;
  Ease ease = Ease::kSmooth;  // of the turn that ends here
  // The turns (axis times angle, radians) from the attitude before to this one, at equal steps of the way
  // between them: which of the turns that lead to the same axes goes on from the one before.  Empty: found
  // anew for every frame.
  std::vector<V3d> turns{};
};

struct Segment {
  std::string type = "static";  // of its trajectory, in the words of show files
  double duration_s = 0;        // show seconds, > 0
  // Its first seconds lie over the last ones of the segment before; both are seen, the one fading
  // into the other.
  double dissolve_s = 0;
  Trajectory trajectory;
  Timing timing;
  Placement placement;
  Camera camera;                       // where nothing is keyframed
  std::vector<AttitudeKey> attitudes;  // keyframes in ascending order; empty: camera.attitude
  // Those channels have a curve that the show or the segment keyframes, or of which the segment has a
  // value of its own.
  PerChannel<std::optional<Curve>> curves;
};

// ---- the sky ----

struct BlackSky {};
// Built in: [Riazuelo] sec. ssec_bckgsky, 5-degree checkerboard of 8000 K blackbody squares, a
// factor 4 in intensity between light and dark, and 2000 K polar discs of 5 degrees diameter.
struct GridSky {};
// Equirectangular image, equatorial J2000, seen from inside.
struct PanoramaSky {
  std::filesystem::path image;
};
// Region IV only: light that left the past singularity at t glows with 1 + cos(2 pi t/period): "a series
// of rings of variable t", [Riazuelo] sec. sec_Kruskal.
struct RingsSky {
  double period = 4;  // M, > 0
};
using SkyBackground = std::variant<BlackSky, GridSky, PanoramaSky, RingsSky>;

struct StarField {
  std::filesystem::path catalogue;
  double max_magnitude = 6.5;
};

struct RegionSky {
  SkyBackground background;
  double background_gain = 1;  // artistic; 1 is physical
  std::optional<StarField> stars;
  double star_gain = 1;  // artistic; 1 is physical
};

// Intensity of a panorama without spectra at frequency ratio g = 1/(1+z): g^power for blueshift,
// exp(1 - 1/g) for redshift.  [Riazuelo] sec. ssec_rgb.
struct PanoramaShift {
  double blueshift_power = 2;
};

// A star is a truncated Gaussian in angle.  Without a halo its width grows with its (observed)
// brightness: sigma = min_sigma * max(1, 10^(0.4 growth (reference_magnitude - m))), at most max_sigma.
// With one, every star is of the width min_sigma, and bright ones show the halo.
inline constexpr double kWhiteCore = 10;
struct PointSpreadLaw {
  double min_sigma = 0;            // radians; the renderer never goes below 0.9 pixel
  double growth = 0.2;             // 0: every star the same size; 0.5: every star the same peak
  double reference_magnitude = 5;  // up to here min_sigma
  double max_sigma = 0;            // radians
  double halo = 0;                 // the part of a star's light that is in its halo
  double halo_sigma = 0;           // radians
  double white_core = 0;           // pixel value at which a blob's colour is half white; 0: none;
                                   // a show's default is kWhiteCore
};

struct Exposure {
  double ev = 0;  // stops: pixel value 1 is kReferenceLuminance / 2^ev
  // Part of the time between two frames for which the shutter is open, about each frame's instant: the
  // frame is the mean of what is seen meanwhile.  0: the instant alone.
  double shutter = 0;
};

// ---- the physics ----

// Whose brightness follows the magnification f of [Riazuelo] eq. eq_ampl.
enum class Amplification {
  kNone,        // nothing: a star keeps its flux however large its image would be
  kStars,       // point sources, as in nature
  kEverything,  // backgrounds too, whose true brightness per solid angle it does not change:
                // [Riazuelo] fig. fig_dev3
};

// Effects that a show may leave out, to show the others one at a time ([Riazuelo] app. app_img); the
// default is nature.  docs/show-format.md says what each means.
struct Effects {
  bool aberration = true;
  bool doppler_colour = true;  // of every frequency shift, gravitational ones too
  bool intensity = true;       // so does this
  bool lensing = true;         // false: every frame lies at r > 2
  Amplification amplification = Amplification::kStars;

  bool operator==(const Effects&) const = default;
};

// ---- the whole ----

enum class GradedFormat { kNone, kPng, kTiff };

struct Show {
  std::filesystem::path file;
  std::string title;
  double frames_per_second = 30;
  Projection projection = Domemaster{4096};
  // Solar masses; nothing: flat space.
  std::optional<double> mass_solar;
  // Where the hole is seen from afar at the start, and the position angle (radians, from north
  // through east) in which an orbit's motion (Phi) sets out as seen from the hole.
  SkyDirection hole_at;
  double heading = 0;
  std::vector<Segment> timeline;
  // The past singularity of region IV is a sphere seen by azimuth alone, without stars or redshift.
  PerSky<RegionSky> sky;
  // Julian year: stars of catalogues that know their proper motion stand where they stand then.
  double star_epoch = kCatalogueEpoch;
  PanoramaShift panorama_shift;
  Effects effects;
  PointSpreadLaw point_spread;
  Exposure exposure;
  GradeSettings grade;
  GradedFormat graded_format = GradedFormat::kPng;
};

// GM/c^3 of the sun: seconds in one M of a hole of one solar mass (IAU 2015 nominal GM).
inline constexpr double kSecondsPerSolarMass = 4.925490947e-6;

inline constexpr int kMostFrames = 10'000'000;

inline const Segment& segment_of(const Show& show, int k) {
  return show.timeline[static_cast<std::size_t>(k)];
}

// The value of a channel t seconds into the show: that of its curve, or else `constant`.
double value_at(const Segment& segment, Channel channel, double t, double constant);

// Show seconds at which each segment begins, and, last, at which the show ends.
std::vector<double> segment_times(const Show& show);

// The show's length times the frame rate, rounded to the nearest whole number (halves away from
// zero), at least 1.  Frame n shows the instant n / frames_per_second, so a show of 2 s at 30
// frames per second has the frames 0 to 59 and ends just before the instant 2 s.
int frame_count(const Show& show);

}  // namespace domefall
