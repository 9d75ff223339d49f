// A Show is all that a show file says, checked, in the units of the program (M, radians) and with
// every default filled in.  docs/show-format.md describes the file key by key.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "pipeline/base/lettering.h"
#include "pipeline/grade/grade_settings.h"
#include "pipeline/image/encode/exr_writer.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/image/layer.h"
#include "pipeline/show/body.h"
#include "pipeline/show/camera.h"
#include "pipeline/show/channel.h"
#include "pipeline/show/curve.h"
#include "pipeline/show/overlay_kind.h"
#include "pipeline/show/placement.h"
#include "pipeline/sources/colour/colour_space.h"
#include "pipeline/sources/disc/disc.h"
#include "pipeline/sources/disc/gas.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "pipeline/spacetime/regions.h"
#include "pipeline/spacetime/spacetime.h"
#include "projections/projection.h"
#include "trajectories/gyroscope.h"
#include "trajectories/trajectory.h"

namespace domefall {

// ---- the backgrounds of skies ----

struct BlackSky {
  bool operator==(const BlackSky&) const = default;
};
// GridSky is the built-in test sky of [Riazuelo] sec. ssec_bckgsky: a checkerboard with squares of
// 5 degrees, and polar discs of 2000 K, 5 degrees wide.  The squares are blackbodies of 8000 K in
// two intensities, a factor of 4 apart.
struct GridSky {
  bool operator==(const GridSky&) const = default;
};
// PanoramaSky is an equirectangular image in equatorial coordinates (J2000), as seen from inside.
struct PanoramaSky {
  std::filesystem::path image;
  // The luminance that the file's values stand for by themselves is multiplied by this factor.
  double brightness = 1;
  // This luminance (cd/m^2, before the gain) is taken from the light of a map, so that what has no
  // more of it is black.  If none is given, it is the map's own dark level.
  std::optional<double> black{};

  bool operator==(const PanoramaSky&) const = default;
};
// RingsSky is lit by "a series of rings of variable t", [Riazuelo] sec. sec_Kruskal: light that
// left the past singularity at t glows with 1 + cos(2 pi t/period).  Only region IV has this
// background.
struct RingsSky {
  double period = 4;  // M, > 0

