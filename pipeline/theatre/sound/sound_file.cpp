#include "pipeline/theatre/sound/sound_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "pipeline/base/child_program.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

constexpr std::uint64_t kChunkHead = 8, kRiffHead = 12;
constexpr std::uint32_t kSizeIsElsewhere = 0xffffffff;

// Says whether a program wrote this size of "data" because it did not know it yet.  Most write 0 or
// the largest number.  arecord and sox write about 2 GiB, less their head or a part of a block.
bool is_no_size(std::uint64_t size, std::uint64_t left) {
  constexpr std::uint64_t kTwoGibi = 0x80000000, kFourGibi = 0xffffffff, kAbout = 0x2000;
  const auto is_near = [&](std::uint64_t bound) { return size <= bound && bound - size <= kAbout; };
  return size == 0 || (size > left && (is_near(kTwoGibi) || is_near(kFourGibi)));
}

struct WaveChunks {
  std::string format;       // the data of "fmt "
  std::uint64_t sound = 0;  // bytes of "data"
  std::uint64_t long_size = 0;
  bool has_sound = false;
  WaveData wave;
};

std::uint64_t take_chunk(const FileBytes& file, std::uint64_t at, const std::string& start,
                         bool large, WaveChunks& chunks) {
  constexpr std::uint64_t kLeastFormat = 16, kLeastLong = 16, kMostHead = 4096;
  const std::uint64_t begin = at + kChunkHead, left = file.size() - begin;
  std::uint64_t size = little_endian<std::uint32_t>(std::string_view(start).substr(4));
  if (start.starts_with("data")) {
    if (large && size == kSizeIsElsewhere) size = chunks.long_size;
    chunks.wave.begin = begin;
    chunks.wave.unfilled = is_no_size(size, left);
    if (chunks.wave.unfilled) size = left;
    chunks.sound = size;
    chunks.has_sound = true;
  }
  if (size > left) throw DamagedFile("it ends before its sound does");
  if (start.starts_with("ds64") && size >= kLeastLong) {
    chunks.long_size = little_endian<std::uint64_t>(file.at(begin + 8, 8));
    chunks.wave.long_sizes_at = begin;
  }
  if (start.starts_with("fmt ")) {
    if (size < kLeastFormat || size > kMostHead) throw DamagedFile("its format makes no sense");
    chunks.format = file.at(begin, size);
  }
  return size;
}

WaveChunks wave_chunks(const FileBytes& file) {
  const bool large = file.at(0, 4) != "RIFF";
  WaveChunks chunks;
  for (std::uint64_t at = kRiffHead; !chunks.has_sound || chunks.format.empty();) {
    if (chunks.has_sound && chunks.wave.unfilled)
      throw DamagedFile("its format is not before its sound");
    if (at > file.size() || file.size() - at < kChunkHead)
      throw DamagedFile("it ends before its sound does");
    const std::uint64_t size = take_chunk(file, at, file.at(at, kChunkHead), large, chunks);
    if (large && chunks.has_sound && chunks.wave.long_sizes_at == 0)
      throw DamagedFile("it is of RF64 or BW64, and has no chunk ds64 before its sound");
    at += kChunkHead + size + size % 2;  // chunks begin at even offsets
  }
  return chunks;
}

constexpr unsigned kPcm = 1, kFloat = 3;
constexpr std::uint32_t kLeastRate = 1000, kMostRate = 768'000;  // Hz

// Returns the tag of a format.  That of WAVE_FORMAT_EXTENSIBLE is in a GUID whose first two bytes
// are the tag that a short format would have.
unsigned tag_of(const std::string& format) {
  constexpr unsigned kExtensible = 0xfffe;
  constexpr std::size_t kSubformat = 24, kGuid = 16;
  const unsigned tag = little_endian<std::uint16_t>(format);
  if (tag != kExtensible) return tag;
  if (format.size() < kSubformat + kGuid) throw DamagedFile("its format makes no sense");
  return little_endian<std::uint16_t>(std::string_view(format).substr(kSubformat));
}

