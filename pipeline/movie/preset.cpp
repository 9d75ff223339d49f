#include "pipeline/movie/preset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/image/errors.h"
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

constexpr int kAnySize = 16384;  // the largest frame of a show

std::vector<MoviePreset> make_presets() {
  // Level 6.2, the highest of x265 with limits, ends at 35.7 million pixels, about half of an 8k
  // dome.  Level 8.5 has no limits.
  constexpr const char* kBeyondLevels = ":level-idc=8.5";
  return {
      {"review",
       "H.264, 1080 pixels high at most, with numbers burnt in: to look at and to talk about",
       "mp4", 1920, 1080, 2, "yuv420p", false, true, false, h264(), aac()},
      {"dome", "HEVC Main 10, 4096 x 4096 at most: for the players of domes", "mp4", 4096, 4096, 2,
       "yuv420p10le", false, false, false, hevc(""), aac()},
      {"dome8k", "HEVC Main 10, 8192 x 8192 at most: beyond level 6.2, which many decoders refuse",
       "mp4", 8192, 8192, 2, "yuv420p10le", false, false, false, hevc(kBeyondLevels), aac()},
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
       uncompressed()},
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
       uncompressed()},
      {"vr360",
       "HEVC Main 10 of the whole sphere, 8192 x 4096 at most: for headsets, of equirectangular "
       "frames",
       "mkv", 8192, 4096, 2, "yuv420p10le", false, false, true, hevc(""), aac()}};
}

void append(std::vector<std::string>& all, std::vector<std::string> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
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
  return preset.whole_sphere ? "mp4" : preset.extension;
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
  return {scaled(frames.width), scaled(frames.height)};
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
  std::string filters = conversion(preset, tags, movie_size(preset, frames));
  // Times in the ASS format are hundredths of a second, which do not tell one frame from the next
  // at a high rate.  So the frames are a tenth of a second apart while they are written on.
  if (!subtitles.empty())
    filters += fmt::format(",settb=1/10,setpts=N,ass=filename={},settb={}/{},setpts=N", subtitles,
                           rate.seconds, rate.frames);
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

}  // namespace domefall
