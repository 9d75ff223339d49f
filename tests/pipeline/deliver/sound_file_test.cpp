#include "pipeline/deliver/sound_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "pipeline/image/errors.h"
#include "pipeline/image/scratch_folder.h"

namespace domefall {
namespace {

std::string bytes_of(std::uint64_t number, int count) {
  std::string bytes;
  for (int k = 0; k < count; ++k) bytes += static_cast<char>(number >> 8 * k & 0xff);
  return bytes;
}

std::string chunk_of(const std::string& name, const std::string& data) {
  return name + bytes_of(data.size(), 4) + data + std::string(data.size() % 2, '\0');
}

std::string format_chunk(unsigned tag, unsigned channels, unsigned rate, unsigned bits,
                         const std::string& extension = "") {
  const unsigned block = channels * ((bits + 7) / 8);
  return chunk_of("fmt ", bytes_of(tag, 2) + bytes_of(channels, 2) + bytes_of(rate, 4) +
                              bytes_of(std::uint64_t{rate} * block, 4) + bytes_of(block, 2) +
                              bytes_of(bits, 2) + extension);
}

// WAVE_FORMAT_EXTENSIBLE has the tag in a GUID behind its own size, the valid bits and the speakers.
std::string extensible_chunk(unsigned tag) {
  return format_chunk(0xfffe, 2, 48000, 24,
                      bytes_of(22, 2) + bytes_of(24, 2) + bytes_of(3, 4) + bytes_of(tag, 2) +
                          std::string("\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71", 14));
}

std::string wave_of(const std::string& chunks) {
  return "RIFF" + bytes_of(chunks.size() + 4, 4) + "WAVE" + chunks;
}

class SoundFiles : public testing::Test {
 protected:
  SoundFile read(const std::string& bytes) const {
    std::ofstream(folder_ / "a.wav", std::ios::binary) << bytes;
    return read_sound_file(folder_ / "a.wav");
  }
  ScratchFolder folder_;
};

TEST_F(SoundFiles, SayHowLongTheyLast) {
  const SoundFile stereo = read(wave_of(chunk_of("LIST", "odd") + format_chunk(1, 2, 48000, 24) +
                                        chunk_of("data", std::string(6 * 4800, '\0'))));
  EXPECT_EQ(stereo.channels, 2);
  EXPECT_EQ(stereo.bits, 24);
  EXPECT_EQ(stereo.rate, 48000u);
  EXPECT_DOUBLE_EQ(stereo.seconds(), 0.1);
  const SoundFile floating =
      read(wave_of(format_chunk(3, 1, 44100, 32) + chunk_of("data", std::string(441 * 4, '\0'))));
  EXPECT_DOUBLE_EQ(floating.seconds(), 0.01);
}

TEST_F(SoundFiles, OfMoreThanFourGibibytesSaySoElsewhere) {
  const std::string large = bytes_of(0, 8) + bytes_of(9600, 8) + bytes_of(4800, 8);
  const std::string chunks = chunk_of("ds64", large) + format_chunk(1, 1, 48000, 16) + "data" +
                             bytes_of(0xffffffff, 4) + std::string(9600, '\0');
  EXPECT_DOUBLE_EQ(read("RF64" + bytes_of(0xffffffff, 4) + "WAVE" + chunks).seconds(), 0.1);
}

TEST_F(SoundFiles, ThatAreCutShortOrPackedAreRefused) {
  const std::string format = format_chunk(1, 2, 48000, 24), data = chunk_of("data", "123456");
  EXPECT_NO_THROW(read(wave_of(format + data)));
  const std::string whole = wave_of(format + data);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(read(whole.substr(0, size)), InputError) << size << " bytes";
  EXPECT_THROW(read(wave_of(format_chunk(0x55, 2, 48000, 16) + data)), InputError) << "MP3";
  EXPECT_NO_THROW(read(wave_of(extensible_chunk(1) + data)));
  EXPECT_THROW(read(wave_of(extensible_chunk(0x55) + data)), InputError) << "MP3";
  EXPECT_THROW(read(wave_of(format_chunk(0xfffe, 2, 48000, 24) + data)), InputError);
  EXPECT_THROW(read(wave_of(format_chunk(1, 0, 48000, 16) + data)), InputError);
  EXPECT_THROW(read(wave_of(format_chunk(1, 2, 0, 16) + data)), InputError);
  EXPECT_THROW(read(wave_of(data)), InputError) << "no format";
  EXPECT_THROW(read("not a sound, whatever its name says"), InputError);
  EXPECT_THROW(read_sound_file(folder_ / "missing.wav"), InputError);
}

}  // namespace
}  // namespace domefall