  bool operator==(const RingsSky&) const = default;
};
using SkyBackground = std::variant<BlackSky, GridSky, PanoramaSky, RingsSky>;

// ---- the timeline ----

// A Pace says how proper time runs from a segment's first to its last instant.
enum class Pace {
  kSteady,  // evenly, or by a rate that changes smoothly from the first instant's to the last one's
  kEased,   // from standstill to standstill
  kSlowing,     // so that the time left to the singularity shrinks by equal factors in equal show
                // times: log r falls evenly, and the end is not over in a frame
  kQuickening,  // the same backwards, from the past singularity on
  kLogRadius    // so that log r changes evenly; r goes one way
};

// A Timing says which part of its trajectory a segment shows, and how the observer's clock runs
// meanwhile.
struct Timing {
  // The segment's first and last instant have these proper times of the trajectory.
  ProperTime tau_begin, tau_end;
  Pace pace = Pace::kSteady;
  // These are the rates of proper time at both ends with kSteady, as parts of the mean rate
  // (part_passed).
  double rate_begin = 1, rate_end = 1;
};

// An AttitudeKey is a camera's attitude at an instant, which holds or turns into the next one's.
struct AttitudeKey {
  double at_s;  // show seconds
  Attitude attitude;
  Ease ease = Ease::kSmooth;  // of the turn that ends here
  // These rotation vectors (axis times angle, radians) lead from the attitude before to this one,
  // at equal steps of the way.  Rotations that are whole turns apart lead to the same axes, and the
  // vectors tell which of them continues the step before.  While the list is empty, they are found
  // anew for every frame.
  std::vector<V3d> turns{};
};

// A SkyFigure is the lines of a constellation, each through two places or more.
using SkyFigure = std::vector<std::vector<SkyDirection>>;

// A Title is a text on the dome.
struct Title {
  std::string text;  // UTF-8; lines end in '\n'; title_text.h has the meaning of braces
  LetterStyle style;
  double begin_s = 0, end_s = 0;  // show seconds
  Fades fades;
  // The text stands below the image of this place on the sky, if there is one, as the lens and the
  // motion show it.
  std::optional<SkyDirection> place{};
  SkyFigure figure{};  // is drawn on the sky in the same light
  // Or it stands below the direct image of this body of the show.
  std::optional<std::size_t> body{};
  // Otherwise the middle of the text stands here (radians): to the right of the audience's front,
  // and above their horizon or, on a flat image, above the line of sight.
  double azimuth = 0, elevation = 0;
  double height = 0;          // of a capital H, radians
  WorkingRgb light{1, 1, 1};  // pixel values, which no exposure or fade of the show acts on
  // These parts of the light are taken away behind the whole text, and close around its letters.
  double plate = 0, shadow = 0;
};

struct Segment {
  std::string type = "static";  // of its trajectory, in the words of show files
  double duration_s = 0;        // show seconds, > 0
  // The segment's first seconds are also the last ones of the segment before, which fades into this
  // one.
  double dissolve_s = 0;
  Fades fades;
  Trajectory trajectory;
  Timing timing;
  Placement placement;
  Camera camera;      // holds wherever nothing is keyframed
  bool aims = false;  // whether that has a direction of the segment's own
  // The keys stand in ascending order.  Where there are none, the camera keeps its attitude.
  std::vector<AttitudeKey> attitudes;
  std::vector<Title> titles;
  // A channel has a curve if the show or the segment keyframes it, or if the segment has a value of
  // its own for it.
  PerChannel<std::optional<Curve>> curves;
  // In the same way, of the bodies of the show in their order.
  std::vector<std::optional<Curve>> magnitudes;
  PerSky<std::optional<SkyBackground>> backgrounds;  // none where the show's stays
};

// ---- the sky ----

struct StarField {
  std::filesystem::path catalogue;
  double max_magnitude = 9;
  std::optional<double> planets_year{};  // the planets are among the stars, where they are then

  bool operator==(const StarField&) const = default;
};

struct RegionSky {
  SkyBackground background;
  double background_gain = 1;  // artistic; 1 is physical
  std::optional<StarField> stars;
  double star_gain = 1;  // artistic; 1 is physical

  bool operator==(const RegionSky&) const = default;
};

// A panorama has no spectra.  At the frequency ratio g = 1/(1+z) its intensity is multiplied by
// g^power for blueshift, and by exp(1 - 1/g) for redshift.  [Riazuelo] sec. ssec_rgb.
struct PanoramaShift {
  double blueshift_power = 2;
};

// The default of Show::least_star_radius is a ninth of a pixel of a 4k dome.
inline constexpr double kLeastStarRadiusDeg = 0.005;

// A PointSpreadLaw says how the light of stars is spread over pixels.  A star is a truncated
// Gaussian in angle.  Without a halo its width grows with its observed magnitude m,
//     sigma = min_sigma max(1, 10^(0.4 growth (reference_magnitude - m))),
// up to max_sigma.  With a halo every star has the width min_sigma, and bright ones show the halo.
struct PointSpreadLaw {
  double min_sigma = 0;            // radians; the renderer takes 0.9 pixel where that is wider
  double growth = 0.2;             // with 0 all stars have the same size, with 0.5 the same peak
  double reference_magnitude = 5;  // fainter stars have min_sigma
  double max_sigma = 0;            // radians
  double halo = 0;                 // the part of a star's light in its halo; 0 without one
  double halo_sigma = 0;           // radians
  double white_core = 0;  // pixel value at which a star's colour is half white; 0 for never
};

// Returns the gain that stars have where a show names none.  With a halo it makes them one magnitude
// fainter than in nature against the sky between them, since 10^-0.4 is about 0.4.  Otherwise a dome
// of 4096 pixels would show stars of V = 9 as bright as the heart of the Milky Way, and fields of
// stars would look uniform.  The law of the paper has its own balance.
inline double default_star_gain(const PointSpreadLaw& law) { return law.halo > 0 ? 0.4 : 1; }

// The luminance (cd/m^2) of pixel value 1 at 0 EV is ten times that of the Milky Way's brightest
// part.
inline constexpr double kReferenceLuminance = 1e-3;

struct Exposure {
  double ev = 0;  // stops; pixel value 1 is kReferenceLuminance / 2^ev
  // The shutter is open for this part of the time between two frames, about each frame's instant.
  // A frame is the mean of what is seen meanwhile, and with 0 it is what is seen at that instant.
  double shutter = 0;
};

// A Glare says how eye or lens scatter light in small angles.  A part `share` of all light is spread by
// kGlareGaussians, whose widths are in units of sigma (a standard deviation) and whose shares add up
// to 1.  The narrow halo of stars, PointSpreadLaw::halo, comes on top.
struct Glare {
  double share = 0, sigma = 0.5 * std::numbers::pi / 180;  // radians
};
struct GlareGaussian {
  double width, share;
};
inline constexpr GlareGaussian kGlareGaussians[] = {{1, 0.48}, {4, 0.28}, {15, 0.16}, {50, 0.08}};

// ---- the physics ----

// An Amplification says what is brightened by the magnification f of [Riazuelo] eq. eq_ampl.
enum class Amplification {
  kNone,        // nothing, so that a star keeps its flux however large its image would be
  kStars,       // point sources, as in nature
  kEverything,  // backgrounds too, as in [Riazuelo] fig. fig_dev3; in nature their brightness per
                // solid angle stays the same
};

// A show may leave out effects, to show the others one at a time ([Riazuelo] app. app_img).  The
// default is nature, and docs/show-format.md says what each effect means.
struct Effects {
  bool aberration = true;
  bool doppler_colour = true;  // the colour of every frequency shift, gravitational ones too
  bool intensity = true;       // the intensity of the same shifts
  bool lensing = true;         // a show without it has all its frames at r > 2
  Amplification amplification = Amplification::kStars;

