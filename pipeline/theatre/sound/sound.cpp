#include "pipeline/theatre/sound/sound.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

struct NamedChannel {
  std::string_view name, of_ffmpeg;
  std::array<std::string_view, 3> words;  // as files' names end, in lower case
};
// In the order of WAV.
constexpr std::array<NamedChannel, 10> kWaveChannels{{{"L", "FL", {"l", "left", "fl"}},
                                                      {"R", "FR", {"r", "right", "fr"}},
                                                      {"C", "FC", {"c", "center", "centre"}},
                                                      {"LFE", "LFE", {"lfe", "sub"}},
                                                      {"Lb", "BL", {"lb", "lrs", "lsr"}},
                                                      {"Rb", "BR", {"rb", "rrs", "rsr"}},
                                                      {"Cs", "BC", {"cs"}},
                                                      {"Ls", "SL", {"ls", "lss"}},
                                                      {"Rs", "SR", {"rs", "rss"}},
                                                      {"T", "TC", {"t", "top"}}}};
constexpr const char* kChannelNames = "L, R, C, LFE, Lb, Rb, Cs, Ls, Rs, T";

std::string last_word(const fs::path& file) {
  const std::string stem = file.stem().string();
  return in_lower_case(stem.substr(stem.find_last_of("_-. ") + 1));
}

// Returns the index of a file's channel in kWaveChannels, or kNone.
constexpr int kNone = -1;
int channel_index(const fs::path& file) {
  const std::string word = last_word(file);
  const auto at = std::ranges::find_if(kWaveChannels, [&](const NamedChannel& channel) {
    return !word.empty() && std::ranges::find(channel.words, word) != channel.words.end();
  });
  return at == kWaveChannels.end() ? kNone : static_cast<int>(at - kWaveChannels.begin());
}

// Returns the number, from 0, of a file whose name ends in one from 1 to kMostSoundChannels, or
// kNone.
int channel_number(const fs::path& file) {
  const std::string word = last_word(file);
  int number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_one = error == std::errc() && end == word.data() + word.size() && number >= 1 &&
                      number <= kMostSoundChannels;
  return is_one ? number - 1 : kNone;
}

// Sorts files by what `index` says of each.  Throws InputError where it says nothing or the same of
// two.
template <class Index>
std::vector<std::pair<int, fs::path>> sorted_by(const std::vector<fs::path>& files, Index index) {
  std::vector<std::pair<int, fs::path>> sorted;
  for (const fs::path& file : files) {
    sorted.emplace_back(index(file), file);
    if (sorted.back().first == kNone)
      throw InputError(fmt::format(
          "audio: of several files each is one channel, and its name ends in {}, or all end in "
          "1, 2, 3 and so on, such as show_LFE.wav; {} does not",
          kChannelNames, file.string()));
  }
  std::ranges::stable_sort(sorted, {}, &std::pair<int, fs::path>::first);
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[k - 1].first)
      throw InputError(fmt::format("audio: more than one file is the channel {}: {} and {}",
                                   last_word(sorted[k].second), sorted[k - 1].second.string(),
                                   sorted[k].second.string()));
  return sorted;
}

std::vector<fs::path> numbered(const std::vector<fs::path>& files) {
  std::vector<fs::path> in_order;
  for (const auto& [number, file] : sorted_by(files, channel_number)) {
    if (number != static_cast<int>(in_order.size()))
      throw InputError(fmt::format("audio: {} files are the channels 1 to {}, and none ends in {}",
                                   files.size(), files.size(), in_order.size() + 1));
    in_order.push_back(file);
  }
  return in_order;
}

// Sorts files by the names of their channels, and writes the layout.  Without channels at the back,
// those at the sides are called so, as in ffmpeg's 5.1.
std::vector<fs::path> named(const std::vector<fs::path>& files, std::string& layout) {
  const auto sorted = sorted_by(files, channel_index);
  const bool has_back = std::ranges::any_of(sorted, [](const auto& channel) {
    const std::string_view name = kWaveChannels[static_cast<std::size_t>(channel.first)].of_ffmpeg;
    return name == "BL" || name == "BR";
  });
  std::vector<fs::path> in_order;
  for (const auto& [index, file] : sorted) {
    std::string name(kWaveChannels[static_cast<std::size_t>(index)].of_ffmpeg);
    if (!has_back && name[0] == 'S') name = name == "SL" ? "BL" : "BR";
    layout += (layout.empty() ? "" : "+") + name;
    in_order.push_back(file);
  }
  return in_order;
}

