#include "pipeline/movie/sound.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>

#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/movie/child_program.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// These are the channels as file names have them, and as ffmpeg calls them.  In its layout 5.1 the
// surround channels are called those at the back.
struct Channel51 {
  std::string_view word, name, of_ffmpeg;
};
constexpr std::array<Channel51, 6> kSurround{{{"l", "L", "FL"},
                                              {"r", "R", "FR"},
                                              {"c", "C", "FC"},
                                              {"lfe", "LFE", "LFE"},
                                              {"ls", "Ls", "BL"},
                                              {"rs", "Rs", "BR"}}};
constexpr const char* kChannelNames = "L, R, C, LFE, Ls, Rs";

// Returns the last word of a file's name without the extension, in lower case.
std::string channel_word(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::string word = stem.substr(stem.find_last_of("_-. ") + 1);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

std::vector<fs::path> by_channel(const std::vector<fs::path>& files) {
  std::vector<fs::path> sorted;
  for (const Channel51& channel : kSurround) {
    const auto is_it = [&](const fs::path& file) { return channel_word(file) == channel.word; };
    const auto found = std::find_if(files.begin(), files.end(), is_it);
    if (std::count_if(files.begin(), files.end(), is_it) != 1)
      throw InputError(fmt::format(
          "--audio: of six files one each must end in {} before the extension, such as "
          "show_LFE.wav; {} {}",
          kChannelNames, found == files.end() ? "none ends in" : "more than one ends in",
          channel.name));
    sorted.push_back(*found);
  }
  return sorted;
}

struct Track {
  int channels = 0;
  double seconds = 0;
};

// Returns the number behind `key` in lines of "key=number", or 0 if there is none.
template <class Number>
Number number_of(std::string_view text, std::string_view key) {
  const std::size_t at = text.find(key);
  Number value = 0;
  if (at != std::string_view::npos)
    std::from_chars(text.data() + at + key.size(), text.data() + text.size(), value);
  return value;
}

Track look_at(const fs::path& file) {
  require_file(file);
  ChildProgram probe({"ffprobe", "-v", "error", "-protocol_whitelist", "file", "-select_streams",
                      "a:0", "-show_entries", "stream=channels,duration", "-of",
                      "default=noprint_wrappers=1", "-i", "file:" + file.string()},
                     {}, "ffmpeg");
  const ChildOutcome outcome = probe.wait();
  const std::string& text = probe.output();
  const Track track{number_of<int>(text, "channels="), number_of<double>(text, "duration=")};
  if (!outcome.good() || track.channels < 1 || !(track.seconds > 0))
    throw InputError(fmt::format("{}: holds no sound whose length ffprobe tells; {}", file.string(),
                                 outcome.good() ? "a WAV file does" : outcome.text()));
  return track;
}

}  // namespace

Sound read_sound(const std::vector<fs::path>& files) {
  Sound sound;
  if (files.empty()) return sound;
  if (files.size() != 1 && files.size() != kSurround.size())
    throw InputError(fmt::format("--audio: takes one file, or six that end in {}; got {}",
                                 kChannelNames, files.size()));
  sound.files = files.size() == 1 ? files : by_channel(files);
  for (const fs::path& file : sound.files) {
    const Track track = look_at(file);
    if (files.size() > 1 && track.channels != 1)
      throw InputError(fmt::format("{}: one of six files has one channel, and this one {}",
                                   file.string(), track.channels));
    sound.channels += track.channels;
    sound.seconds = std::max(sound.seconds, track.seconds);
  }
  return sound;
}

std::string compare_lengths(const Sound& sound, int frames, const FrameRate& rate) {
  if (sound.files.empty()) return {};
  const double length = duration_of(frames, rate), half = duration_of(1, rate) / 2;
  const std::string both =
      fmt::format("{}: the sound lasts {:.3f} s, and the show {:.3f} s ({} frames at {} a second)",
                  sound.files.front().string(), sound.seconds, length, frames, text_of(rate));
  if (sound.seconds > length + half) throw InputError(both + "; cut it, or make the show longer");
  return sound.seconds < length - half ? both + "; the rest is silent" : std::string();
}

std::vector<std::string> sound_inputs(const Sound& sound) {
  std::vector<std::string> options;
  for (const fs::path& file : sound.files)
    for (const std::string& option : {std::string("-protocol_whitelist"), std::string("file"),
                                      std::string("-i"), "file:" + fs::absolute(file).string()})
      options.push_back(option);
  return options;
}

std::vector<std::string> sound_options(const Sound& sound, int first, int count,
                                       const FrameRate& rate) {
  if (sound.files.empty()) return {"-map", "0:v"};
  // All are padded with endless silence, and then cut to the length of the frames.
  std::string filter, labels, map;
  for (std::size_t k = 0; k < sound.files.size(); ++k) {
    filter += fmt::format("[{}:a:0]apad[c{}];", k + 1, k);
    labels += fmt::format("[c{}]", k);
    map += fmt::format("{}{}.0-{}", k == 0 ? "" : "|", k, kSurround[k].of_ffmpeg);
  }
  filter +=
      labels + (sound.files.size() == 1 ? std::string("anull")
                                        : fmt::format("join=inputs={}:channel_layout=5.1:map={}",
                                                      sound.files.size(), map));
  filter += fmt::format(",atrim=start={:.9f}:end={:.9f},asetpts=PTS-STARTPTS[sound]",
                        duration_of(first, rate), duration_of(first + count, rate));
  return {"-filter_complex", filter, "-map", "0:v", "-map", "[sound]"};
}

}  // namespace domefall
