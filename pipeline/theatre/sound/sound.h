// The sound of a show is one file with all channels, or one file for each of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/base/frame_rate.h"
#include "pipeline/show/show.h"
#include "pipeline/theatre/sound/sound_file.h"

namespace domefall {

struct Sound {
  std::vector<SoundFile> files;  // none, one, or one a channel in the order of WAV
  int channels = 0;              // of all files together
  // The channels of several files in ffmpeg's words, FL+FR+FC+LFE+BL+BR.  It is empty for one file,
  // which may say this itself, and where the names are numbers.
  std::string layout;
};

// Reads the files of a sound.  Several files are one channel each, at most kMostSoundChannels, all of
// one rate and depth.  The name of each ends in its channel, after `_`, `-`, `.` or a blank and in
// any case: L, R, C, LFE, Lb, Rb, Ls, Rs, Cs, T, or 1, 2, 3 and so on.  Throws InputError for names
// that are missing, double or unknown.  Also throws as read_sound_file().
Sound read_sound(const std::vector<std::filesystem::path>& files);

// Returns L, R, C, LFE, Lb, Rb, Ls, Rs, Cs or T if the name of a file ends in it, as above, and
// otherwise an empty text.
std::string channel_of_name(const std::filesystem::path& file);

// Checks the length of a sound, which has to begin with the show.  It may be longer by one frame of
// the show, and where it was packed by an encoder by kEncoderPadding besides.  Throws InputError if
// it is longer.  Returns lines for people: what is cut, what is silent, and which length is a
// guess.
std::vector<std::string> check_length(const Sound& sound, int frames, const FrameRate& rate);
// Encoders of MP3, AAC and the like put up to some 4000 samples before and behind a sound.
inline constexpr double kEncoderPadding = 0.1;  // s

// Reads the files of --audio or, if there are none, those that the show names, and holds their
// length against the show.  Says on standard error what
// of them is left out or silent.  Throws as read_sound() and check_length().
Sound show_sound(const Show& show, const std::vector<std::string>& files);

// Returns how many samples of a file belong to so many frames of a show: all that it has, or fewer.
std::uint64_t samples_within(const SoundFile& sound, int frames, const FrameRate& rate);

}  // namespace domefall
