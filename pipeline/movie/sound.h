// The sound of a movie is one file of any number of channels, or one file for each of six.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/image/frame_rate.h"

namespace domefall {

struct Sound {
  std::vector<std::filesystem::path> files;  // six in the order L R C LFE Ls Rs
  int channels = 0;
  double seconds = 0;  // the longest file
};

// Looks at the files by the program ffprobe.  One file is taken as it is.  Six are channels, each
// named at the end of its file's name, after `_`, `-`, `.` or a blank and in any case: L, R, C,
// LFE, Ls, Rs.  No file means no sound.  Throws InputError for other numbers of files, for a name
// that is missing or double, for a file without sound and for one of six that has more channels.
// Throws TemporaryError without the program.
Sound read_sound(const std::vector<std::filesystem::path>& files);

// Checks the length of a sound, which has to begin with the show.  Throws InputError if it is
// longer by more than half a frame.  Returns a warning if it is shorter by more than that, and
// otherwise an empty text.
std::string compare_lengths(const Sound& sound, int frames, const FrameRate& rate);

// Returns ffmpeg's options for sound that comes with the frames first to first + count - 1 of a
// show.  They are those of its inputs, which follow the one of the frames, and those by which they
// become one stream as long as the frames.
std::vector<std::string> sound_inputs(const Sound& sound);
std::vector<std::string> sound_options(const Sound& sound, int first, int count,
                                       const FrameRate& rate);

}  // namespace domefall