  bool operator==(const Effects&) const = default;
};

// The words by which show files and the preview name the effects.
inline constexpr std::array<std::pair<std::string_view, bool Effects::*>, 4> kEffectSwitches{
    {{"aberration", &Effects::aberration},
     {"doppler_colour", &Effects::doppler_colour},
     {"intensity", &Effects::intensity},
     {"lensing", &Effects::lensing}}};
inline constexpr std::pair<std::string_view, Amplification> kAmplifications[] = {
    {"stars", Amplification::kStars},
    {"none", Amplification::kNone},
    {"everything", Amplification::kEverything}};

// ---- the whole ----

// A MarkerEvent is the first instant at which the observer is at r, on a leg if one is given, or,
// without r, nearest to the hole on a way that leads away from it again.
struct MarkerEvent {
  std::optional<double> r;  // M
  std::optional<Leg> leg{};
  std::optional<double> l{};  // of a wormhole, instead of r
};

// A Marker is an instant of the show that bears a name.
struct Marker {
  std::string name;
  double at_s = 0;  // show seconds; NaN for an event until the timeline is known
  std::optional<MarkerEvent> event{};
};

// FrameNames say how the files of frames are called: NAME_00000 and so on.
struct FrameNames {
  std::string name;    // empty: as the show's file
  int start = 0;       // the number of frame 0
  int digits = 5;      // at least; a larger number has more
  int per_folder = 0;  // frames that share a folder of their own; 0: all are in one
};

// OutputData are numbers about a frame, as channels of 32 bits (docs/compositing.md).
struct OutputData {
  bool lens = false, mattes = false, cryptomatte = false;
  bool any() const { return lens || mattes || cryptomatte; }
};

// An Output says which files are made of a frame, at least one.
struct Output {
  std::optional<ExrFormat> linear = ExrFormat{};        // nothing: none
  std::optional<GradedFormat> graded = GradedFormat{};  // nothing: none
  std::vector<Layer> layers;  // of scene-linear files, each once, in the order of drawing
  bool layer_files = false;   // each layer has a file of its own
  OutputData data;            // of scene-linear files
  FrameNames names;
  std::string owner;  // of the pictures, named in the scene-linear files; empty: not named
};

// A Joint is what a segment takes over from those before it.
struct Joint {
  double begin_s = 0;  // the show second at which the segment begins
  M33d axes;           // of the observer's tetrad on the sky
  double azimuth = 0;
  DoubleDouble null_time{};
  Spacetime spacetime;  // of the show
  Region region = Region::kI;
  Tetrad tetrad = Tetrad::kRain;
  int universe = 0;  // of those that follow each other through a charged hole
  double r = kFlatSpace;
  std::shared_ptr<const Gyroscope> gyroscope{};  // of the segment, if its camera follows one
};

struct Show {
  std::filesystem::path file;
  std::string title;
  double frames_per_second = 30;
  std::optional<double> written_rate{};  // of the file, where it stands for frames_per_second
  Projection projection = Domemaster{4096};
  Spacetime spacetime;
  // At the start the hole stands at `hole_at` on the sky, and the motion of an orbit (Phi) sets out
  // at the position angle `heading` (radians, from north through east).  placement.h says how they
  // place an orbit.
  SkyDirection hole_at;
  double heading = 0;
  std::optional<double> begins_year;  // in which the show begins, if it matters
  std::vector<Segment> timeline;
  std::vector<Marker> markers;
  std::vector<Title> titles;  // beside those of segments
  bool draws_titles = true;
  std::vector<std::filesystem::path> audio;  // files with the sound of the show, or none
  std::vector<OverlayKind> overlays;         // which no show file asks for
  Fades fades;
  // There is one joint for each segment, found once when a show is read (join_segments in
  // observer_track.h).  A show that is assembled in another way has none, and each of its states
  // follows the timeline from its start.  Code that moves or alters a segment must clear the
  // joints.
  std::vector<Joint> joints;
  PerSky<RegionSky> sky;  // that of region IV, the past singularity, has no stars and no redshift
  std::vector<Body> bodies;
  // Stars are drawn in their places of this Julian year, if their catalogue knows their proper
  // motion.
  double star_epoch = kCatalogueEpoch;
  PanoramaShift panorama_shift;
  // These are only where there is a hole.  A disc beside a halo or a jet has a height.
  std::optional<Disc> disc;
  std::optional<Halo> halo;
  std::optional<Jet> jet;
  Effects effects;
  PointSpreadLaw point_spread;
  // The colours of stars are grey with 0, and as the CIE's standard observer sees them with 1.
  double star_saturation = 1;
  // A star has at least this angular radius, in radians.  It bounds the light of a star on the axis
  // of the lens, and makes an arc or a ring of one that stays there.
  double least_star_radius = kLeastStarRadiusDeg * std::numbers::pi / 180;
  Exposure exposure;
  Glare glare;
  GradeSettings grade;
  Output output;
};

inline constexpr int kMostFrames = 10'000'000;

// Reads the stars of a field of V <= max_magnitude, and the planets if it has them.  Arguments and
// errors are those of read_star_catalogue.
StarCatalogue read_star_field(const StarField& field, double max_magnitude, double epoch,
                              std::size_t whole = kAllWhole);

inline const Segment& segment_of(const Show& show, int k) {
  return show.timeline[static_cast<std::size_t>(k)];
}

// Returns the background that a segment has in a region: its own one, or else the show's.
const SkyBackground& background_of(const Show& show, int segment, SkyRegion region);

// Returns the value of a channel t seconds into the show: that of its curve, or else `constant`.
double value_at(const Segment& segment, Channel channel, double t, double constant);

// Returns each curve of a segment with its key in show files.
std::vector<std::pair<std::string, const Curve*>> curves_of(const Show& show,
                                                            const Segment& segment);

// Returns the show seconds at which each segment begins and, as the last element, at which the show
// ends.
std::vector<double> segment_times(const Show& show);

// Returns the frame whose instant is nearest to a time, which is the last one for the end.
int nearest_frame(const Show& show, double time_s);

// Returns the show second at which the show ends.
double end_of(const Show& show);

// Returns the number of frames: the show's length times the frame rate, rounded to the nearest
// whole number (halves away from zero), but at least 1.  Frame n shows the instant n /
// frames_per_second, so a show of 2 s at 30 frames per second has the frames 0 to 59 and ends just
// before the instant 2 s.
int frame_count(const Show& show);

}  // namespace domefall
