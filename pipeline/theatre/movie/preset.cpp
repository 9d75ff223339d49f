#include "pipeline/theatre/movie/preset.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/errors.h"
#include "pipeline/base/ratio.h"
#include "pipeline/show/nearest_word.h"

namespace domefall {
namespace {

// These are options of x264 and x265.  aq-mode 3 spends bits on what is dark, where a sky's
// gradients are.
std::vector<std::string> h264() { return {"-c:v", "libx264", "-crf", "18", "-aq-mode", "3"}; }

std::vector<std::string> hevc(const char* more) {
  return {"-c:v",         "libx265",
          "-crf",         "16",
          "-profile:v",   "main10",
          "-tag:v",       "hvc1",
          "-x265-params", fmt::format("log-level=error:aq-mode=3{}", more)};
}

std::vector<std::string> aac() {
  return {"-c:a", "aac", "-ar", "48000", "-aac_coder", "twoloop", "-b:a", "512k"};
}

std::vector<std::string> uncompressed() { return {"-c:a", "pcm_s24le", "-ar", "48000"}; }

// The standard has an order for as many, 7.1.  What more ffmpeg encodes, players guess at.
constexpr int kMostAac = 8;

// Bits a pixel, measured with black frames of 1024 x 1024 pixels.  Frames with a thousandth of
// their pixels lit take 50 times as many of H.264 and HEVC, and 7 times as many of ProRes.
constexpr double kLeastPredicted = 0.001, kLeastProRes = 0.08, kLeastHap = 0.3;

constexpr int kAnySize = 16384;  // the largest frame of a show

std::vector<MoviePreset> make_presets() {
  // Level 6.2, the highest of x265 with limits, ends at 35.7 million pixels, about half of an 8k
  // dome.  Level 8.5 has no limits.
  constexpr const char* kBeyondLevels = ":level-idc=8.5";
  return {
      {"review",
       "H.264, 1080 pixels high at most, with numbers burnt in: to look at and to talk about",
       "mp4", 1920, 1080, 2, "yuv420p", false, true, false, h264(), aac(), kLeastPredicted,
       kMostAac},
      {"dome", "HEVC Main 10, 4096 x 4096 at most: for the players of domes", "mp4", 4096, 4096, 2,
       "yuv420p10le", false, false, false, hevc(""), aac(), kLeastPredicted, kMostAac},
      {"dome8k", "HEVC Main 10, 8192 x 8192 at most: beyond level 6.2, which many decoders refuse",
       "mp4", 8192, 8192, 2, "yuv420p10le", false, false, false, hevc(kBeyondLevels), aac(),
       kLeastPredicted, kMostAac},
      {"master",
       "ProRes 4444: to edit and to keep",
       "mov",
       kAnySize,
       kAnySize,
       1,
       "yuv444p10le",
       false,
       false,
       false,
       {"-c:v", "prores_ks", "-profile:v", "4444", "-vendor", "apl0"},
       uncompressed(),
       kLeastProRes},
      {"hap",
       "Hap Q in 4 chunks: for media servers that decode on the graphics card",
       "mov",
       kAnySize,
       kAnySize,
       4,
       "rgba",
       true,
       false,
       false,
       {"-c:v", "hap", "-format", "hap_q", "-chunks", "4"},
       uncompressed(),
       kLeastHap},
      {"vr360",
       "HEVC Main 10 of the whole sphere, 8192 x 4096 at most: for headsets, of equirectangular "
       "frames",
       "mkv", 8192, 4096, 2, "yuv420p10le", false, false, true, hevc(""), aac(), kLeastPredicted,
       kMostAac}};
}

// These are the values that a player uses to turn codes into light.  Matrix 0 is RGB itself.
struct VideoTags {
  const char* range;
  int matrix;
};

VideoTags video_tags(const MoviePreset& preset, const ColourTags& tags) {
  return preset.rgb ? VideoTags{"pc", 0} : VideoTags{"tv", tags.matrix};
}

std::string conversion(const MoviePreset& preset, const ColourTags& tags, const MovieSize& size) {
  // zimg rounds 16 bits to 8 or 10 with an ordered dither, so that dark gradients show no contours.
  const std::string scale =
      fmt::format("zscale=w={}:h={}:f=spline36:dither=ordered", size.width, size.height);
  if (preset.rgb) return scale + ",format=gbrp,format=" + std::string(preset.pixels);
  return fmt::format("{}:m={}:r=limited,format={}", scale, tags.matrix == 9 ? "2020_ncl" : "709",
                     preset.pixels);
}

// Returns the option of ffmpeg's filter ass for pixels that are not square: the size that the movie
// has on a screen.
std::string width_of_letters(const MovieSize& movie) {
  if (movie.pixel_aspect == 1) return {};
  return fmt::format(":original_size={}x{}", movie.width,
                     std::lround(movie.height / movie.pixel_aspect));
}

// Returns the map of ffmpeg's filter join that makes file k the channel k of a layout, such as
// 0.0-FL|1.0-FR.
std::string join_map(std::string_view layout) {
  std::string map;
  for (int k = 0; !layout.empty(); ++k) {
    const std::string_view name = layout.substr(0, layout.find('+'));
    map += fmt::format("{}{}.0-{}", k == 0 ? "" : "|", k, name);
    layout.remove_prefix(std::min(layout.size(), name.size() + 1));
  }
  return map;
}

}  // namespace

const std::vector<MoviePreset>& movie_presets() {
  static const std::vector<MoviePreset> presets = make_presets();
  return presets;
}

const MoviePreset& movie_preset(const std::string& name) {
  std::vector<std::string_view> names;
  for (const MoviePreset& preset : movie_presets()) {
    if (preset.name == name) return preset;
    names.push_back(preset.name);
  }
  const std::string near = did_you_mean(name, names);
  throw InputError("--preset " + name + ": there is no such preset" +
                   (near.empty() ? "; there are " + listed(names) : near));
}

std::string_view format_of(const MoviePreset& preset) {
  return preset.whole_sphere ? "matroska" : preset.extension;
}

void require_fitting(const MoviePreset& preset, const FrameRate& rate, const Sound& sound) {
  constexpr std::int64_t kMost = 1'001'000;  // ffmpeg rounds a fraction of larger numbers
  if (std::max(rate.frames, rate.seconds) > kMost)
    throw InputError(fmt::format(
        "frames_per_second: {} is a rate that video cannot count in; a fraction of smaller "
        "numbers, such as 24000/1001, is",
        text_of(rate)));
  if (sound.channels > preset.most_channels)
    throw InputError(
        fmt::format("{}: {} channels, and the sound of the preset {} has at most {}; the presets "
                    "master and hap take up to {}",
                    sound.files.front().file.string(), sound.channels, preset.name,
                    preset.most_channels, kMostSoundChannels));
}

double least_bytes(const MoviePreset& preset, const MovieSize& movie, int frames,
                   const FrameRate& rate, int channels) {
  constexpr double kBits = 8, kSampleBytes = 3, kSoundRate = 48000;
  const double video = preset.least_bits / kBits * movie.width * movie.height * frames;
  const bool packed = preset.most_channels < kMostSoundChannels;
  const double sound =
      packed ? 0 : kSampleBytes * kSoundRate * channels * duration_of(frames, rate);
  const int copies = preset.whole_sphere ? 2 : 1;  // one by ffmpeg, and one by mkvmerge
  return copies * (video + sound);
}

MovieSize movie_size(const MoviePreset& preset, const MovieSize& frames) {
  const auto fits = [&](int side) { return side % preset.multiple == 0; };
  if (frames.width <= preset.most_width && frames.height <= preset.most_height) {
    if (fits(frames.width) && fits(frames.height)) return frames;
    throw InputError(fmt::format(
        "--size: the preset {} takes widths and heights that are multiples of {}, and the frames "
        "have {} x {} pixels",
        preset.name, preset.multiple, frames.width, frames.height));
  }
  const double factor = std::min(double(preset.most_width) / frames.width,
                                 double(preset.most_height) / frames.height);
  const auto scaled = [&](int side) {
    const auto steps = static_cast<int>(std::lround(side * factor / preset.multiple));
    return std::max(1, steps) * preset.multiple;
  };
  return {scaled(frames.width), scaled(frames.height), frames.pixel_aspect};
}

std::vector<std::string> input_options(const MovieSize& frames, const FrameRate& rate) {
  return {"-f",         "rawvideo",    "-pixel_format",
          "rgb48le",    "-video_size", fmt::format("{}x{}", frames.width, frames.height),
          "-framerate", text_of(rate), "-i",
          "pipe:0"};
}

std::vector<std::string> video_options(const MoviePreset& preset, const MovieSize& frames,
                                       const FrameRate& rate, const ColourTags& tags,
                                       const std::string& subtitles) {
  const VideoTags video = video_tags(preset, tags);
  const MovieSize movie = movie_size(preset, frames);
  std::string filters = conversion(preset, tags, movie);
  // Times in the ASS format are hundredths of a second, which do not tell one frame from the next
  // at a high rate.  So the frames are a tenth of a second apart while they are written on.
  if (!subtitles.empty())
    filters += fmt::format(",settb=1/10,setpts=N,ass=filename={}{},settb={}/{},setpts=N", subtitles,
                           width_of_letters(movie), rate.seconds, rate.frames);
  // A player takes pixels to be square that no movie says anything of.
  if (const Ratio aspect = ratio_of(frames.pixel_aspect); frames.pixel_aspect != 1)
    filters += fmt::format(",setsar={}/{}", aspect.over, aspect.under);
  filters += fmt::format(",setparams=range={}:color_primaries={}:color_trc={}:colorspace={}",
                         video.range, tags.primaries, tags.transfer, video.matrix);
  std::vector<std::string> options{"-vf", filters};
  append(options, preset.video);
  // Without -r ffmpeg takes 119.88 for 120.
  append(options, {"-r", text_of(rate), "-color_range", video.range, "-color_primaries",
                   fmt::to_string(tags.primaries), "-color_trc", fmt::to_string(tags.transfer),
                   "-colorspace", fmt::to_string(video.matrix)});
  return options;
}

namespace {

void add_to_x265(std::vector<std::string>& options, const std::string& text) {
  const auto name = std::ranges::find(options, "-x265-params");
  if (name != options.end()) *(name + 1) += text;
}

}  // namespace

bool takes_light_levels(const MoviePreset& preset, const ColourTags& tags) {
  return tags.transfer == kH273Pq &&
         std::ranges::find(preset.video, "-x265-params") != preset.video.end();
}

// Both are rounded up, so that no pixel and no frame is brighter than the movie says.
void add_light_levels(std::vector<std::string>& options, const LightLevels& levels) {
  add_to_x265(options, fmt::format(":max-cll={:.0f},{:.0f}", std::ceil(levels.content),
                                   std::ceil(levels.frame_average)));
}

// The first is a message of supplemental enhancement information (ITU-T H.265, D.2.35) in a unit of its
// own: the unit's head, the message's kind and size, the levels, and the unit's end.  No two bytes in
// succession may be 0, or a third would have to stand behind them.  So levels of 0 count as 1, and in
// one of 65,000 cases MaxCLL is 1 more.
std::array<std::string, 2> in_hevc(const LightLevels& levels) {
  const auto whole = [](double level) {
    return static_cast<unsigned>(std::clamp(std::ceil(level), 1.0, 65535.0));
  };
  constexpr unsigned kByte = 256;
  unsigned content = whole(levels.content);
  const unsigned average = whole(levels.frame_average);
  if (content % kByte == 0 && average < kByte) ++content;
  std::string unit = "\x4e\x01\x90\x04";
  for (const unsigned byte : {content / kByte, content % kByte, average / kByte, average % kByte})
    unit += static_cast<char>(byte);
  return {unit + '\x80', fmt::format("cll={:05},{:05}", content, average)};
}

// Places count in 1/50000 and light in 1/10000 cd/m^2.
void add_mastering_display(std::vector<std::string>& options, const MasteringDisplay& display) {
  constexpr double kPlaces = 50000, kLight = 10000;
  constexpr std::array<std::pair<const char*, std::size_t>, 4> kPlacesOf{
      {{"G", 2}, {"B", 4}, {"R", 0}, {"WP", 6}}};
  std::string text = ":master-display=";
  for (const auto& [name, first] : kPlacesOf) {
    text += fmt::format("{}({:.0f},{:.0f})", name, kPlaces * display.xy[first],
                        kPlaces * display.xy[first + 1]);
  }
  add_to_x265(options, text + fmt::format("L({:.0f},1)", kLight * display.peak));
}

std::vector<std::string> sound_inputs(const Sound& sound) {
  std::vector<std::string> options;
  for (const SoundFile& file : sound.files) {
    if (file.wave) {
      // ffmpeg goes by the valid bits of WAVE_FORMAT_EXTENSIBLE, and would take 24 in 32 for 24.
      const std::string whole =
          file.bits <= 8 ? "pcm_u8" : fmt::format("pcm_s{}le", (file.bits + 7) / 8 * 8);
      append(options, {"-f", "wav", "-c:a",
                       file.wave->is_float ? fmt::format("pcm_f{}le", file.bits) : whole});
    }
    if (file.wave && file.wave->unfilled) append(options, {"-ignore_length", "1"});
    append(options, ffmpeg_input(file.file));
  }
  return options;
}

// All are padded with endless silence, joined, and then cut to the length of the frames.
std::string sound_filter(const Sound& sound, std::size_t input, int first, int count,
                         const FrameRate& rate) {
  std::string filter, labels;
  for (std::size_t k = 0; k < sound.files.size(); ++k) {
    // Samples are counted, as read_sound_file() does, whatever times the file gives them.
    filter += fmt::format("[{}:a:0]asetpts=N/SR/TB,apad[c{}];", input + k, k);
    labels += fmt::format("[c{}]", k);
  }
  const std::size_t files = sound.files.size();
  if (files == 1)
    filter += labels + "anull";
  else if (sound.layout.empty())
    filter += labels + fmt::format("amerge=inputs={}", files);
  else
    filter += labels + fmt::format("join=inputs={}:channel_layout={}:map={}", files, sound.layout,
                                   join_map(sound.layout));
  return filter + fmt::format(",atrim=start={:.9f}:end={:.9f},asetpts=PTS-STARTPTS[sound]",
                              duration_of(first, rate), duration_of(first + count, rate));
}

std::vector<std::string> sound_options(const Sound& sound, int first, int count,
                                       const FrameRate& rate) {
  if (sound.files.empty()) return {"-map", "0:v"};
  return {"-filter_complex", sound_filter(sound, 1, first, count, rate), "-map", "0:v", "-map",
          "[sound]"};
}

}  // namespace domefall
