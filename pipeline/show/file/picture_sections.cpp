// The sections of a show that say how its frames look and which files are made of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/base/utf8.h"
#include "pipeline/show/assets.h"
#include "pipeline/show/file/sections.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

// ---- stars ----

// The laws have defaults of their own for these.  The law of the size is the paper's, whose stars
// are white in their middle and of true colour at their edge.
constexpr double kPaperWhiteCore = 10, kPaperSaturation = 1;

// Reads the point-spread law.  Keys that only the other law has are reported.
PointSpreadLaw read_point_spread(const Section& s) {
  constexpr std::string_view kKeysOfSize[] = {"growth", "reference_magnitude", "max_sigma_deg"};
  constexpr std::string_view kKeysOfPsf[] = {"halo", "halo_sigma_deg"};
  // Without `law`, a key that only the law of the size has chooses that law.
  const bool sized =
      std::ranges::any_of(kKeysOfSize, [&](std::string_view key) { return s.find(key); });
  const bool psf = !s.given_word("law", {true, false}).value_or(sized);
  for (const std::string_view key : psf ? std::span(kKeysOfSize, 3) : std::span(kKeysOfPsf, 2))
    if (const Item* item = s.find(key))
      item->fail(psf ? "belongs to stars.law: size, but the law is psf"
                     : "belongs to stars.law: psf, but the law is size");
  const double least = s.number("min_sigma_deg");
  // A show that widens only the faint stars need not give the widest blob as well.
  const double most = s.find("max_sigma_deg") ? s.number("max_sigma_deg")
                                              : std::max(s.number("max_sigma_deg"), least);
  if (!psf && most < least)
    s.find("max_sigma_deg")
        ->fail(fmt::format("must be at least min_sigma_deg = {} (degrees), got {}",
                           short_number(least), as_written(*s.find("max_sigma_deg"))));
  return {.min_sigma = radians(least),
          .growth = s.number("growth"),
          .reference_magnitude = s.number("reference_magnitude"),
          .max_sigma = radians(most),
          .halo = psf ? s.number("halo") : 0,
          .halo_sigma = psf ? s.angle("halo_sigma_deg") : 0,
          .white_core = psf ? s.number("white_core") : s.number("white_core", kPaperWhiteCore)};
}

// ---- effects ----

// Returns the state on or inside a horizon among those that make up a frame, or null if there is
// none.  A frame has one state, or two in a dissolve.
const FrameState* within(const FrameState& state) {
  if (!has_rest(state.observer)) return &state;
  return state.vanishing ? within(*state.vanishing) : nullptr;
}

// Returns a frame on or between the horizons of a charged hole, which an observer may pass within a
// segment.
std::optional<FrameState> frame_between_horizons(const Show& show) {
  for (int frame = 0; frame < frame_count(show); ++frame) {
    const double t = frame / show.frames_per_second;
    const int segment = segment_at(show, t);
    if (!has_rest(observer_at(show, segment, part_at(show, segment, t))))
      return frame_state(show, frame);
  }
  return std::nullopt;
}

// Returns a frame on or inside a horizon, if there is one.  What falls in stays inside to the end
// of its segment, and what comes out of the white hole is inside at its start.  So it is enough to
// test the frames next to the ends of segments and of dissolves.
std::optional<FrameState> frame_within(const Show& show) {
  if (show.spacetime.is<ChargedHole>() || show.spacetime.is<SpinningHole>())
    return frame_between_horizons(show);
  const int last = frame_count(show) - 1;
  std::vector<double> ends = segment_times(show);
  for (std::size_t k = 0; k < show.timeline.size(); ++k)
    ends.push_back(ends[k] + show.timeline[k].dissolve_s);
  for (const double seconds : ends) {
    const int end = static_cast<int>(std::lround(seconds * show.frames_per_second));
    // The nearest frame and its neighbours lie on both sides of the end.
    for (int frame = std::max(end - 1, 0); frame <= std::min(end + 1, last); ++frame) {
      const FrameState state = frame_state(show, frame);
      if (const FrameState* found = within(state)) return *found;
    }
  }
  return std::nullopt;
}

// ---- output ----

