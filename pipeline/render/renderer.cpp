#include "pipeline/render/renderer.h"

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/stop_watch.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/disc/gas_pass.h"
#include "pipeline/render/disc_scene.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/render/frame_bodies.h"
#include "pipeline/render/frame_mattes.h"
#include "pipeline/render/frame_stars.h"
#include "pipeline/render/glare.h"
#include "pipeline/render/overlay/frame_overlays.h"
#include "pipeline/render/overlay/frame_titles.h"
#include "pipeline/render/put_images.h"
#include "pipeline/render/shutter.h"
#include "pipeline/render/sky/unresolved_sky.h"
#include "pipeline/render/thread_limit.h"
#include "projections/projection.h"

namespace domefall {
namespace {

// Returns the number of threads to use.  More threads than processors would gain nothing, and TBB
// would warn of them on the terminal.
int threads_of(int wanted) {
  const int processors = tbb::info::default_concurrency();
  return wanted > 0 ? std::min(wanted, processors) : processors;
}

// Leaves only a part of a frame's light.
template <class T>
void fade(LayeredFrame<T>& frame, double part) {
  const auto left = static_cast<float>(part);
  // Halves are multiplied as floats and rounded once.
  for (std::vector<T>* values : frame.lights())
    for (T& value : *values) value = left * static_cast<float>(value);
}

// A PictureAlone lends the memory of a picture to a frame without layers, and gives it back, also
// when rendering is stopped.
template <class T>
struct PictureAlone {
  explicit PictureAlone(ImageRgb<T>& lent) : picture(lent) { std::swap(whole.picture, picture); }
  ~PictureAlone() { std::swap(whole.picture, picture); }
  PictureAlone(const PictureAlone&) = delete;
  PictureAlone& operator=(const PictureAlone&) = delete;

