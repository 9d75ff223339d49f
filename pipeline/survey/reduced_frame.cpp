#include "pipeline/survey/reduced_frame.h"

#include <algorithm>
#include <cmath>

namespace domefall {

Projection reduced(const Projection& projection, int width) {
  constexpr int kLeastRows = 16;
  if (const auto* flat = std::get_if<Stereographic>(&projection)) {
    const double height = static_cast<double>(width) * flat->rows / flat->columns;
    return Stereographic{width, std::max(kLeastRows, static_cast<int>(std::lround(height))),
                         flat->fov};
  }
  return Domemaster{width};
}

FrameState reduced(FrameState state, int width) {
  state.projection = reduced(state.projection, width);
  if (state.vanishing)
    state.vanishing = std::make_shared<const FrameState>(reduced(*state.vanishing, width));
  return state;
}

}  // namespace domefall
