#include "pipeline/program/survey/light_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "pipeline/render/reduced_frame.h"
#include "pipeline/sources/colour/colour_space.h"

namespace domefall {
namespace {

// Of a hole that spins a frame with gas takes seconds at any size.
constexpr int kSurveyWidth = 48, kMostCostInstants = 60, kMostAboutSpin = 12;
constexpr std::size_t kFields = 12;  // along each side
// Three stops are an eighth of the light.
constexpr double kFadeStops = 3;
// From this part of white's code value on, the steps that remain to white cannot be seen.
constexpr double kNearWhite = 0.99;

// Returns the code value to which the grade takes the brightest grey that a half float can hold.
double white_of(const Grader& grader) {
  HalfFrame grey(1, 1);
  std::fill(grey.pixels.begin(), grey.pixels.end(), Imath::half(65504.0f));
  const GradedFrame graded = grader.grade(grey);
  return *std::max_element(graded.pixels.begin(), graded.pixels.end());
}

std::vector<std::size_t> inside_pixels(const Projection& p) {
  std::vector<std::size_t> inside;
  for (int row = 0; row < rows(p); ++row) {
    const ColumnRange range = inside_columns(p, row);
    for (int k = range.first; k <= range.last; ++k)
      inside.push_back(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns(p)) +
                       static_cast<std::size_t>(k));
  }
  return inside;
}

class LightMeter {
 public:
  explicit LightMeter(const Grader* grader) {
    if (grader) grader_ = *grader;
  }

  // Measures a frame into `light`.  The grade's white is asked for anew, since the CDL of each
  // frame changes it.
  void measure(const HalfFrame& frame, const FrameState& state, FrameLight& light) {
    const std::vector<std::size_t> inside = inside_pixels(state.projection);
    std::vector<double> values;
    std::size_t white = 0;
    GradedFrame graded;
    double brightest = 0;
    if (grader_) {
      grader_ = grader_->with(state.cdl);
      graded = grader_->grade(frame);
      brightest = white_of(*grader_);
    }
    for (const std::size_t k : inside) {
      const Imath::half* rgb = &frame.pixels[3 * k];
      values.push_back(luminance({rgb[0], rgb[1], rgb[2]}));
      light.mean += values.back() / static_cast<double>(inside.size());
      if (grader_) {
        const unsigned short* code = &graded.pixels[3 * k];
        white += std::max({code[0], code[1], code[2]}) >= kNearWhite * brightest;
      } else {
        // Without a grade a display would show everything above 1 as white.
        white += std::max({rgb[0], rgb[1], rgb[2]}) > 1;
      }
    }
    light.fields.assign(kFields * kFields, 0);
    for (std::size_t n = 0; n < inside.size() && light.mean > 0; ++n) {
      const std::size_t width = columns(state.projection), row = inside[n] / width,
                        column = inside[n] % width;
      const std::size_t at =
          row * kFields / rows(state.projection) * kFields + column * kFields / width;
      light.fields[at] += values[n] / (light.mean * static_cast<double>(inside.size()));
    }
    // Only the value at this rank is needed, so the values need not be sorted as a whole.
    const auto rank = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 99 / 100);
    std::nth_element(values.begin(), rank, values.end());
    light.percentile99 = *rank;
    light.white = static_cast<double>(white) / static_cast<double>(inside.size());
  }

 private:
  std::optional<Grader> grader_;  // with the CDL of the frame that was measured last
};

FrameLight measured(const Show& show, int frame, int width, Renderer& renderer, LightMeter& meter) {
  const FrameState state = as_draft(reduced(frame_state(show, frame), width));
  FrameLight light{frame, state.show_time_s, state.segment, state.settings.ev, state.fade};
  meter.measure(renderer.render(state), state, light);
  return light;
}

// Returns by which part of itself the light differs, apart from exposures and fades.
double step(const FrameLight& a, const FrameLight& b) {
  const auto bare = [](const FrameLight& light) {
    return light.fade > 0 ? light.mean / (light.fade * std::exp2(light.ev)) : 0;
  };
  const double most = std::max(bare(a), bare(b));
  return std::min(bare(a), bare(b)) > 0 ? std::abs(bare(a) - bare(b)) / most : 0;
}

// Returns which part of its light a picture would have to move to become the other.
double moved(const FrameLight& a, const FrameLight& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.fields.size(); ++k) sum += std::abs(a.fields[k] - b.fields[k]);
  return sum / 2;
}