  ImageRgb<T>& picture;
  LayeredFrame<T> whole;
};

// Replaces `part` of a frame by that of another one with the same layers.
template <class T>
void dissolve(LayeredFrame<T>& frame, LayeredFrame<T>& vanishing, double part) {
  const auto of_other = static_cast<float>(part), of_own = 1 - of_other;
  // Light is mixed and not brightness, as two projectors on one screen would mix it.
  const auto mix = [&](const auto& planes, const auto& others) {
    for (std::size_t p = 0; p < planes.size(); ++p) {
      // A layer may be empty in one of the views.
      planes[p]->resize(std::max(planes[p]->size(), others[p]->size()));
      others[p]->resize(planes[p]->size());
      std::transform(planes[p]->begin(), planes[p]->end(), others[p]->begin(), planes[p]->begin(),
                     [&](float own, float other) { return of_own * own + of_other * other; });
    }
  };
  mix(frame.lights(), vanishing.lights());
  mix(frame.alphas(), vanishing.alphas());
}

// Sets the alpha of a row, which is 1 in the columns that the projection shows.
template <class T>
void fill_alpha(const ColumnRange& inside, int row, LayeredFrame<T>& frame) {
  T* const alpha = frame.alpha.data() + static_cast<std::ptrdiff_t>(row) * frame.picture.width;
  for (int column = 0; column < frame.picture.width; ++column)
    alpha[column] = column >= inside.first && column <= inside.last ? T(1) : T(0);
}

}  // namespace

// Memory holds the threads, and the memory that is kept from frame to frame, since getting new
// memory takes more time than writing into it.
struct Renderer::Memory {
  tbb::task_arena arena;
  RayGrid grid{};
  BlobLayer stars{Domemaster{1}}, crowded_skies{Domemaster{1}};
  ImageLists images{};
  BandMemory bands{};
  StarLabels labels;
};

Renderer::Renderer(const Show& show, int threads, AntiAliasing anti_aliasing, SkyDetail detail)
    : show_(show),
      anti_aliasing_(anti_aliasing),
      skies_(show, detail),
      memory_(
          new Memory{.arena = tbb::task_arena(threads_of(threads)), .labels = StarLabels(show)}) {
  if (anti_aliasing.samples < 1 || anti_aliasing.samples > kMostSamples)
    throw InputError(
        fmt::format("anti-aliasing takes 1 to {} samples along each axis of a pixel, got {}",
                    kMostSamples, anti_aliasing.samples));
  require_threads(memory_->arena.max_concurrency());
  memory_->arena.initialize();
}

Renderer::~Renderer() = default;

void Renderer::stop_when(const std::atomic<bool>* flag) { memory_->bands.stop = flag; }

int Renderer::threads() const { return memory_->arena.max_concurrency(); }

void Renderer::load_sky(SkyRegion sky) { skies_.load(sky); }

double Renderer::sky_black(SkyRegion sky, const PanoramaSky& map) {
  return skies_.sky(sky, map, false).black.luminance;
}

void Renderer::load(const FramePlan& plan) { skies_.load(plan); }

HalfFrame Renderer::render(const FrameState& state, StageTimes* times) {
  HalfFrame frame;
  render(state, frame, times);
  return frame;
}

void Renderer::render(const FrameState& state, HalfFrame& frame, StageTimes* times) {
  PictureAlone<Imath::half> alone(frame);
  render_frame(state, alone.whole, times);
}

void Renderer::render(const FrameState& state, FloatImage& frame, StageTimes* times) {
  PictureAlone<float> alone(frame);
  render_frame(state, alone.whole, times);
}

void Renderer::render(const FrameState& state, LayeredHalfFrame& frame, StageTimes* times) {
  render_frame(state, frame, times);
}

void Renderer::render(const FrameState& state, LayeredFloatFrame& frame, StageTimes* times) {
  render_frame(state, frame, times);
}

// Titles stand still while the shutter is open, and no fade of the show acts on them.
template <class T>
void Renderer::render_frame(const FrameState& state, LayeredFrame<T>& frame, StageTimes* times) {
  render_exposed(state, frame, times);
  if (show_.glare.share > 0) {
    StopWatch watch;
    memory_->arena.execute([&] { add_glare(show_.glare, state.projection, frame); });
    if (times) times->glare_s = watch.lap();
  }
  for (int row = 0; !frame.alpha.empty() && row < frame.picture.height; ++row)
    fill_alpha(inside_columns(state.projection, row), row, frame);
  draw_titles(show_, state, frame);
  // Only names ask what a disc leaves of the light behind it.
  std::optional<DiscScene> disc;
  LightLeft left;
  if (show_.disc && std::ranges::count(show_.overlays, OverlayKind::kStarNames) > 0) {
    const FrameState& view = dominant_view(state);
    disc.emplace(show_, view);
    left = [&disc, width = largest_pixel_angle(view.projection)](const CameraDirection& from,
                                                                 double psi) {
      return disc->left_before(from, psi, width);
    };
  }
  draw_overlays(show_, state, memory_->labels, left, frame);
}

// A frame with an open shutter is the mean of several instants.
template <class T>
void Renderer::render_exposed(const FrameState& state, LayeredFrame<T>& frame, StageTimes* times) {
  StageTimes sum;
  sum.instants = show_.exposure.shutter > 0 ? instants_for(show_, state, lenses_) : 1;
  // With a closed shutter the next instant that is seen is the next frame.  With an open one the
  // instants divide its time evenly.
  const double gap = show_.exposure.shutter > 0 ? show_.exposure.shutter / sum.instants : 1;
  if (sum.instants == 1) {
    render_instant(state, gap, frame, sum);
  } else {
    MeanFrame mean;
    for (const FrameState& exposed : exposure_states(show_, state, sum.instants)) {
      StageTimes own;
      render_instant(exposed, gap, frame, own);
      memory_->arena.execute([&] { mean.add(frame); });
      sum.add(own);
    }
    memory_->arena.execute([&] { mean.store(frame); });
  }
  if (times) *times = sum;
}

// A dissolve mixes the views of two segments.
template <class T>
void Renderer::render_instant(const FrameState& state, double gap, LayeredFrame<T>& frame,
                              StageTimes& times) {
  render_faded(state, gap, frame, times);
  if (!state.vanishing) return;
  StageTimes own;
  LayeredFrame<T> vanishing = frame.without_pixels();
  render_faded(*state.vanishing, gap, vanishing, own);
  dissolve(frame, vanishing, state.vanishing_part);
  times.add(own);
}

// Each of the views in a dissolve has a fade of its own.
template <class T>
void Renderer::render_faded(const FrameState& state, double gap, LayeredFrame<T>& frame,
                            StageTimes& times) {
  render_view(state, gap, frame, times);
  if (state.fade < 1) fade(frame, state.fade);
}

// The faces of a cubemap are images of their own, of one scene.  Stars beyond the edges of a face
// still reach into it.
template <class T>
void Renderer::render_view(const FrameState& state, double gap, LayeredFrame<T>& frame,
                           StageTimes& times) {
  StopWatch watch;
  const FramePlan plan = plan_frame(show_, state);
  const PerSky<const Sky*> skies = skies_.skies_of(plan);
  for (const SkyRegion sky : kEverySky)
    if (skies[sky]) times.black[sky] = skies[sky]->black.luminance;
  times.load_s = watch.lap();
  std::shared_ptr<const Lens> lens = lens_of(state.observer, plan.wanted(), show_.effects, lenses_);
  times.tables_made = lenses_.tables_made();
  times.table_nodes = lenses_.table_nodes();
  // A show has one disc, whose light is tabulated once.
  if (plan.disc && !disc_light_) disc_light_.emplace(*show_.disc);
  // Only images behind the hole race, so that in flat space no motion is needed.
  const SkyMotion motion = plan.gravity ? SkyMotion{state.sky_turn, gap} : SkyMotion{};
  const FrameScene scene(show_, state, plan, std::move(lens), skies, motion,
                         plan.disc ? &*disc_light_ : nullptr,
                         body_times(show_, state, show_.exposure.shutter > 0 ? gap : 0));
  times.tables_s = watch.lap();
  frame.set_size(columns(state.projection), rows(state.projection));
  const PixelParts parts = parts_nearly_square(state.projection);
  if (parts.across * parts.down > 1) return render_parts(scene, parts, frame, times);
  const std::vector<CubemapFace> faces = cubemap_faces(state.projection);
  // Only a cubemap has faces.
  if (faces.empty()) return render_image(scene, frame, times);
  LayeredFrame<T> image = frame.without_pixels();
  image.set_size(columns(faces[0].projection), rows(faces[0].projection));
  for (const CubemapFace& face : faces) {
    StageTimes own;
    const FrameScene scene_of_face(scene, face);
    render_image(scene_of_face, image, own);
    put(image, face, frame);
    times.add(own);
  }
}

// The stages take a pixel to be about as wide as it is high.  Where it is not, they draw its parts, as
// a face that looks where the whole does.
template <class T>
void Renderer::render_parts(const FrameScene& scene, const PixelParts& parts,
                            LayeredFrame<T>& frame, StageTimes& times) {
  const CubemapFace whole{
      0, 0, divided(scene.projection(), parts), {V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1)}};
  const FrameScene scene_of_parts(scene, whole);
  LayeredFrame<T> image = frame.without_pixels();
  image.set_size(columns(whole.projection), rows(whole.projection));
  render_image(scene_of_parts, image, times);
  memory_->arena.execute([&] { put_means(image, parts, scene.projection(), frame); });
}

