#include "pipeline/render/renderer.h"

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "pipeline/image/errors.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/render/frame_bodies.h"
#include "pipeline/render/frame_stars.h"
#include "pipeline/render/overlay/frame_overlays.h"
#include "pipeline/render/overlay/frame_titles.h"
#include "pipeline/render/shutter.h"
#include "pipeline/render/sky/unresolved_sky.h"
#include "pipeline/render/thread_limit.h"
#include "projections/cubemap_faces.h"

namespace domefall {
namespace {

// A StopWatch measures the stages of a frame, one lap after another.
class StopWatch {
 public:
  // Returns the seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Returns the number of threads to use.  More threads than processors would gain nothing, and TBB
// would warn of them on the terminal.
int threads_of(int wanted) {
  const int processors = tbb::info::default_concurrency();
  return wanted > 0 ? std::min(wanted, processors) : processors;
}

// Leaves only a part of a frame's light.
template <class T>
void fade(ImageRgb<T>& frame, double part) {
  const auto left = static_cast<float>(part);
  // Halves are multiplied as floats and rounded once.
  for (T& value : frame.pixels) value = left * static_cast<float>(value);
}

// Replaces `part` of a frame's light by that of another one.
template <class T>
void dissolve(ImageRgb<T>& frame, const ImageRgb<T>& vanishing, double part) {
  const auto of_other = static_cast<float>(part), of_own = 1 - of_other;
  for (int row = 0; row < frame.height; ++row) {
    T* own = frame.row(row);
    const T* other = vanishing.row(row);
    for (int k = 0; k < 3 * frame.width; ++k)
      // Light is mixed and not brightness, as two projectors on one screen would mix it.
      own[k] = of_own * static_cast<float>(own[k]) + of_other * static_cast<float>(other[k]);
  }
}

}  // namespace

// Memory holds the threads, and the memory that is kept from frame to frame, since getting new
// memory takes more time than writing into it.
struct Renderer::Memory {
  tbb::task_arena arena;
  RayGrid grid{};
  BlobLayer stars{Domemaster{1}};
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
  render_exposed(state, frame, times);
}

void Renderer::render(const FrameState& state, FloatImage& frame, StageTimes* times) {
  render_exposed(state, frame, times);
}

// A frame with an open shutter is the mean of several instants.
template <class T>
void Renderer::render_exposed(const FrameState& state, ImageRgb<T>& frame, StageTimes* times) {
  StageTimes sum;
  sum.instants = show_.exposure.shutter > 0 ? instants_for(show_, state, optics_) : 1;
  // With a closed shutter the next instant that is seen is the next frame.  With an open one the
  // instants divide its time evenly.
  const double gap = show_.exposure.shutter > 0 ? show_.exposure.shutter / sum.instants : 1;
  if (sum.instants == 1) {
    render_instant(state, gap, frame, sum);
  } else {
    MeanFrame mean;
    for (FrameState& exposed : exposure_states(show_, state.frame, sum.instants)) {
      take_size(state, exposed);
      StageTimes own;
      render_instant(exposed, gap, frame, own);
      memory_->arena.execute([&] { mean.add(frame); });
      sum.add(own);
    }
    memory_->arena.execute([&] { mean.store(frame); });
  }
  // A title stands still while the shutter is open, and no fade of the show acts on it.
  draw_titles(show_, state, frame);
  draw_overlays(show_, state, memory_->labels, frame);
  if (times) *times = sum;
}

// A dissolve mixes the views of two segments.
template <class T>
void Renderer::render_instant(const FrameState& state, double gap, ImageRgb<T>& frame,
                              StageTimes& times) {
  render_faded(state, gap, frame, times);
  if (!state.vanishing) return;
  StageTimes own;
  ImageRgb<T> vanishing;
  render_faded(*state.vanishing, gap, vanishing, own);
  dissolve(frame, vanishing, state.vanishing_part);
  times.add(own);
}

// Each of the views in a dissolve has a fade of its own.
template <class T>
void Renderer::render_faded(const FrameState& state, double gap, ImageRgb<T>& frame,
                            StageTimes& times) {
  render_view(state, gap, frame, times);
  if (state.fade < 1) fade(frame, state.fade);
}

// The faces of a cubemap are images of their own, of one scene.  Stars beyond the edges of a face
// still reach into it.
template <class T>
void Renderer::render_view(const FrameState& state, double gap, ImageRgb<T>& frame,
                           StageTimes& times) {
  StopWatch watch;
  const FramePlan plan = plan_frame(show_, state);
  const PerSky<const Sky*> skies = skies_.skies_of(plan);
  for (const SkyRegion sky : kEverySky)
    if (skies[sky]) times.black[sky] = skies[sky]->black.luminance;
  times.load_s = watch.lap();
  SkyMotion motion;
  // Only images behind the hole race, so that in flat space no motion is needed.
  if (plan.gravity) motion = {sky_turn(show_, state), gap};
  const HoleOptics& optics = optics_.optics_for(state.observer, plan);
  times.tables_made = optics_.tables_made();
  times.table_nodes = node_count(optics);
  // A show has one disc, whose light is tabulated once.
  if (plan.disc && !disc_light_) disc_light_.emplace(*show_.disc);
  const std::vector<CubemapFace> faces = cubemap_faces(state.projection);
  const FrameScene scene(show_, state, plan, optics, skies, motion,
                         plan.disc ? &*disc_light_ : nullptr);
  times.tables_s = watch.lap();
  if (frame.width != columns(state.projection) || frame.height != rows(state.projection))
    frame = ImageRgb<T>(columns(state.projection), rows(state.projection));
  // Only a cubemap has faces.
  if (faces.empty()) return render_image(scene, frame, times);
  ImageRgb<T> image(columns(faces[0].projection), rows(faces[0].projection));
  for (const CubemapFace& face : faces) {
    StageTimes own;
    const FrameScene scene_of_face(scene, face);
    render_image(scene_of_face, image, own);
    for (int row = 0; row < image.height; ++row)
      std::copy_n(image.row(row), 3 * image.width,
                  frame.row(face.row + row) + 3 * static_cast<std::ptrdiff_t>(face.column));
    times.add(own);
  }
}

// Renders the image of one projection that is not put together from others.
template <class T>
void Renderer::render_image(const FrameScene& scene, ImageRgb<T>& image, StageTimes& times) {
  StopWatch watch;
  // All stages run in this arena, which has as many threads as the caller asked for.
  memory_->arena.execute([&] {
    BlobLayer& stars = memory_->stars;
    stars.start(scene.projection());
    lay_stars(scene, memory_->images, stars);
    UnresolvedSkies unresolved = find_unresolved_skies(scene);
    stars.add(unresolved.blobs);
    stars.sort_into_bands();
    // The blob of an unresolved sky is in the same layer as the stars, and must not be cut off at
    // the border of that sky.
    std::optional<SkyBorders> borders;
    if (scene.plan.gravity && scene.effects.lensing && unresolved.blobs.empty() &&
        stars.size() > 0) {
      // Straight light has no silhouette, and without stars there is nothing to end.
      borders.emplace(scene.state, scene.optics, scene.tracer.vantage());
      if (!borders->usable()) borders.reset();
    }
    times.images = stars.size() - unresolved.blobs.size();
    times.stars_s = watch.lap();
    memory_->bands.throw_if_stopped();
    const SkyPass sky(scene, anti_aliasing_, std::move(unresolved.darkened), memory_->grid);
    times.traced_fraction = sky.traced_fraction();
    times.grid_s = watch.lap();
    std::optional<DiscPass> disc;
    if (scene.disc) disc.emplace(scene);
    times.disc_s = watch.lap();
    const std::optional<BlobLayer> bodies = lay_bodies(scene, disc ? &*disc : nullptr);
    if (bodies) times.images += bodies->size();
    times.stars_s += watch.lap();
    memory_->bands.throw_if_stopped();
    draw_bands(scene, sky, stars, disc ? &*disc : nullptr, borders, bodies ? &*bodies : nullptr,
               memory_->bands, image);
    memory_->bands.throw_if_stopped();
    times.pixels_s = watch.lap();
  });
}

}  // namespace domefall
