#include "pipeline/render/frame_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/base/digest.h"
#include "pipeline/render/key_parts.h"
#include "pipeline/render/overlay/frame_overlays.h"
#include "pipeline/render/overlay/frame_titles.h"
#include "pipeline/render/rays/key_rounding.h"
#include "pipeline/render/rendered_frame.h"
#include "pipeline/render/stars/star_trail.h"
#include "pipeline/sources/sky/read_sky.h"
#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {
namespace {

// The versions are raised with every change that alters a pixel, so that older frames are made
// again.  Those of bodies and of glare count for shows with them only.
constexpr int kPixelVersion = 10, kBodiesVersion = 6, kGlareVersion = 2;

// Adds a law.  Settings that came after the first version are added only where they are in use, so
// that other shows keep their keys.
void add_point_spread(Digest& digest, const PointSpreadLaw& law) {
  for (const double v : {law.min_sigma, law.growth, law.reference_magnitude, law.max_sigma})
    digest.add(v);
  if (law.halo > 0) digest.add("halo").add(law.halo).add(law.halo_sigma);
  digest.add("core").add(law.white_core);
}

// Adds the numbers of a sky, which keyframes may change from frame to frame.
void add_settings(Digest& digest, const FrameSettings::Sky& sky) {
  digest.add(rounded_for_key(sky.background_gain))
      .add(rounded_for_key(sky.star_gain))
      .add(rounded_for_key(sky.max_magnitude))
      .add(sky.soft_limit ? "soft" : "hard");
}

void add_output(Digest& digest, const Show& show) {
  // A show that changes from halves to floats, or back, makes all of its frames again.
  if (RenderedFrame::keeps_floats(show)) digest.add("float");
  if (!show.output.layers.empty()) {
    digest.add("layers");
    for (const Layer layer : show.output.layers) digest.add(kind_of(layer).name);
    if (show.output.layer_files) digest.add("apart");
  }
  const OutputData& data = show.output.data;
  if (data.any()) {
    digest.add("data").add((data.lens ? 1 : 0) + (data.mattes ? 2 : 0) +
                           (data.cryptomatte ? 4 : 0));
    for (const Body& body : show.bodies) digest.add(body.name);
  }
}

}  // namespace

// The stamp is taken before the file is read, so that touched_asset() sees a change in between.
void FrameKeys::stamp(const std::filesystem::path& file) {
  assets_.emplace_back(file, FileStamp(file));
}

void FrameKeys::add_background(Digest& digest, const SkyBackground& background) {
  // The index tells kinds of background apart that have no numbers of their own.
  digest.add(static_cast<double>(background.index()));
  if (const auto* panorama = std::get_if<PanoramaSky>(&background)) {
    stamp(panorama->image);
    digest.add(sky_digest(panorama->image));
    if (panorama->brightness != 1) digest.add("brightness").add(panorama->brightness);
    if (panorama->black) digest.add("black").add(*panorama->black);
  }
  if (const auto* rings = std::get_if<RingsSky>(&background)) digest.add(rings->period);
}

void FrameKeys::add_surface(Digest& digest, const Body& body) {
  if (!body.texture.empty()) {
    stamp(body.texture);
    digest.add("texture").add(sky_digest(body.texture));
  }
  if (body.tilt != 0) digest.add("tilt").add(body.tilt);
  for (const BodyRing& ring : body.rings) {
    digest.add("ring").add(ring.inner).add(ring.outer).add(ring.opacity);
    for (const float c : {ring.colour.r, ring.colour.g, ring.colour.b}) digest.add(double(c));
  }
  if (!body.lit_from) return;
  digest.add("lit").add(static_cast<int>(body.lit_from->index()));
  if (const auto* place = std::get_if<SkyDirection>(&*body.lit_from))
    for (const double x : {place->v.x, place->v.y, place->v.z}) digest.add(rounded_for_key(x));
  if (const auto* lamp = std::get_if<std::shared_ptr<const Body>>(&*body.lit_from))
    digest.add(static_cast<double>(std::ranges::find(show_.bodies, (*lamp)->name, &Body::name) -
                                   show_.bodies.begin()));
}

void FrameKeys::add_bodies(Digest& digest) {
  for (const Body& body : show_.bodies) {
    digest.add("body").add(kBodiesVersion);
    for (const V3d& v : {body.normal.v, body.node.v})
      for (const double x : {v.x, v.y, v.z}) digest.add(rounded_for_key(x));
    // The start of a free motion determines all of it.
    const OrbitPoint start = point_at(body.trajectory, body.start);
    digest.add(static_cast<int>(body.trajectory.index())).add(static_cast<int>(start.tetrad));
    for (const double x : {start.r, start.celerity.x, start.celerity.z})
      digest.add(rounded_for_key(x));
    if (show_.spacetime.is<SpinningHole>())
      for (const double x : {start.theta, start.celerity.y}) digest.add(rounded_for_key(x));
    for (const double x :
         {body.backward ? -1.0 : 1.0, body.null_time, body.shines_before ? 1.0 : 0.0, body.azimuth,
          body.temperature, body.magnitude, body.radius, body.granulation})
      digest.add(x);
    add_surface(digest, body);
  }
}