// Renders the image of one projection that is not put together from others.
template <class T>
void Renderer::render_image(const FrameScene& scene, LayeredFrame<T>& image, StageTimes& times) {
  StopWatch watch;
  // All stages run in this arena, which has as many threads as the caller asked for.
  memory_->arena.execute([&] {
    BlobLayer& stars = memory_->stars;
    stars.start(scene.projection());
    lay_stars(scene, memory_->images, stars);
    stars.sort_into_bands();
    UnresolvedSkies unresolved = find_unresolved_skies(scene);
    BlobLayer& crowded = memory_->crowded_skies;
    const bool crowds = !unresolved.blobs.empty();
    if (crowds) {
      crowded.start(scene.projection());
      crowded.add(unresolved.blobs);
      crowded.sort_into_bands();
    }
    std::optional<SkyBorders> borders;
    if (scene.plan.gravity && scene.effects.lensing && stars.size() > 0) {
      // Straight light has no silhouette, and without stars there is nothing to end.
      borders.emplace(scene.tracer, scene.projection());
      if (!borders->usable()) borders.reset();
    }
    times.images = stars.size();
    times.stars_s = watch.lap();
    memory_->bands.throw_if_stopped();
    const SkyPass sky(scene, anti_aliasing_, std::move(unresolved.darkened), memory_->grid);
    times.traced_fraction = sky.traced_fraction();
    times.grid_s = watch.lap();
    std::optional<DiscPass> disc;
    const bool flat = scene.disc && !(scene.disc->disc().height > 0);
    if (flat || (scene.disc && (!scene.bodies.empty() || !image.mattes.empty())))
      disc.emplace(scene);
    std::optional<GasPass> gas;
    if (scene.plan.gas) gas.emplace(scene, memory_->bands.stop);
    memory_->bands.throw_if_stopped();
    times.disc_s = watch.lap();
    const DiscPass* const disc_or_none = disc ? &*disc : nullptr;
    const std::vector<BodyLayer> bodies = lay_bodies(
        scene, images_of_bodies(scene, scene.bodies, disc_or_none, gas ? &gas->rays() : nullptr));
    for (const BodyLayer& layer : bodies) times.images += layer.light.size();
    std::optional<MattePass> mattes;
    if (!image.mattes.empty()) mattes.emplace(scene, disc_or_none);
    times.stars_s += watch.lap();
    memory_->bands.throw_if_stopped();
    draw_bands(scene, sky,
               {.crowded_skies = crowds ? &crowded : nullptr,
                .stars = &stars,
                .borders = borders ? &*borders : nullptr,
                .disc = flat ? disc_or_none : nullptr,
                .gas = gas ? &*gas : nullptr,
                .bodies = bodies,
                .mattes = mattes ? &*mattes : nullptr},
               memory_->bands, image);
    memory_->bands.throw_if_stopped();
    times.pixels_s = watch.lap();
  });
}

}  // namespace domefall