// Reads the quality, which only JPEGs have, and the alpha, which they have not.
void read_graded_details(const Section& s, std::optional<GradedFormat>& graded) {
  const bool jpeg = graded && graded->kind == GradedKind::kJpeg;
  const int quality = s.whole("quality");
  if (jpeg)
    graded->quality = quality;
  else if (const Item* item = s.find("quality"))
    item->fail("is that of a JPEG; say graded: jpeg, or leave it out");
  const bool alpha = s.flag("graded_alpha");
  if (alpha && (jpeg || !graded))
    s.find("graded_alpha")->fail("is for PNG and TIFF; say graded: png16, or leave it out");
  else if (graded)
    graded->alpha = alpha;
}

// Reads the format of the scene-linear files, or returns nothing if there are to be none.
std::optional<ExrFormat> read_linear(const Section& s) {
  using enum ExrCompression;
  const auto compression = s.word("compression", {kZip, kZips, kPiz, kNone});
  const auto pixels = s.word<std::optional<ExrPixels>>(
      "linear", {ExrPixels::kHalf, ExrPixels::kFloat, std::nullopt});
  if (pixels) return ExrFormat{*pixels, compression};
  if (const Item* item = s.find("compression"))
    item->fail("is that of scene-linear files, of which linear: none makes none; leave it out");
  return std::nullopt;
}

// Reads a list of words about scene-linear files, and returns their places in `known`.
std::set<std::size_t> read_parts(const Section& s, const char* key, bool linear,
                                 const std::vector<std::string_view>& known) {
  const Item* list = s.find(key);
  if (!list) return {};
  if (!linear) list->fail("are in scene-linear files, of which linear: none makes none");
  std::set<std::size_t> parts;
  for (const Item& item : read_list(*list).value_or(std::vector<Item>{})) {
    const auto index = read_choice(item, known);
    if (index && !parts.insert(*index).second)
      item.fail("is listed twice: " + std::string(known[*index]));
  }
  return parts;
}

std::vector<Layer> read_layers(const Section& s, bool linear) {
  std::vector<std::string_view> known(kLayers.size());
  std::transform(kLayers.begin(), kLayers.end(), known.begin(),
                 [](const LayerKind& kind) { return kind.name; });
  std::vector<Layer> layers;  // in the order of drawing
  for (const std::size_t index : read_parts(s, "layers", linear, known))
    layers.push_back(static_cast<Layer>(index));
  return layers;
}

OutputData read_data(const Section& s, bool linear) {
  const auto parts = read_parts(s, "data", linear, {"lens", "mattes", "cryptomatte"});
  return {parts.contains(0), parts.contains(1), parts.contains(2)};
}

// Reads the name that the files of frames begin with, which must name a visible file and no folder.
std::string read_name(const Section& s) {
  constexpr std::size_t kLongest = 200;  // bytes; file systems take 255 with number and kind
  std::string name = s.text("name");
  // A folder in the name would be another place than the one that --out names.
  if (name.find('/') != std::string::npos)
    s.find("name")->fail("is that of a file and may have no '/'; --out names the folder");
  else if (name.starts_with('.'))
    s.find("name")->fail("may not begin with a dot, which hides files");
  else if (name.size() > kLongest)
    s.find("name")->fail(fmt::format("may have {} bytes, got {}", kLongest, name.size()));
  return name;
}

}  // namespace

void read_stars(const Section& show, Show& to) {
  const Section s(show.find("stars"), {"stars"});
  to.point_spread = read_point_spread(s);
  to.star_saturation =
      to.point_spread.halo > 0 ? s.number("saturation") : s.number("saturation", kPaperSaturation);
  const double gain = default_star_gain(to.point_spread);
  for (const SkyRegion region : kExteriorSkies) to.sky[region].star_gain = gain;
  to.least_star_radius = s.angle("least_radius_deg");
}

Exposure read_exposure(const Section& show, const Show& of) {
  const Section s(show.find("exposure"), {"exposure", "shutter"});
  s.one_of({"ev", "disc"});
  double ev = s.number("ev");
  const auto value = s.given("disc");
  if (value && !of.disc) s.find("disc")->fail("needs a disc: give the show one");
  if (value && of.disc) {
    constexpr double kMost = 30;
    ev = std::log2(*value * kReferenceLuminance / of.disc->luminance);
    if (ev > kMost)
      s.find("disc")->fail(
          fmt::format("would need {:.3g} stops of exposure, and {} are the most", ev, kMost));
  }
  // A film camera's shutter of 360 degrees is open from one frame to the next.
  return {ev, s.number("shutter_deg") / 360};
}