std::vector<fs::path> in_order(const std::vector<fs::path>& files, std::string& layout) {
  if (files.size() < 2) return files;
  if (files.size() > kMostSoundChannels)
    throw InputError(fmt::format("audio: {} files; one for each of {} channels are the most",
                                 files.size(), kMostSoundChannels));
  return channel_number(files.front()) == kNone ? named(files, layout) : numbered(files);
}

void require_one_channel_each(const std::vector<SoundFile>& files) {
  if (files.size() < 2) return;
  const SoundFile& first = files.front();
  for (const SoundFile& file : files) {
    if (file.channels != 1)
      throw InputError(fmt::format("{}: one of several files has one channel, and this one {}",
                                   file.file.string(), file.channels));
    if (file.rate != first.rate || file.bits != first.bits)
      throw InputError(fmt::format("{}: the sound has {} Hz and {} bits, and {} has {} and {}",
                                   file.file.string(), file.rate, file.bits, first.file.string(),
                                   first.rate, first.bits));
  }
}

}  // namespace

Sound read_sound(const std::vector<fs::path>& files) {
  Sound sound;
  for (const fs::path& file : in_order(files, sound.layout)) {
    sound.files.push_back(read_sound_file(file));
    sound.channels += sound.files.back().channels;
  }
  require_one_channel_each(sound.files);
  return sound;
}

std::string channel_of_name(const fs::path& file) {
  const int index = channel_index(file);
  return index == kNone ? std::string()
                        : std::string(kWaveChannels[static_cast<std::size_t>(index)].name);
}

std::vector<std::string> check_length(const Sound& sound, int frames, const FrameRate& rate) {
  std::vector<std::string> notes;
  if (sound.files.empty()) return notes;
  const double length = duration_of(frames, rate), frame = duration_of(1, rate);
  const auto both = [&](const SoundFile& file) {
    return fmt::format(
        "{}: the sound lasts {:.3f} s, and the show {:.3f} s ({} frames at {} a "
        "second)",
        file.file.string(), file.seconds(), length, frames, text_of(rate));
  };
  for (const SoundFile& file : sound.files) {
    const double most = length + frame + (file.padded ? kEncoderPadding : 0);
    // A sample more than the frame is no fault of the sound, since both are whole numbers.
    if (file.seconds() > most + 1.0 / file.rate)
      throw InputError(both(file) +
                       "; it may be longer by one frame; cut it, or make the show longer");
    if (file.wave && file.wave->unfilled)
      notes.push_back(fmt::format(
          "{}: its head does not say how long it is, as when a program writes into a pipe; it is "
          "taken to last to the end of the file, {:.3f} s",
          file.file.string(), file.seconds()));
  }
  const auto [shortest, longest] =
      std::ranges::minmax_element(sound.files, {}, &SoundFile::seconds);
  if (samples_within(*longest, frames, rate) < longest->frames)
    notes.push_back(both(*longest) + "; what is beyond the last frame is left out");
  if (shortest->seconds() < length - frame)
    notes.push_back(both(*shortest) + "; the rest is silent");
  return notes;
}

std::uint64_t samples_within(const SoundFile& sound, int frames, const FrameRate& rate) {
  // The last sample that begins within the frames is theirs.  Rounding makes none of a whole
  // number.
  constexpr double kRounding = 1e-6;
  const double samples = duration_of(frames, rate) * sound.rate;
  return std::min(sound.frames, static_cast<std::uint64_t>(std::ceil(samples - kRounding)));
}

Sound show_sound(const Show& show, const std::vector<std::string>& files) {
  Sound sound =
      read_sound(files.empty() ? show.audio : std::vector<fs::path>(files.begin(), files.end()));
  for (const std::string& note :
       check_length(sound, frame_count(show), frame_rate_of(show.frames_per_second)))
    say(note);
  return sound;
}

}  // namespace domefall
