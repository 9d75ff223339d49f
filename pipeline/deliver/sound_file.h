// The head of a WAV file says how long its sound is.
#pragma once

#include <cstdint>
#include <filesystem>

namespace domefall {

struct SoundFile {
  int channels = 0;
  int bits = 0;              // of a sample
  std::uint32_t rate = 0;    // samples a second of each channel
  std::uint64_t frames = 0;  // samples of each channel

  double seconds() const { return static_cast<double>(frames) / rate; }
};

// Reads RIFF/WAVE and RF64 (EBU Tech 3306) with PCM of integers or floating-point numbers.  Throws
// InputError, naming the file, for anything else and for a file that ends before its sound does.
// Throws as RegularFile, too.
SoundFile read_sound_file(const std::filesystem::path& path);

}  // namespace domefall
