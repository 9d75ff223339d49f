#include "pipeline/render/overlay/frame_titles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

#include "pipeline/base/digest.h"
#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/sky_figure.h"
#include "pipeline/render/overlay/title_ground.h"
#include "pipeline/render/rays/key_rounding.h"
#include "pipeline/render/scene/body_sight.h"
#include "pipeline/show/title_text.h"

namespace domefall {

std::vector<SeenTitle> seen_titles(const Show& show, const FrameState& state) {
  std::vector<SeenTitle> seen;
  if (!show.draws_titles ||
      std::ranges::find(show.overlays, OverlayKind::kNoTitles) != show.overlays.end())
    return seen;
  const auto add_seen = [&](const std::vector<Title>& titles) {
    for (const Title& title : titles) {
      const double t = state.show_time_s;
      if (!(t >= title.begin_s && t < title.end_s)) continue;
      const double opacity =
          state.settings.title_opacity * light_left(title.fades, title.begin_s, title.end_s, t);
      if (opacity > 0) seen.push_back({&title, text_at(show, title, state), opacity});
    }
  };
  add_seen(show.titles);
  for (const Segment& segment : show.timeline) add_seen(segment.titles);
  return seen;
}

std::shared_ptr<const LetteredText> title_letters(const std::string& text,
                                                  const LetterStyle& style) {
  // A counter has another text in each frame, so not all are kept.
  constexpr std::size_t kMostKept = 100;
  static std::mutex mutex;
  static std::map<std::tuple<std::string, std::string, TextAlign, bool>,
                  std::shared_ptr<const LetteredText>>
      known;
  const std::lock_guard lock(mutex);
  const auto key = std::tuple(text, style.font, style.align, style.even_digits);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  if (known.size() >= kMostKept) known.clear();
  return known.emplace(key, std::make_shared<LetteredText>(lettered(text, style))).first->second;
}

namespace {

// This is raised with every change of how figures are drawn.
constexpr int kFigureVersion = 1;

// A TitleOnDome is what a title draws in one frame, and where.
class TitleOnDome {
 public:
  TitleOnDome(const Show& show, const SeenTitle& seen, const FrameState& state)
      : projection_(state.projection),
        letters_(title_letters(seen.text, seen.title->style)),
        figure_(seen.title->figure),
        ground_(*letters_, seen.title->plate, seen.title->shadow) {
    const Title& title = *seen.title;
    if (title.place) sky_.emplace(state, show.effects);
    if (title.body) {
      if (const auto image = body_image(show, *title.body, state))
        surface_.emplace(below(image->direction, title, state, image->reach));
    } else if (!title.place) {
      surface_.emplace(state.camera_from_audience, title.azimuth, title.elevation, title.height);
    } else if (sky_->is_seen()) {
      surface_.emplace(below(sky_->image(*title.place), title, state));
    }
  }

  // The lines of a figure, and the letters.
  Coverage ink() const {
    Coverage coverage(columns(projection_), rows(projection_));
    if (surface_) add_text(*letters_, *surface_, {0, 0}, projection_, coverage);
    if (sky_ && sky_->is_seen()) add_figure(figure_, *sky_, projection_, coverage);
    return coverage;
  }
  std::vector<CoveredRow> ground() const {
    return surface_ ? ground_.covered(*surface_, projection_) : std::vector<CoveredRow>();
  }

 private:
  struct Seen {
    CameraDirection direction;
    double reach;  // radians
  };
  // Returns where the direct image of a body is seen, or nothing where there is none.
  static std::optional<Seen> body_image(const Show& show, std::size_t body,
                                        const FrameState& state) {
    const BodySight sight(state, show.effects, show.least_star_radius);
    const auto image = sight.sees() ? sight.image(show.bodies[body], 0) : std::nullopt;
    if (!image) return std::nullopt;
    return Seen{sight.seen(image->at).direction, sight.reach(show.bodies[body], *image)};
  }