void require_known_bits(const SoundFile& sound, unsigned tag) {
  constexpr int kByte = 8, kLong = 32, kDouble = 64;
  const bool known = tag == kFloat ? sound.bits == kLong || sound.bits == kDouble
                                   : sound.bits >= kByte && sound.bits <= kLong;
  if (!known)
    throw DamagedFile(fmt::format(
        "its samples are {} of {} bits; a WAV file has whole numbers of 8 to 32 bits, such as 16 "
        "or 24, or floating-point numbers of 32 or 64",
        tag == kFloat ? "floating-point numbers" : "whole numbers", sound.bits));
}

// Returns nothing for a WAV file that packs its sound, as some do with MP3.
std::optional<SoundFile> wave_file(const FileBytes& file) {
  const WaveChunks chunks = wave_chunks(file);
  const auto number = [&](std::size_t at) {
    return little_endian<std::uint16_t>(std::string_view(chunks.format).substr(at));
  };
  const unsigned tag = tag_of(chunks.format);
  if (tag != kPcm && tag != kFloat) return std::nullopt;
  SoundFile sound;
  sound.format = tag == kPcm ? "PCM" : "floating point";
  sound.channels = number(2);
  sound.rate = little_endian<std::uint32_t>(std::string_view(chunks.format).substr(4));
  sound.bits = number(14);
  sound.wave = chunks.wave;
  sound.wave->block = number(12);
  sound.wave->is_float = tag == kFloat;
  require_known_bits(sound, tag);
  if (sound.rate < kLeastRate || sound.rate > kMostRate)
    throw DamagedFile(
        fmt::format("its rate is {} Hz; it must be {} to {}", sound.rate, kLeastRate, kMostRate));
  if (sound.channels < 1 || sound.wave->block != sound.channels * ((sound.bits + 7) / 8))
    throw DamagedFile("its format makes no sense");
  sound.frames = chunks.sound / static_cast<unsigned>(sound.wave->block);
  return sound;
}

bool is_wave_file(const FileBytes& file) {
  if (file.size() < kRiffHead) return false;
  const std::string head = file.at(0, kRiffHead);
  constexpr std::array<std::string_view, 3> kKinds{"RIFF", "RF64", "BW64"};
  return head.substr(8) == "WAVE" &&
         std::ranges::any_of(kKinds, [&](std::string_view kind) { return head.starts_with(kind); });
}

// ---- other formats ----

constexpr const char* kFfmpegPackage = "ffmpeg";

std::string_view value_of(std::string_view text, std::string_view key) {
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + key.size());
  return text.substr(0, text.find('\n'));
}

