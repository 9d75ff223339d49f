#include "pipeline/cli/graded_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "pipeline/cli/frame_run.h"
#include "pipeline/cli/frame_survey.h"
#include "pipeline/deliver/in_parallel.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/image/image_formats.h"

namespace domefall {
namespace {

const Show& with_graded_frames(const Show& show) {
  if (!show.output.graded)
    throw InputError(show.file.string() +
                     ": the show keeps no graded frames (output: {graded: none})");
  return show;
}

}  // namespace

GradedFrames::GradedFrames(const Show& show, const std::filesystem::path& folder)
    : show_(with_graded_frames(show)),
      folder_(folder, show),
      grader_(show.grade),
      keys_(show, grader_.transform_id() + format_id(*show.output.graded)) {}

std::string GradedFrames::key(int frame) const {
  const FrameState state = frame_state(show_, frame);
  return keys_.graded(keys_.scene(state), state);
}

WantedFrame GradedFrames::wanted(int frame) const { return folder_.wanted(key(frame)); }

GradedInfo GradedFrames::info(int frame) const {
  GradedInfo info;
  info.key = key(frame);
  info.title = show_.title;
  info.frame = frame;
  info.display = grader_.display();
  info.view = grader_.view();
  info.software = kSoftware;
  info.projection = projection_name(show_.projection);
  info.colour = grader_.colour();
  return info;
}

void GradedFrames::check(const std::vector<int>& frames, int threads) const {
  std::vector<FrameCondition> conditions(frames.size());
  in_parallel(static_cast<int>(frames.size()), threads, [&](int k) {
    const int frame = frames[static_cast<std::size_t>(k)];
    conditions[static_cast<std::size_t>(k)] = examine_frame(file(frame), wanted(frame));
  });
  const auto of = [&](FrameCondition condition) {
    std::vector<int> found;
    for (std::size_t k = 0; k < frames.size(); ++k)
      if (conditions[k] == condition) found.push_back(frames[k]);
    return found;
  };
  using enum FrameCondition;
  const auto good = of(kGood).size();
  if (good == frames.size()) return;
  std::string what = fmt::format("{}: {} of {} frames cannot be used", folder_.path().string(),
                                 frames.size() - good, frames.size());
  constexpr std::array<std::pair<FrameCondition, const char*>, 4> kWords{
      {{kMissing, "missing"},
       {kDamaged, "damaged"},
       {kOlder, "of another version of the show, or of another grade or quality"},
       {kOther, "of another size, show or kind"}}};
  for (const auto& [condition, words] : kWords)
    if (const auto found = of(condition); !found.empty())
      what += fmt::format("\n  {}: {}", words, as_ranges(found));
  if (const auto others = of(kOther); !others.empty())
    throw InputError(
        fmt::format("{}\nsuch as {} ({}); another --from or --size may fit them", what,
                    file(others.front()).string(),
                    describe_difference(file(others.front()), wanted(others.front()))));
  throw TemporaryError(what + "\n`domefall render` makes these");
}

GradedFrame GradedFrames::read(int frame) const {
  const auto reader = image_formats().open(file(frame));
  GradedFrame picture(reader->layout().width, reader->layout().height);
  const bool ours = picture.width == columns(show_.projection) &&
                    picture.height == rows(show_.projection) && reader->layout().channels == 3;
  if (ours) reader->read(picture.row(0));
  // The file may have been changed between its check and its reading, and so is held against its
  // key again.
  if (!ours || examine_frame(file(frame), wanted(frame)) != FrameCondition::kGood)
    throw TemporaryError(file(frame).string() + ": the file was changed meanwhile; run again");
  return picture;
}

int frames_at_once(const Show& show, int threads) {
  // A pixel of 16 bits is held twice, as it is read and as it is drawn or packed.
  constexpr std::int64_t kMost = std::int64_t{1} << 30, kBytesOfPixel = 16;
  const std::int64_t pixels = std::int64_t{columns(show.projection)} * rows(show.projection);
  return static_cast<int>(
      std::clamp<std::int64_t>(kMost / (kBytesOfPixel * pixels), 1, std::max(threads, 1)));
}

}  // namespace domefall
