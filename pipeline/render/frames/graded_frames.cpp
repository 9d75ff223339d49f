#include "pipeline/render/frames/graded_frames.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/errors.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/image/read_graded.h"
#include "pipeline/render/frames/frame_findings.h"
#include "pipeline/render/frames/frame_run.h"

namespace domefall {
namespace {

const Show& with_graded_frames(const Show& show) {
  if (!show.output.graded)
    throw InputError(show.file.string() +
                     ": the show keeps no graded frames (output: {graded: none})");
  return show;
}

}  // namespace

std::string grade_id(const Show& show, const Grader* grader) {
  return grader ? grader->transform_id() + format_id(*show.output.graded) : std::string();
}

GradedFrames::GradedFrames(const Show& show, const Grader& grader,
                           const std::filesystem::path& folder)
    : show_(with_graded_frames(show)),
      folder_(folder, show),
      grader_(grader),
      keys_(show, grade_id(show, &grader)) {}

std::string GradedFrames::key(int frame) const {
  const FrameState state = frame_state(show_, frame);
  return keys_.graded(keys_.scene(state), state);
}

GradedInfo GradedFrames::info(int frame) const {
  return graded_info(show_, show_.projection, frame, grader_, key(frame));
}

void GradedFrames::check(const std::vector<int>& frames, int threads,
                         const std::string& hint_for_others, const std::string& hint) const {
  using enum FrameCondition;
  const std::vector<ExpectedFile> files = folder_.files(frames, keys_, FrameFiles::kGraded);
  const FolderFindings found =
      sum_up(files, look_at_files(files, threads, [](const ExpectedFile& file) {
               return FileFinding{check_frame(file.path, file.wanted)};
             }));
  const std::size_t good = found.good().size();
  if (good == frames.size()) return;
  std::string what = fmt::format("{}: {} of {} frames cannot be used", folder_.path().string(),
                                 frames.size() - good, frames.size());
  for (const FrameCondition condition : {kMissing, kDamaged, kOlder, kOther})
    if (!found.of(condition).empty())
      what += fmt::format("\n  {}: {}", words_of(condition), as_ranges(found.of(condition)));
  if (found.others.empty()) throw TemporaryError(what + "\n`domefall render` makes these" + hint);
  throw InputError(fmt::format("{}\nsuch as {} ({}); {}", what,
                               file(found.others.front().frame).string(),
                               found.others.front().reason, hint_for_others));
}

GradedFrame GradedFrames::read(int frame) const {
  GradedFrame picture;
  if (read_graded(file(frame), wanted(frame), picture) != FrameCondition::kGood)
    throw TemporaryError(file(frame).string() +
                         ": the file was changed or removed meanwhile; run again");
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