template <class Number>
Number number_in(std::string_view text) {
  Number value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// Returns how many samples ffmpeg decodes of each channel.  What a file says of its length may be a
// guess, and counts what its encoder has put before and behind the sound.
std::uint64_t count_samples(const std::filesystem::path& file) {
  std::vector<std::string> command{"ffmpeg", "-nostdin", "-hide_banner", "-v", "error"};
  for (std::string& option : ffmpeg_input(file)) command.push_back(std::move(option));
  for (const char* option :
       {"-map", "0:a:0", "-af", "pan=mono|c0=c0", "-c:a", "pcm_u8", "-f", "u8", "pipe:1"})
    command.emplace_back(option);
  ChildProgram ffmpeg(std::move(command), {}, kFfmpegPackage);
  const ChildOutcome outcome = ffmpeg.wait();
  if (!outcome.good()) throw DamagedFile("ffmpeg " + outcome.text());
  return ffmpeg.output_bytes();
}

SoundFile packed_file(const std::filesystem::path& file) {
  std::vector<std::string> command{
      "ffprobe",
      "-v",
      "error",
      "-select_streams",
      "a:0",
      "-show_entries",
      "stream=codec_name,channels,sample_rate,bits_per_sample,bits_per_raw_sample",
      "-of",
      "default=noprint_wrappers=1"};
  for (std::string& option : ffmpeg_input(file)) command.push_back(std::move(option));
  ChildProgram probe(std::move(command), {}, kFfmpegPackage);
  const ChildOutcome outcome = probe.wait();
  const std::string_view text = probe.output();
  SoundFile sound;
  sound.format = value_of(text, "codec_name=");
  sound.channels = number_in<int>(value_of(text, "channels="));
  sound.rate = number_in<std::uint32_t>(value_of(text, "sample_rate="));
  if (!outcome.good() || sound.channels < 1 || sound.rate < 1)
    throw DamagedFile("it is no WAV file, and " + (outcome.good()
                                                       ? std::string("ffprobe finds no sound in it")
                                                       : "ffprobe " + outcome.text()));
  constexpr std::array<std::string_view, 5> kLossless{"flac", "alac", "wavpack", "tta", "ape"};
  sound.padded = !sound.format.starts_with("pcm_") &&
                 std::ranges::find(kLossless, sound.format) == kLossless.end();
  if (!sound.padded)
    sound.bits = std::max(number_in<int>(value_of(text, "bits_per_sample=")),
                          number_in<int>(value_of(text, "bits_per_raw_sample=")));
  sound.frames = count_samples(file);
  return sound;
}

SoundFile sound_of(const std::filesystem::path& path) {
  const auto file = FileBytes::open(path);
  if (!file) throw DamagedFile("it was removed");
  std::optional<SoundFile> sound;
  if (is_wave_file(*file)) sound = wave_file(*file);
  if (!sound) sound = packed_file(path);
  if (sound->frames == 0) throw DamagedFile("there is no sound in it");
  if (sound->channels > kMostSoundChannels)
    throw DamagedFile(
        fmt::format("it has {} channels; {} are the most", sound->channels, kMostSoundChannels));
  sound->file = path;
  return *sound;
}

std::string bytes_of(std::uint64_t number, int count) {
  std::string bytes;
  for (int k = 0; k < count; ++k, number >>= 8) bytes += static_cast<char>(number & 0xff);
  return bytes;
}

}  // namespace

std::vector<std::string> ffmpeg_input(const std::filesystem::path& file) {
  constexpr const char* kFormats =
      "wav,w64,aiff,caf,au,flac,mp3,aac,ac3,eac3,dts,ogg,mov,matroska,wv,tta,ape,mpegts,mxf,avi,"
      "asf";
  return {"-protocol_whitelist",
          "file",
          "-format_whitelist",
          kFormats,
          "-i",
          "file:" + std::filesystem::absolute(file).string()};
}

SoundFile read_sound_file(const std::filesystem::path& path) {
  require_file(path);
  try {
    return sound_of(path);
  } catch (const DamagedFile& error) {
    throw InputError(path.string() + ": no sound that can be used: " + error.what());
  }
}

void copy_wave(const SoundFile& sound, const std::filesystem::path& to) {
  const WaveData& wave = sound.wave.value();
  const std::uint64_t bytes = sound.frames * static_cast<unsigned>(wave.block);
  const std::uint64_t end = wave.begin + bytes;
  RegularFile source(sound.file);
  NewFile made(to);
  std::string block(std::size_t{1} << 20, '\0');
  for (std::uint64_t left = end; left > 0;) {
    const std::size_t count = source.read(
        block.data(), static_cast<std::size_t>(std::min<std::uint64_t>(left, block.size())));
    if (count == 0)
      throw TemporaryError(sound.file.string() + ": the file was cut short meanwhile");
    made.write({block.data(), count});
    left -= count;
  }
  if (bytes % 2 != 0) made.write(std::string_view("\0", 1));
  const std::uint64_t riff = end + bytes % 2 - kChunkHead;
  const auto put = [&made](std::uint64_t at, const std::string& number) {
    made.seek(at);
    made.write(number);
  };
  if (wave.long_sizes_at > 0) {
    put(wave.long_sizes_at, bytes_of(riff, 8) + bytes_of(bytes, 8) + bytes_of(sound.frames, 8));
  } else if (riff < kSizeIsElsewhere) {  // a longer one keeps a head that does not say how long
    put(4, bytes_of(riff, 4));
    put(wave.begin - 4, bytes_of(bytes, 4));
  }
  made.commit();
}

}  // namespace domefall