void FrameKeys::add_sky(Digest& digest, const RegionSky& sky) {
  add_background(digest, sky.background);
  digest.add(sky.stars ? "stars" : "no stars");
  if (!sky.stars) return;
  if (const auto year = sky.stars->planets_year) digest.add("planets").add(*year);
  stamp(sky.stars->catalogue);
  // The header of a binary catalogue has a digest of its content, so the rest need not be read.
  if (const auto print = star_file_fingerprint(sky.stars->catalogue))
    digest.add(*print);
  else
    digest.add_file(sky.stars->catalogue);
}

// Many segments may share a background, whose file is read once.
void FrameKeys::add_segments() {
  std::vector<std::pair<SkyBackground, std::string>> known;
  const auto key_of = [&](const SkyBackground& background) {
    const auto found = std::ranges::find(known, background, [](const auto& k) { return k.first; });
    if (found != known.end()) return found->second;
    Digest digest;
    add_background(digest, background);
    return known.emplace_back(background, digest.hex()).second;
  };
  for (std::size_t k = 0; k < show_.timeline.size(); ++k)
    for (const SkyRegion region : kEverySky)
      if (const auto& own = show_.timeline[k].backgrounds[region])
        // The region is part of the text, so that equal backgrounds of two regions differ.
        own_skies_[static_cast<int>(k)] += fmt::format("{} {};", kSkyKeys[region], key_of(*own));
}

void FrameKeys::add_pattern_files(Digest& digest) {
  if (!show_.disc) return;
  for (const PatternKind& pattern : show_.disc->patterns)
    if (const auto* map = std::get_if<MapPattern>(&pattern)) {
      stamp(map->file);
      digest.add_file(map->file);
    }
}

FrameKeys::FrameKeys(const Show& show, std::string grade) : show_(show), grade_(std::move(grade)) {
  Digest common;
  common.add(DOMEFALL_VERSION).add(kPixelVersion).add(show.title).add(show.frames_per_second);
  add_sky(common, show.sky[SkyRegion::kI]);
  add_point_spread(common, show.point_spread);
  common.add(show.panorama_shift.blueshift_power);
  // A setting that has its default adds nothing, as in add_point_spread().
  if (show.least_star_radius != Show().least_star_radius)
    common.add("star radius").add(show.least_star_radius);
  common.add("saturation").add(show.star_saturation);
  add_effects(common, show.effects);
  add_disc(common, show.disc);
  add_gas(common, show);
  add_pattern_files(common);
  if (show.glare.share > 0)
    common.add("glare").add(kGlareVersion).add(show.glare.share).add(show.glare.sigma);
  if (show.star_epoch != kCatalogueEpoch) common.add("epoch").add(show.star_epoch);
  add_bodies(common);
  add_output(common, show);
  common_ = common.hex();
  Digest three;
  add_sky(three, show.sky[SkyRegion::kIII]);
  sky_three_ = three.hex();
  add_segments();
  if (show.spacetime.leads_on()) {
    Digest next;
    add_sky(next, show.sky[SkyRegion::kNext]);
    sky_next_ = next.hex();
  }
  // A black singularity leaves its key empty, as in shows that do not name it.
  if (std::holds_alternative<BlackSky>(show.sky[SkyRegion::kIV].background)) return;
  Digest four;
  add_sky(four, show.sky[SkyRegion::kIV]);
  sky_four_ = four.hex();
}

std::optional<std::filesystem::path> FrameKeys::touched_asset() const {
  for (const auto& [file, stamp] : assets_)
    if (FileStamp(file) != stamp) return file;
  return std::nullopt;
}

bool FrameKeys::same_assets(const FrameKeys& other) const {
  return common_ == other.common_ && sky_three_ == other.sky_three_ &&
         sky_four_ == other.sky_four_ && sky_next_ == other.sky_next_ &&
         own_skies_ == other.own_skies_;
}

// Titles and overlays are drawn over the mean of all instants, so that they enter the key once.
std::string FrameKeys::scene(const FrameState& state) const {
  std::string key = exposed(state);
  const auto add = [&key](const char* what, const std::string& drawn) {
    if (!drawn.empty()) key = Digest().add(key).add(what).add(drawn).hex();
  };
  add("titles", titles_key(show_, state));
  add("overlays", overlays_key(show_, state));
  return key;
}

