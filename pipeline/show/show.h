// A show as data: everything a YAML show file says, validated and in inside units (M, radians),
// with every default filled in.  docs/show-format.md describes the file key by key.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/grade/grade_settings.h"
#include "pipeline/sky/star_catalogue.h"
#include "projections/projection.h"
#include "trajectories/trajectory.h"

namespace domefall {

// ---- what the camera does ----

// [Riazuelo] sec. sec_cam: rotations by phi about C, vartheta about B', psi about C', of the
// boosted (Theta, Phi, R).  Radians.
struct EulerAngles {
  double phi = 0, vartheta = 0, psi = 0;
};
struct LookAtHole {};
struct LookAlongMotion {};  // against the static frame, continued smoothly inside the horizon
struct LookAtSky {          // at the primary image of a place on sky I, lensing included
  SkyDirection target;
};
using Attitude = std::variant<LookAtHole, LookAlongMotion, LookAtSky, EulerAngles>;

struct Camera {
  Attitude attitude = LookAtHole{};
  double roll =
      0;  // radians, about the line of sight, clockwise on the image; not with Euler angles
  double elevation = 0;  // radians above the dome's front rim at which a look-at target stands;
                         // Domemaster only
  double dome_tilt =
      0;  // radians by which the theatre's dome leans towards the front: the image is
          // turned so that what stood at elevation e stands at e + dome_tilt
};

// ---- the timeline ----

// How proper time runs from a segment's first to its last instant.
enum class Pace {
  kSteady,  // evenly
  kSlowing,  // so that the time left to the singularity shrinks by equal factors in equal show times:
  // a fall in which log r falls evenly, and neither the way in is long nor the end a flash
};

struct Segment {
  double duration_s = 0;  // show seconds, > 0
  Trajectory trajectory;
  // Proper time of the trajectory at the segment's first and last instant, units of M (seconds in
  // flat space).
  double tau_begin = 0, tau_end = 0;
  Pace pace = Pace::kSteady;
  Camera camera;
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
// of rings of variable t", [Riazuelo] sec. on region IV.
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

// A star is a truncated Gaussian in angle.  Its width grows with its (observed) brightness:
// sigma = min_sigma * max(1, 10^(0.4 growth (reference_magnitude - m))), at most max_sigma.
struct StarBlobs {
  double min_sigma = 0;            // radians; the renderer never goes below 0.9 pixel
  double growth = 0.2;             // 0: every star the same size; 0.5: every star the same peak
  double reference_magnitude = 5;  // up to here min_sigma
  double max_sigma = 0;            // radians
};

struct Exposure {
  double ev = 0;  // stops: pixel value 1 is kReferenceLuminance / 2^ev
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
  RegionSky sky_one, sky_three;  // skies of regions I and III
  // The past singularity, as a sphere seen by azimuth alone, without stars or redshift.
  RegionSky sky_four{BlackSky{}, 1, std::nullopt, 1};
  PanoramaShift panorama_shift;
  StarBlobs blobs;
  Exposure exposure;
  GradeSettings grade;
  GradedFormat graded_format = GradedFormat::kPng;
};

// GM/c^3 of the sun: seconds in one M of a hole of one solar mass (IAU 2015 nominal GM).
inline constexpr double kSecondsPerSolarMass = 4.925490947e-6;

inline constexpr int kMostFrames = 10'000'000;

// The durations' sum times the frame rate, rounded to the nearest whole number (halves away from
// zero), at least 1.  Frame n shows the instant n / frames_per_second, so a show of 2 s at 30
// frames per second has the frames 0 to 59 and ends just before the instant 2 s.
int frame_count(const Show& show);

}  // namespace domefall
