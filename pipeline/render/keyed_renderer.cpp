#include "pipeline/render/keyed_renderer.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"

namespace domefall {

KeyedRenderer::KeyedRenderer(const Show& show, std::vector<int> frames, std::string grade,
                             int threads, bool explain)
    : show_(show),
      frames_(std::move(frames)),
      grade_(std::move(grade)),
      threads_(threads),
      explain_(explain) {
  keys_.emplace(show, grade_);
}

// The keys hold digests of the assets as they were when the run began, and the renderer reads them
// later.  So a frame counts only if nothing has touched them until it was rendered.
template <class T>
void KeyedRenderer::render_keyed(const FrameState& state, LayeredFrame<T>& frame) {
  for (;;) {
    render_once(state, frame);
    const auto touched = keys_->touched_asset();
    if (!touched) return;
    if (!assets_are_the_same())
      throw TemporaryError(touched->string() +
                           ": the file was changed while the run was reading it; run again");
    renderer_.reset();
  }
}

// Takes the digests of the assets again, and keeps the new keys if the digests have not changed.
bool KeyedRenderer::assets_are_the_same() {
  try {
    FrameKeys now(show_, grade_);
    if (!now.same_assets(*keys_)) return false;
    keys_.emplace(std::move(now));
    return true;
  } catch (const InputError&) {  // one of them is gone
    return false;
  } catch (const TemporaryError&) {  // one went while it was read
    return false;
  }
}

template <class T>
void KeyedRenderer::render_once(const FrameState& state, LayeredFrame<T>& frame) {
  if (!renderer_) {
    renderer_.emplace(show_, threads_);
    // All that the run needs is loaded at once, so that a damaged file ends it before its first
    // frame.
    for (const int number : frames_) {
      const FrameState other = frame_state(show_, number);
      renderer_->load(plan_frame(show_, other));
      if (other.vanishing) renderer_->load(plan_frame(show_, *other.vanishing));
    }
  }
  StageTimes times;
  try {
    renderer_->render(state, frame, &times);
    if (explain_)
      say(fmt::format("frame {}: region {}, r = {:.9g} M\n{}", state.frame,
                      region_name(state.observer.region, state.observer.universe), state.observer.r,
                      describe(plan_frame(show_, state), times)));
  } catch (const std::runtime_error& error) {
    if (dynamic_cast<const InputError*>(&error)) throw;
    throw std::runtime_error(fmt::format("frame {}: {}", state.frame, error.what()));
  }
}

template void KeyedRenderer::render_keyed(const FrameState&, LayeredHalfFrame&);
template void KeyedRenderer::render_keyed(const FrameState&, LayeredFloatFrame&);

}  // namespace domefall