  // Returns where a text lies that stands clear below an image, which reaches so far down (radians).
  TextSurface below(const CameraDirection& image, const Title& title, const FrameState& state,
                    double reach = 0) const {
    constexpr double kGap = 1;  // from the image to the text, in capitals
    return TextSurface::at(state.camera_from_audience, image, title.height,
                           reach + (kGap + letters_->half_height) * title.height);
  }

  const Projection& projection_;
  std::shared_ptr<const LetteredText> letters_;
  std::optional<DirectSky> sky_;  // of a title that belongs to a place on it
  const SkyFigure& figure_;
  TitleGround ground_;
  std::optional<TextSurface> surface_;
};

}  // namespace

std::string titles_key(const Show& show, const FrameState& state) {
  const std::vector<SeenTitle> seen = seen_titles(show, state);
  if (seen.empty()) return {};
  Digest digest;
  add_rotation(digest, state.camera_from_audience);
  // A gain that changes nothing adds nothing, so that shows without one keep their keys.
  if (const double gain = state.settings.title_gain; gain != 1)
    digest.add("gain").add(rounded_for_key(gain));
  for (const SeenTitle& one : seen) {
    const Title& title = *one.title;
    add_outlines(digest, *title_letters(one.text, title.style));
    // The last bits of angles differ between processors, and rounded_for_key() rounds them off.
    for (const double v : {title.azimuth, title.elevation, title.height, one.opacity})
      digest.add(rounded_for_key(v));
    for (const float v : {title.light.r, title.light.g, title.light.b})
      digest.add(static_cast<double>(v));
    // Where a body is seen enters the keys of all frames.
    if (title.body) digest.add("body").add(static_cast<double>(*title.body));
    if (title.place) {
      digest.add("place");
      for (const double v : {title.place->v.x, title.place->v.y, title.place->v.z})
        digest.add(rounded_for_key(v));
    }
    for (const auto& line : title.figure) {
      digest.add("line").add(kFigureVersion);
      for (const SkyDirection& end : line)
        for (const double v : {end.v.x, end.v.y, end.v.z}) digest.add(rounded_for_key(v));
    }
    // Titles without a ground keep the keys that they had before there was one.
    if (title.plate > 0) digest.add("plate").add(title.plate);
    if (title.shadow > 0) digest.add("shadow").add(title.shadow);
  }
  return digest.hex();
}

std::vector<float> covered_by(const Show& show, const SeenTitle& seen, const FrameState& state) {
  const auto width = static_cast<std::size_t>(columns(state.projection));
  std::vector<float> covered(width * static_cast<std::size_t>(rows(state.projection)));
  const auto cover = [&](int row, int first, std::span<const double> parts) {
    const ColumnRange inside = inside_columns(state.projection, row);
    float* const pixels = covered.data() + static_cast<std::size_t>(row) * width;
    for (int column = std::max(first, inside.first);
         column < first + static_cast<int>(parts.size()) && column <= inside.last; ++column) {
      const auto part =
          static_cast<float>(seen.opacity * parts[static_cast<std::size_t>(column - first)]);
      pixels[column] = pixels[column] * (1 - part) + part;
    }
  };
  const TitleOnDome drawn(show, seen, state);
  for (const CoveredRow& row : drawn.ground()) cover(row.row, row.first, row.parts);
  drawn.ink().for_each_row(cover);
  return covered;
}

void draw_titles(const Show& show, const FrameState& state, const FrameRef& frame) {
  // The brightest title stays below the largest half even with the largest gain.
  const auto gain = static_cast<float>(state.settings.title_gain);
  // Each title has its own light and opacity, and so its own coverage.
  for (const SeenTitle& seen : seen_titles(show, state)) {
    const TitleOnDome drawn(show, seen, state);
    draw_over(drawn.ground(), {{0, 0, 0}, seen.opacity}, state.projection, frame);
    const WorkingRgb& light = seen.title->light;
    draw_over(drawn.ink(), {{light.r * gain, light.g * gain, light.b * gain}, seen.opacity},
              state.projection, frame);
  }
}

}  // namespace domefall