std::string FrameKeys::exposed(const FrameState& state) const {
  if (!(show_.exposure.shutter > 0)) return instant(state);
  // Three instants stand for all that are seen while the shutter is open.
  Digest digest;
  for (const FrameState& exposed : exposure_states(show_, state, 3)) digest.add(instant(exposed));
  return digest.add(rounded_for_key(show_.exposure.shutter)).hex();
}

std::string FrameKeys::instant(const FrameState& state) const {
  const ObserverState& o = state.observer;
  Digest digest;
  // The number of the frame is a part of its key, so that two frames of equal pixels have two keys.
  digest.add(common_).add(state.frame);
  add_observer(digest, o);
  add_projection(digest, state.projection);
  digest.add(rounded_for_key(state.settings.ev));
  add_settings(digest, state.settings.sky[SkyRegion::kI]);
  // Settings of a sky enter the keys of the frames that can see it, and of no others.
  if (o.region == Region::kII || seen_skies(o)[SkyRegion::kIII]) {
    digest.add(sky_three_);
    add_settings(digest, state.settings.sky[SkyRegion::kIII]);
  }
  if (seen_skies(o)[SkyRegion::kNext]) {
    digest.add("next").add(sky_next_);
    add_settings(digest, state.settings.sky[SkyRegion::kNext]);
  }
  if (o.spacetime.is<Schwarzschild>()) {
    digest.add(sky_four_);
    add_settings(digest, state.settings.sky[SkyRegion::kIV]);
  }
  // Stars that race around the ring are drawn by how far the sky turns until the next frame.
  const bool starry = std::ranges::any_of(
      kExteriorSkies, [this](SkyRegion sky) { return show_.sky[sky].stars.has_value(); });
  if (starry && !is_flat(o) && !(show_.exposure.shutter > 0)) {
    for (const double v : {state.sky_turn.x, state.sky_turn.y, state.sky_turn.z}) digest.add(v);
  }
  // Whatever moves or glows with time is seen by the observer's null time.
  const SkyBackground& singularity = background_of(show_, state.segment, SkyRegion::kIV);
  if (!show_.bodies.empty()) {
    digest.add("bodies").add(rounded_for_key(o.null_time));
    // Trails of bodies depend on how time goes meanwhile.
    for (const double frames : {-kWindow, kWindow}) {
      const ObserverState then = observer_after(show_, state, frames, CameraMotion::kStays);
      digest.add(rounded_for_key(then.null_time));
    }
    for (const double v : {state.sky_turn.x, state.sky_turn.y, state.sky_turn.z}) digest.add(v);
  }
  if (o.spacetime.is<Schwarzschild>() && std::holds_alternative<RingsSky>(singularity))
    digest.add(rounded_for_key(o.null_time));
  if (show_.disc && !show_.disc->patterns.empty())
    digest.add("pattern").add(rounded_for_key(o.null_time));
  // What has the show's own light adds nothing.
  if (show_.disc &&
      (state.settings.disc_gain != 1 || state.settings.disc_opacity != show_.disc->opacity))
    digest.add("disc light")
        .add(rounded_for_key(state.settings.disc_gain))
        .add(rounded_for_key(state.settings.disc_opacity));
  if (!state.settings.magnitudes.empty()) digest.add("magnitudes");
  for (const double magnitude : state.settings.magnitudes) digest.add(rounded_for_key(magnitude));
  if (const auto own = own_skies_.find(state.segment); own != own_skies_.end())
    digest.add("own skies").add(own->second);
  if (state.fade != 1) digest.add("fade").add(rounded_for_key(state.fade));
  // The segment that vanishes in a dissolve is a frame of its own to the key.
  if (state.vanishing)
    digest.add(instant(*state.vanishing)).add(rounded_for_key(state.vanishing_part));
  return digest.hex();
}

std::string FrameKeys::layer(const std::string& scene_key, Layer layer) {
  return Digest().add(scene_key).add(kind_of(layer).name).hex();
}

std::string FrameKeys::graded(const std::string& scene_key, const FrameState& state) const {
  Digest digest;
  digest.add(scene_key).add(grade_);
  // A CDL that changes nothing adds nothing, so that shows without one keep their keys.
  const Cdl& cdl = state.cdl;
  if (cdl != Cdl{}) {
    digest.add("cdl");
    for (const auto& colours : {cdl.slope, cdl.offset, cdl.power})
      for (const double v : colours) digest.add(rounded_for_key(v));
    digest.add(rounded_for_key(cdl.saturation));
  }
  return digest.hex();
}

}  // namespace domefall