// Only what is brighter than skies by far glares visibly, and all others save the time.
Glare read_glare(const Section& show, const Show& of) {
  const Section s(show.find("glare"), {"glare"});
  constexpr double kBesideGlowingMatter = 0.12;
  const bool glows =
      of.disc || of.halo || of.jet ||
      std::ranges::any_of(of.bodies, [](const Body& body) { return body.radius > 0; });
  return {s.number("share", glows ? kBesideGlowingMatter : 0), s.angle("width_deg")};
}

Effects read_effects(const Section& show) {
  const Section s(show.find("effects"), {"effects"});
  Effects effects;
  for (const auto& [name, effect] : kEffectSwitches) effects.*effect = s.flag(name);
  using enum Amplification;
  effects.amplification = s.word("amplification", {kStars, kNone, kEverything});
  return effects;
}

void check_effects(const Item& root, const Show& show) {
  if (show.effects.lensing) return;
  const auto effects = peek(root, "effects");
  const auto lensing = effects ? peek(*effects, "lensing") : std::nullopt;
  const Item& asked = lensing ? *lensing : root;
  if (show.spacetime.is<SpinningHole>()) {
    asked.fail("must be true about a hole that spins");
    return;
  }
  const auto found = frame_within(show);
  if (!found) return;
  asked.fail(
      fmt::format("can be false outside the horizon only (r > {}), but frame {}, in "
                  "timeline[{}], lies at r = {} (units of M)",
                  short_number(show.spacetime.horizon()), found->frame, found->segment + 1,
                  short_number(found->observer.r)));
}

GradeSettings read_grade(const Section& show, const Lookup& lookup) {
  const Section s(show.find("grade"), {"grade", "grade.cdl"});
  GradeSettings grade{.config = shipped_asset(kDomeConfig), .shipped = true};
  const std::string config = s.text("config");
  if (in_lower_case(config).starts_with("ocio://"))
    s.find("config")->fail(
        "names a configuration that OpenColorIO 2.2 and later have built in; this build has "
        "OpenColorIO 2.1, which has none; name a file, got '" +
        shown(config) + "'");
  else if (!config.empty())
    if (const auto file = lookup.file(*s.find("config"), config))
      grade.config = *file, grade.shipped = false;
  // Only the configuration knows its displays and views, so these names are checked when it is
  // loaded.
  grade.display = s.text("display");
  grade.view = s.text("view");
  ChannelValues values;
  read_cdl(s, values);
  // Numbers that the show does not give leave the picture as it is.
  grade.cdl =
      cdl_from([&](Channel channel, double neutral) { return values[channel].value_or(neutral); });
  return grade;
}

DomeSettings read_dome(const Section& show, const Projection& projection) {
  const Section s(show.find("dome"), {"dome"});
  using enum DomeSettings::Light;
  const DomeSettings dome{s.word("light", {kNone, kSimulate, kCompensate}),
                          s.number("reflectance")};
  // Every part of the dome lights every other one, so that the sum needs the whole half sphere.
  if (dome.light != kNone && !is_domemaster(projection))
    s.find("light")->fail(has_zenith(projection)
                              ? "is for a whole half sphere, which the projection domemaster shows"
                              : "is for domes; this projection is flat");
  return dome;
}

Output read_output(const Section& show) {
  const Section s(show.find("output"), {"output"});
  using enum GradedKind;
  Output output;
  output.linear = read_linear(s);
  output.layers = read_layers(s, output.linear.has_value());
  output.layer_files = s.flag("layer_files");
  if (output.layer_files && output.layers.empty())
    s.find("layer_files")->fail("is for layers, of which none are asked for");
  output.data = read_data(s, output.linear.has_value());
  output.graded = s.word<std::optional<GradedFormat>>("graded", {{{kPng16}},
                                                                 {{kPng8}},
                                                                 {{kJpeg}},
                                                                 {{kTiff16}},
                                                                 {{kTiff8}},
                                                                 {{kPng16}},
                                                                 {{kTiff16}},
                                                                 std::nullopt});
  read_graded_details(s, output.graded);
  output.names = {read_name(s), s.whole("start"), s.whole("digits"), s.whole("per_folder", 0)};
  output.owner = s.text("owner");
  // Both are missing only where both keys say none, so that `graded` is there to be blamed.
  if (!output.linear && !output.graded)
    s.find("graded")->fail("and linear are both none, so that nothing would be made");
  return output;
}

}  // namespace domefall
