#include "pipeline/render/overlay/frame_titles.h"

#include <map>
#include <mutex>
#include <tuple>

#include "pipeline/base/digest.h"
#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/rays/key_rounding.h"

namespace domefall {

std::vector<SeenTitle> seen_titles(const Show& show, const FrameState& state) {
  std::vector<SeenTitle> seen;
  const auto add_seen = [&](const std::vector<Title>& titles) {
    for (const Title& title : titles) {
      const double t = state.show_time_s;
      if (!(t >= title.begin_s && t < title.end_s)) continue;
      const double opacity = light_left(title.fades, title.begin_s, title.end_s, t);
      if (opacity > 0) seen.push_back({&title, opacity});
    }
  };
  add_seen(show.titles);
  for (const Segment& segment : show.timeline) add_seen(segment.titles);
  return seen;
}

const LetteredText& title_letters(const Title& title) {
  // The references that are returned stay valid, because a map moves none of its elements.
  static std::mutex mutex;
  static std::map<std::tuple<std::string, std::string, TextAlign>, LetteredText> known;
  const std::lock_guard lock(mutex);
  const auto key = std::tuple(title.text, title.style.font, title.style.align);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known.emplace(key, lettered(title.text, title.style)).first->second;
}

std::string titles_key(const Show& show, const FrameState& state) {
  const std::vector<SeenTitle> seen = seen_titles(show, state);
  if (seen.empty()) return {};
  Digest digest;
  add_rotation(digest, state.camera_from_audience);
  for (const auto& [title, opacity] : seen) {
    add_outlines(digest, title_letters(*title));
    // The last bits of angles differ between processors, and rounded_for_key() rounds them off.
    for (const double v : {title->azimuth, title->elevation, title->height, opacity})
      digest.add(rounded_for_key(v));
    for (const float v : {title->light.r, title->light.g, title->light.b})
      digest.add(static_cast<double>(v));
  }
  return digest.hex();
}

namespace {

Coverage coverage_of(const Title& title, const FrameState& state) {
  Coverage coverage(columns(state.projection), rows(state.projection));
  const TextSurface surface(state.camera_from_audience, title.azimuth, title.elevation,
                            title.height);
  add_text(title_letters(title), surface, {0, 0}, state.projection, coverage);
  return coverage;
}

}  // namespace

std::vector<float> covered_by(const SeenTitle& seen, const FrameState& state) {
  const auto width = static_cast<std::size_t>(columns(state.projection));
  std::vector<float> covered(width * static_cast<std::size_t>(rows(state.projection)));
  coverage_of(*seen.title, state)
      .for_each_row([&](int row, int first, std::span<const double> parts) {
        const ColumnRange inside = inside_columns(state.projection, row);
        for (int column = std::max(first, inside.first);
             column < first + static_cast<int>(parts.size()) && column <= inside.last; ++column)
          covered[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)] =
              static_cast<float>(seen.opacity * parts[static_cast<std::size_t>(column - first)]);
      });
  return covered;
}

void draw_titles(const Show& show, const FrameState& state, const FrameRef& frame) {
  // Each title has its own light and opacity, and so its own coverage.
  for (const auto& [title, opacity] : seen_titles(show, state))
    draw_over(coverage_of(*title, state), {title->light, opacity}, state.projection, frame);
}

}  // namespace domefall