// Adds a warning for each stretch of frames which all go with its first one and that lasts so long.
template <class Goes>
void warn_of_stretches(const std::vector<FrameLight>& frames, double seconds, const char* what,
                       const Goes& goes, std::vector<ShowWarning>& warnings) {
  for (std::size_t first = 0; first < frames.size();) {
    std::size_t end = first;
    while (end < frames.size() && goes(frames[first], frames[end])) ++end;
    const double last = end > first ? frames[end - 1].time_s - frames[first].time_s : 0;
    if (last >= seconds)
      warnings.push_back({frames[first].time_s, frames[first].frame, frames[first].segment,
                          fmt::format("the picture is {} for {:.3g} s", what, last)});
    first = std::max(end, first + 1);
  }
}

}  // namespace

LightSurvey survey_light(const Show& show, Renderer& renderer, const Grader* grader) {
  const int count = frame_count(show);
  const int seconds = static_cast<int>(std::ceil(count / show.frames_per_second));
  const int most = show.spacetime.is<SpinningHole>() ? kMostAboutSpin : kMostCostInstants;
  const int samples = std::min(count, std::clamp(seconds + 1, 2, most));
  LightMeter meter(grader);
  std::vector<FrameLight> lights;
  for (int k = 0; k < samples; ++k) {
    // The samples are spread evenly from the first frame to the last.
    const int frame =
        samples > 1 ? static_cast<int>(static_cast<long>(count - 1) * k / (samples - 1)) : 0;
    lights.push_back(measured(show, frame, kSurveyWidth, renderer, meter));
  }
  const auto darker = [](const FrameLight& a, const FrameLight& b) { return a.mean < b.mean; };
  LightSurvey found;
  found.frames = lights;
  found.brightest = *std::max_element(lights.begin(), lights.end(), darker);
  double highest = -HUGE_VAL;
  // A fade counts like an exposure that is lower by its logarithm in stops.
  const auto stops = [](const FrameLight& light) { return light.ev + std::log2(light.fade); };
  for (const FrameLight& light : lights) highest = std::max(highest, stops(light));
  std::erase_if(lights,
                [&](const FrameLight& light) { return stops(light) < highest - kFadeStops; });
  found.darkest = *std::min_element(lights.begin(), lights.end(), darker);
  return found;
}

std::vector<ShowWarning> light_warnings(const Show& show, Renderer& renderer,
                                        const LightSurvey& survey) {
  const std::size_t most_pairs = show.spacetime.is<SpinningHole>() ? 2 : 16;
  constexpr int kSureWidth = 256;
  std::vector<std::pair<FrameLight, FrameLight>> pairs;
  for (std::size_t k = 1; k < survey.frames.size(); ++k)
    if (step(survey.frames[k - 1], survey.frames[k]) > kLargestLightStep)
      pairs.emplace_back(survey.frames[k - 1], survey.frames[k]);
  std::ranges::stable_sort(pairs, std::greater(),
                           [](const auto& pair) { return step(pair.first, pair.second); });
  pairs.resize(std::min(pairs.size(), most_pairs));
  LightMeter meter(nullptr);
  std::vector<ShowWarning> warnings;
  const auto is_black = [](const FrameLight&, const FrameLight& light) {
    return light.percentile99 < kBlackLight && light.fade > 0.5;
  };
  const auto is_unchanged = [](const FrameLight& first, const FrameLight& light) {
    return first.mean > 0 && light.mean > 0 && moved(first, light) < kUnchangedLight;
  };
  warn_of_stretches(survey.frames, kLongBlack, "black", is_black, warnings);
  warn_of_stretches(survey.frames, kLongUnchanged, "nearly the same", is_unchanged, warnings);
  for (auto& [a, b] : pairs) {
    while (b.frame - a.frame > 1 && step(a, b) > kLargestLightStep) {
      const FrameLight middle =
          measured(show, (a.frame + b.frame) / 2, kSurveyWidth, renderer, meter);
      (step(a, middle) > step(middle, b) ? b : a) = middle;
    }
    // A cut from one segment to the next is meant.
    if (!(step(a, b) > kLargestLightStep) || a.segment != b.segment) continue;
    // So small a frame may have missed bright edges of a sky.
    a = measured(show, a.frame, kSureWidth, renderer, meter);
    b = measured(show, b.frame, kSureWidth, renderer, meter);
    if (!(step(a, b) > kLargestLightStep)) continue;
    warnings.push_back({b.time_s, b.frame, b.segment,
                        fmt::format("the mean light jumps from {:.2g} to {:.2g} between two frames",
                                    a.mean, b.mean)});
  }
  std::ranges::stable_sort(warnings, {}, &ShowWarning::frame);
  return warnings;
}

}  // namespace domefall
