#include "pipeline/deliver/sound_file.h"

#include <string>

#include "pipeline/image/errors.h"
#include "pipeline/image/file_bytes.h"

namespace domefall {
namespace {

constexpr std::uint64_t kChunkHead = 8, kRiffHead = 12;
constexpr std::uint32_t kSizeIsElsewhere = 0xffffffff;

struct WaveChunks {
  std::string format;           // the data of "fmt "
  std::uint64_t sound = 0;      // bytes of "data"
  std::uint64_t long_size = 0;  // of "data", as "ds64" of an RF64 says
  bool has_sound = false;
};

WaveChunks wave_chunks(const FileBytes& file) {
  const std::string head = file.at(0, kRiffHead);
  const bool large = head.starts_with("RF64");
  if ((!large && !head.starts_with("RIFF")) || head.substr(8) != "WAVE")
    throw DamagedFile("it is not a WAV file");
  WaveChunks chunks;
  for (std::uint64_t at = kRiffHead; !chunks.has_sound || chunks.format.empty();) {
    const std::string start = file.at(at, kChunkHead);
    std::uint64_t size = little_endian<std::uint32_t>(std::string_view(start).substr(4));
    if (start.starts_with("data")) {
      if (large && size == kSizeIsElsewhere) size = chunks.long_size;
      chunks.sound = size;
      chunks.has_sound = true;
    }
    if (size > file.size() - at - kChunkHead) throw DamagedFile("it ends before its sound does");
    constexpr std::uint64_t kLeastFormat = 16, kLeastLong = 16, kMostHead = 4096;
    if (start.starts_with("ds64") && size >= kLeastLong)
      chunks.long_size = little_endian<std::uint64_t>(file.at(at + kChunkHead + 8, 8));
    if (start.starts_with("fmt ")) {
      if (size < kLeastFormat || size > kMostHead) throw DamagedFile("its format makes no sense");
      chunks.format = file.at(at + kChunkHead, size);
    }
    at += kChunkHead + size + size % 2;  // chunks begin at even offsets
  }
  return chunks;
}

SoundFile sound_of(const FileBytes& file) {
  const WaveChunks chunks = wave_chunks(file);
  const auto number = [&](std::size_t at) {
    return little_endian<std::uint16_t>(std::string_view(chunks.format).substr(at));
  };
  constexpr unsigned kPcm = 1, kFloat = 3, kExtensible = 0xfffe;
  unsigned tag = number(0);
  if (tag == kExtensible) {
    // The subformat is a GUID whose first two bytes are the tag that a short format would have.
    constexpr std::size_t kSubformat = 24, kGuid = 16;
    if (chunks.format.size() < kSubformat + kGuid) throw DamagedFile("its format makes no sense");
    tag = number(kSubformat);
  }
  if (tag != kPcm && tag != kFloat) throw DamagedFile("its sound is packed; PCM is asked for");
  SoundFile sound;
  sound.channels = number(2);
  sound.rate = little_endian<std::uint32_t>(std::string_view(chunks.format).substr(4));
  sound.bits = number(14);
  const unsigned block = number(12);
  if (sound.channels < 1 || sound.rate < 1 ||
      block !=
          static_cast<unsigned>(sound.channels) * ((static_cast<unsigned>(sound.bits) + 7) / 8) ||
      block < 1)
    throw DamagedFile("its format makes no sense");
  sound.frames = chunks.sound / block;
  return sound;
}

}  // namespace

SoundFile read_sound_file(const std::filesystem::path& path) {
  const auto file = FileBytes::open(require_file(path));
  try {
    if (!file) throw DamagedFile("it was removed");
    return sound_of(*file);
  } catch (const DamagedFile& error) {
    throw InputError(path.string() + ": no sound that can be delivered: " + error.what());
  }
}

}  // namespace domefall
