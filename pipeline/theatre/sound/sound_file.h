// A SoundFile is what is known of a file of sound before it is used.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace domefall {

// WaveData says where the samples of a WAV file are.
struct WaveData {
  std::uint64_t begin = 0;          // of the samples, in bytes from the start of the file
  std::uint64_t long_sizes_at = 0;  // where RF64 and BW64 have sizes of 8 bytes; 0 for RIFF
  int block = 0;                    // bytes of the samples of all channels at one instant
  bool unfilled = false;            // the head does not say how many there are
  bool is_float = false;
};

struct SoundFile {
  std::filesystem::path file;
  std::string format;        // "PCM", "floating point", or ffmpeg's name of a codec, such as "mp3"
  int channels = 0;          // 1 to kMostSoundChannels
  int bits = 0;              // of a sample; 0 where the format has no such number
  std::uint32_t rate = 0;    // samples a second of each channel
  std::uint64_t frames = 0;  // samples of each channel
  bool padded = false;       // by an encoder, whose codec gives back more than it was given

  std::optional<WaveData> wave{};  // of a WAV file with PCM or floating-point numbers

  double seconds() const { return static_cast<double>(frames) / rate; }
};

inline constexpr int kMostSoundChannels = 16;

// Reads the heads of RIFF/WAVE, RF64 and BW64 (EBU Tech 3306, ITU-R BS.2088) with PCM of 8 to 32
// bits or floating-point numbers of 32 or 64.  A head that says 0 or the largest sizes there are
// was written into a pipe, and was never filled in; such a file lasts to its end.  Any other format
// is decoded by ffmpeg, once, to learn whether it can be read and how long it lasts.
//
// Throws InputError, naming the file, for a file that holds no such sound, that ends before its
// sound does, or that has too many channels.  Throws as RegularFile, too, and TemporaryError where
// another format is asked of a machine without ffmpeg.
SoundFile read_sound_file(const std::filesystem::path& path);

// Returns the options by which ffmpeg and ffprobe read a file of sound, whatever its name is (-y,
// http:, concat:, %03d).  What is a list of other files, such as a playlist, is refused.
std::vector<std::string> ffmpeg_input(const std::filesystem::path& file);

// Copies the head and the samples of a WAV file, with sizes that are those of sound.frames.  The
// copy appears whole or not at all.  Throws as RegularFile and NewFile.
void copy_wave(const SoundFile& sound, const std::filesystem::path& to);

}  // namespace domefall
