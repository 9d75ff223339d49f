// A MoviePreset is a kind of movie, which has one use.  It says what ffmpeg has to be told to make
// it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/frame_rate.h"
#include "pipeline/theatre/movie/colour_tags.h"
#include "pipeline/theatre/movie/light_levels.h"
#include "pipeline/theatre/sound/sound.h"

namespace domefall {

struct MoviePreset {
  std::string_view name, what;  // what: a line for people
  std::string_view extension;   // of the file
  int most_width, most_height;  // larger frames are scaled down to fit
  int multiple;                 // width and height are multiples of it
  std::string_view pixels;      // ffmpeg's name of the pixels' format
  bool rgb;                     // of full range; else YCbCr of limited range
  bool burn_in;
  bool whole_sphere;  // of equirectangular frames, of which mkvmerge tells the players
  std::vector<std::string> video, sound;  // ffmpeg's options
  double least_bits;                      // a pixel: what frames take that are all but black
  int most_channels = kMostSoundChannels;
};

const std::vector<MoviePreset>& movie_presets();

// Returns the preset of a name.  Throws InputError for other names.
const MoviePreset& movie_preset(const std::string& name);

// Returns ffmpeg's name of the format that it writes.
std::string_view format_of(const MoviePreset& preset);

struct MovieSize {
  int width = 0, height = 0;
  double pixel_aspect = 1;  // width of a pixel over its height

  bool operator==(const MovieSize&) const = default;
};

// Throws InputError for a rate that no movie has exactly, and for more channels of sound than the
// preset's codec has.
void require_fitting(const MoviePreset& preset, const FrameRate& rate, const Sound& sound);

// Returns the bytes that a movie takes at least, however dark its frames are.
double least_bytes(const MoviePreset& preset, const MovieSize& movie, int frames,
                   const FrameRate& rate, int channels);

// Returns the size of a movie whose frames come in a given size.  It is the same or, where that is
// too large for the preset, the largest one of the same shape that the preset takes.  Throws
// InputError if a size that need not change is not a multiple of what the preset asks for.
MovieSize movie_size(const MoviePreset& preset, const MovieSize& frames);

// Adds words to those of a command line.
inline void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// Returns ffmpeg's options from the frames, which it reads from its standard input as 16-bit RGB,
// to the codec.  `subtitles` is a file in the ASS format in which each frame has a tenth of a
// second (burn_in.h), or empty.
std::vector<std::string> input_options(const MovieSize& frames, const FrameRate& rate);
std::vector<std::string> video_options(const MoviePreset& preset, const MovieSize& frames,
                                       const FrameRate& rate, const ColourTags& tags,
                                       const std::string& subtitles);

// Says whether a movie of these tags has a place for the light levels of its frames: PQ by x265.
bool takes_light_levels(const MoviePreset& preset, const ColourTags& tags);

// A movie that begins before its levels are known is given these, which no frame can have.
inline constexpr LightLevels kLevelsToCome{65534, 65533};
// Returns how the stream of such a movie says them, for players and among the encoder's settings, and
// how it says others, in as many bytes.
std::array<std::string, 2> in_hevc(const LightLevels& levels);

// Gives them to x265, in whole cd/m^2, as part of the options that video_options() returned.
void add_light_levels(std::vector<std::string>& options, const LightLevels& levels);
// Likewise the screen that the frames were graded for.  Its black counts as 0.0001 cd/m^2, the least
// that ST 2086 can say.
void add_mastering_display(std::vector<std::string>& options, const MasteringDisplay& display);

// Returns ffmpeg's filter that makes one stream, [sound], of a sound's files, which are its inputs
// from `input` on.  It has the length of the frames first to first + count - 1 of a show.
std::string sound_filter(const Sound& sound, std::size_t input, int first, int count,
                         const FrameRate& rate);

// Returns ffmpeg's options for sound that comes with the frames first to first + count - 1 of a
// show.  They are those of its inputs, which follow the one of the frames, and those by which they
// become one stream as long as the frames.
std::vector<std::string> sound_inputs(const Sound& sound);
std::vector<std::string> sound_options(const Sound& sound, int first, int count,
                                       const FrameRate& rate);

}  // namespace domefall
