#include "pipeline/theatre/movie/listening.h"

#include <fmt/format.h>

#include <vector>

#include "pipeline/base/child_program.h"
#include "pipeline/base/errors.h"
#include "pipeline/theatre/movie/preset.h"
#include "pipeline/theatre/sound/sound.h"

namespace domefall {
namespace {

// Returns the filter by which a sound becomes stereo.  ffmpeg knows what to do with channels that
// have names.  Of others, such as the speakers of a dome by their numbers, both ears hear the mean.
std::string to_stereo(const Sound& sound) {
  constexpr int kMostGuessed = 8;  // channels of one file, for which ffmpeg has names
  const bool named =
      sound.files.size() == 1 ? sound.channels <= kMostGuessed : !sound.layout.empty();
  if (named) return "aformat=channel_layouts=stereo";
  std::string mean;
  for (int k = 0; k < sound.channels; ++k)
    mean += fmt::format("{}{:.6f}*c{}", k > 0 ? "+" : "", 1.0 / sound.channels, k);
  return fmt::format("pan=stereo|c0={}|c1={}", mean, mean);
}

}  // namespace

std::string sound_for_browser(const Show& show) {
  if (show.audio.empty()) throw InputError("the show names no audio");
  const Sound sound = show_sound(show, {});
  const std::string filter =
      sound_filter(sound, 0, 0, frame_count(show), frame_rate_of(show.frames_per_second)) +
      ";[sound]" + to_stereo(sound) + "[stereo]";
  const MemoryFile made("the sound of the preview");
  std::vector<std::string> arguments{"ffmpeg", "-nostdin", "-hide_banner", "-v", "error", "-y"};
  for (const std::string& option : sound_inputs(sound)) arguments.push_back(option);
  for (const std::string& option :
       {std::string("-filter_complex"), filter, std::string("-map"), std::string("[stereo]"),
        std::string("-c:a"), std::string("aac"), std::string("-b:a"), std::string("160k"),
        std::string("-movflags"), std::string("+faststart"), std::string("-f"), std::string("mp4"),
        "file:" + made.path()})
    arguments.push_back(option);
  const ChildOutcome outcome = ChildProgram(arguments, {made.number()}, "ffmpeg").wait();
  if (!outcome.good())
    throw TemporaryError(fmt::format("the sound cannot be heard here: ffmpeg {}", outcome.text()));
  return made.contents();
}

}  // namespace domefall
