#include "pipeline/theatre/sound/sound.h"

#include <gmock/gmock.h>

#include <string>

#include "pipeline/base/regular_file.h"
#include "pipeline/theatre/sound/sound_file.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// ---- one file ----

std::string bytes_of(std::uint64_t number, int count) {
  std::string bytes;
  for (int k = 0; k < count; ++k, number >>= 8) bytes += static_cast<char>(number & 0xff);
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

// WAVE_FORMAT_EXTENSIBLE has the tag in a GUID behind its own size, the valid bits and the
// speakers.
std::string extensible_chunk(unsigned tag) {
  return format_chunk(0xfffe, 2, 48000, 24,
                      bytes_of(22, 2) + bytes_of(24, 2) + bytes_of(3, 4) + bytes_of(tag, 2) +
                          std::string("\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71", 14));
}

std::string wave_of(const std::string& chunks) {
  return "RIFF" + bytes_of(chunks.size() + 4, 4) + "WAVE" + chunks;
}

class SoundFiles : public TestFolder {
 protected:
  SoundFile read(const std::string& bytes) const {
    put(folder_ / "a.wav", bytes);
    return read_sound_file(folder_ / "a.wav");
  }
  std::string refusal(const std::string& bytes) const {
    return message_of([&] { read(bytes); });
  }
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

TEST_F(SoundFiles, ThatWereWrittenIntoAPipeLastToTheEnd) {
  const std::string format = format_chunk(1, 1, 48000, 16), samples(9600, '\1');
  for (const std::uint64_t size : {0U, 0xffffffffU, 0xffffffdbU, 0x7ffff000U, 0x80000000U}) {
    const SoundFile sound = read(wave_of(format + "data" + bytes_of(size, 4) + samples));
    EXPECT_DOUBLE_EQ(sound.seconds(), 0.1) << size;
    EXPECT_TRUE(sound.wave->unfilled) << size;
  }
  const std::string sizes = bytes_of(0, 24) + bytes_of(0, 4);
  for (const char* kind : {"RF64", "BW64"})
    EXPECT_DOUBLE_EQ(read(kind + bytes_of(0xffffffff, 4) + "WAVE" + chunk_of("ds64", sizes) +
                          format + "data" + bytes_of(0xffffffff, 4) + samples)
                         .seconds(),
                     0.1);
  EXPECT_THAT(refusal(wave_of(format + "data" + bytes_of(0, 4))), HasSubstr("is no sound in it"));
}

TEST_F(SoundFiles, HaveWholeNumbersOf8To32BitsOrFloatingPointNumbers) {
  const auto of = [&](unsigned tag, unsigned bits) {
    return wave_of(format_chunk(tag, 2, 48000, bits) + chunk_of("data", std::string(160, '\0')));
  };
  for (const unsigned bits : {8U, 16U, 20U, 24U, 32U}) EXPECT_NO_THROW(read(of(1, bits))) << bits;
  for (const unsigned bits : {32U, 64U}) EXPECT_NO_THROW(read(of(3, bits))) << bits;
  for (const unsigned bits : {0U, 1U, 36U, 40U, 64U})
    EXPECT_THAT(refusal(of(1, bits)),
                HasSubstr("its samples are whole numbers of " + std::to_string(bits) + " bits"));
  for (const unsigned bits : {16U, 24U, 80U}) EXPECT_THROW(read(of(3, bits)), InputError) << bits;
}

TEST_F(SoundFiles, WhoseHeadsMakeNoSenseAreRefused) {
  const std::string data = chunk_of("data", std::string(64, '\0'));
  for (const unsigned rate : {0U, 11U, 4'000'000'000U})
    EXPECT_THROW(read(wave_of(format_chunk(1, 1, rate, 16) + data)), InputError) << rate;
  std::string long_one = wave_of(format_chunk(1, 1, 48000, 16) + data);
  long_one.replace(0, 4, "RF64");
  EXPECT_THROW(read(long_one), InputError);
}

TEST_F(SoundFiles, HaveAtMost16Channels) {
  const std::string data = chunk_of("data", std::string(340, '\0'));
  EXPECT_EQ(read(wave_of(format_chunk(1, 16, 48000, 16) + data)).channels, 16);
  EXPECT_THAT(refusal(wave_of(format_chunk(1, 17, 48000, 16) + data)),
              HasSubstr("it has 17 channels; 16 are the most"));
}

// A copy is what any other reader takes for a whole file of that length.
TEST_F(SoundFiles, AreCutWithAHeadThatSaysSo) {
  const std::string before = chunk_of("bext", "odd") + format_chunk(1, 1, 48000, 24);
  const std::string sizes = bytes_of(0, 16) + bytes_of(0, 8) + bytes_of(0, 4);
  const std::string large = "RF64" + bytes_of(0xffffffff, 4) + "WAVE" + chunk_of("ds64", sizes);
  const std::string sound = "123456789abc";
  for (const std::string& start : {wave_of(before), large + before}) {
    const bool long_sizes = start[1] == 'F';
    SoundFile file = read(start + "data" + bytes_of(long_sizes ? 0xffffffff : 0, 4) + sound);
    EXPECT_EQ(file.frames, 4U);
    file.frames = 3;
    copy_wave(file, folder_ / "cut.wav");
    const SoundFile cut = read_sound_file(folder_ / "cut.wav");
    EXPECT_EQ(cut.frames, 3U);
    EXPECT_FALSE(cut.wave->unfilled);
    const std::string bytes = read_file(folder_ / "cut.wav", 1000);
    EXPECT_EQ(bytes.substr(bytes.size() - 10), std::string("123456789") + '\0') << "an even size";
    const std::size_t riff_at = long_sizes ? 20 : 4;
    EXPECT_EQ(bytes.substr(riff_at, 4), bytes_of(bytes.size() - 8, 4));
  }
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
  constexpr std::size_t kHead = 12;
  for (std::size_t size = kHead; size < whole.size(); ++size)
    EXPECT_THROW(read(whole.substr(0, size)), InputError) << size << " bytes";
  EXPECT_THROW(read(wave_of(format_chunk(0x55, 2, 48000, 16) + data)), InputError) << "no MP3";
  EXPECT_NO_THROW(read(wave_of(extensible_chunk(1) + data)));
  EXPECT_THROW(read(wave_of(format_chunk(0xfffe, 2, 48000, 24) + data)), InputError);
  EXPECT_THROW(read(wave_of(format_chunk(1, 0, 48000, 16) + data)), InputError);
  EXPECT_THROW(read(wave_of(format_chunk(1, 2, 0, 16) + data)), InputError);
  EXPECT_THROW(read(wave_of(data)), InputError) << "no format";
  EXPECT_THROW(read("not a sound, whatever its name says"), InputError);
  EXPECT_THROW(read_sound_file(folder_ / "missing.wav"), InputError);
}

// ---- the sound of a show ----

class ShowSounds : public TestFolder {
 protected:
  // Writes silence of 16 bits and so many samples.
  std::filesystem::path write(const std::string& name, int samples, int rate = 48000,
                              int channels = 1) const {
    const auto bytes = static_cast<std::size_t>(2 * channels * samples);
    put(folder_ / name,
        wave_of(format_chunk(1, static_cast<unsigned>(channels), static_cast<unsigned>(rate), 16) +
                chunk_of("data", std::string(bytes, '\0'))));
    return folder_ / name;
  }
  std::vector<std::string> names_of(const Sound& sound) const {
    std::vector<std::string> names;
    for (const SoundFile& file : sound.files) names.push_back(file.file.filename().string());
    return names;
  }
  Sound read(const std::vector<std::string>& names) const {
    std::vector<std::filesystem::path> files;
    for (const std::string& name : names) files.push_back(write(name, 100));
    return read_sound(files);
  }
  std::string refusal(const std::vector<std::string>& names) const {
    return message_of([&] { read(names); });
  }
};

TEST_F(ShowSounds, AreSortedByTheirChannelsInAnyCase) {
  const Sound sound = read({"a_rs.wav", "a_Lfe.wav", "a.L.wav", "a-c.wav", "a LS.wav", "a_R.WAV"});
  EXPECT_THAT(names_of(sound),
              ElementsAre("a.L.wav", "a_R.WAV", "a-c.wav", "a_Lfe.wav", "a LS.wav", "a_rs.wav"));
  EXPECT_EQ(sound.layout, "FL+FR+FC+LFE+BL+BR") << "ffmpeg's 5.1";
  EXPECT_EQ(sound.channels, 6);
  EXPECT_EQ(read({"a_L.wav", "a_R.wav"}).layout, "FL+FR");
  EXPECT_EQ(read({"a_L.wav", "a_R.wav", "a_C.wav", "a_LFE.wav", "a_Lss.wav", "a_Rss.wav",
                  "a_Lrs.wav", "a_rrs.wav"})
                .layout,
            "FL+FR+FC+LFE+BL+BR+SL+SR")
      << "7.1";
}

TEST_F(ShowSounds, OfManyChannelsAreNumbered) {
  std::vector<std::string> names;
  for (int k = 16; k >= 1; --k) names.push_back("dome_" + std::to_string(k) + ".wav");
  const Sound sound = read(names);
  EXPECT_EQ(sound.channels, 16);
  EXPECT_EQ(sound.layout, "");
  EXPECT_EQ(names_of(sound).front(), "dome_1.wav");
  EXPECT_EQ(names_of(sound).back(), "dome_16.wav");
  EXPECT_THAT(names_of(read({"x 02.wav", "x 01.wav", "x 03.wav"})),
              ElementsAre("x 01.wav", "x 02.wav", "x 03.wav"));
  names.emplace_back("dome_17.wav");
  EXPECT_THAT(refusal(names), HasSubstr("17 files"));
}

TEST_F(ShowSounds, WhoseChannelsAreNotClearAreRefused) {
  EXPECT_THAT(refusal({"a_L.wav", "mix.wav"}), HasSubstr("mix.wav does not"));
  EXPECT_THAT(refusal({"a_L.wav", "b_l.wav"}), HasSubstr("more than one file is the channel l"));
  EXPECT_THAT(refusal({"a_1.wav", "a_3.wav"}), HasSubstr("none ends in 2"));
  EXPECT_THAT(refusal({"a_1.wav", "a_L.wav"}), HasSubstr("a_L.wav does not"));
  const auto left = write("w_L.wav", 100), wide = write("w_R.wav", 100, 48000, 2);
  EXPECT_THAT(message_of([&] {
                read_sound({left, wide});
              }),
              HasSubstr("w_R.wav: one of several files has one channel, and this one 2"));
  EXPECT_THAT(message_of([&] {
                read_sound({left, write("s_R.wav", 100, 44100)});
              }),
              HasSubstr("the sound has 44100 Hz and 16 bits"));
}

// 60 frames a second, so that a frame has 800 samples, and a show of 6 frames.
TEST_F(ShowSounds, MayBeLongerByOneFrame) {
  const FrameRate rate{60, 1};
  const auto checked = [&](int samples) {
    return check_length(read_sound({write("a.wav", samples)}), 6, rate);
  };
  EXPECT_THAT(checked(4800), IsEmpty());
  EXPECT_THAT(checked(4001), IsEmpty()) << "shorter by less than a frame";
  EXPECT_THAT(checked(5360), ElementsAre(HasSubstr("beyond the last frame is left out")));
  EXPECT_THAT(checked(5600), ElementsAre(HasSubstr("beyond the last frame is left out")));
  EXPECT_THAT(checked(3000), ElementsAre(HasSubstr("the rest is silent")));
  EXPECT_THROW(checked(5602), InputError);
  EXPECT_EQ(samples_within(read_sound({write("a.wav", 5360)}).files[0], 6, rate), 4800U);
  EXPECT_EQ(samples_within(read_sound({write("a.wav", 100)}).files[0], 6, rate), 100U);
}

TEST_F(ShowSounds, NameTheirChannelInAnyCase) {
  EXPECT_EQ(channel_of_name("audio/x_LFE.wav"), "LFE");
  EXPECT_EQ(channel_of_name("audio/x_lfe.wav"), "LFE");
  EXPECT_EQ(channel_of_name("audio/x.Rs.wav"), "Rs");
  EXPECT_EQ(channel_of_name("audio/mix.wav"), "");
  EXPECT_EQ(channel_of_name("audio/mix_.wav"), "");
}

}  // namespace
}  // namespace domefall
