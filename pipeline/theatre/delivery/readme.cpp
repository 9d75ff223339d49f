#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "pipeline/base/ratio.h"
#include "pipeline/theatre/delivery/delivery.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

std::string named_lines(const char* name, std::string_view text) {
  std::string lines = fmt::format("  {:<15}", name);
  for (const char c : text) lines += c == '\n' ? "\n" + std::string(17, ' ') : std::string(1, c);
  return lines + "\n";
}

std::string projection_text(const Projection& p) {
  const ProjectionTraits& traits = traits_of(p);
  const double degrees = field_of_view(p).value_or(0) * 180 / std::numbers::pi;
  std::string text = named_lines(
      "Projection", fmt::format(fmt::runtime(traits.description), short_number(degrees)));
  return traits.orientation.empty() ? text : text + named_lines("Orientation", traits.orientation);
}

std::string pictures_text(const Delivery& d) {
  std::string text = fmt::format(
      "PICTURES\n"
      "  frames/        {} frames, {} to {}\n"
      "                 {} frames a second: {:.3f} s\n"
      "                 {} x {} pixels, {} bits a colour ({} bits a pixel), RGB, no alpha, 2D\n",
      d.names.count(), d.names.path(0).filename().string(),
      d.names.path(d.names.count() - 1).filename().string(), rate_text(d.rate), duration_s(d),
      columns(d.projection), rows(d.projection), bits_of(d.format), 3 * bits_of(d.format));
  if (const double aspect = pixel_aspect(d.projection); aspect != 1)
    text += fmt::format("                 the width of a pixel is to its height as {}\n",
                        ratio_text(aspect));
  if (d.names.count() > kMostDeliveredInFolder)
    text += "                 10,000 frames to a folder, which is named after its first and last\n";
  text += projection_text(d.projection);
  return text;
}

std::string colour_text(const Delivery& d) {
  std::string text = fmt::format(
      "  Colour         made for the display '{}' (view '{}'), full range\n", d.display, d.view);
  if (!d.colour) return text;
  const auto& xy = d.colour->xy;
  const auto place = [&xy](std::size_t k) {
    return fmt::format("{} {}", short_number(xy[2 * k]), short_number(xy[2 * k + 1]));
  };
  if (d.colour->curve == DisplayColour::Curve::kSrgb)
    text += "  Transfer       sRGB (IEC 61966-2-1)\n";
  else if (d.colour->curve == DisplayColour::Curve::kPq)
    text += "  Transfer       PQ (SMPTE ST 2084)\n";
  else if (d.colour->curve == DisplayColour::Curve::kHlg)
    text += "  Transfer       HLG (ITU-R BT.2100), for 1000 cd/m^2\n";
  else
    text += fmt::format("  Transfer       a power of {} (gamma)\n", short_number(d.colour->gamma));
  text += fmt::format("  Primaries      CIE x y: red {}, green {}, blue {}, white {}\n", place(0),
                      place(1), place(2), place(3));
  return text;
}

// A WAV file may say which channel is which.  This is the order that programs write unless told
// otherwise.
std::string channels_text(int channels) {
  constexpr int kStereo = 2, kFiveAndOne = 6, kSevenAndOne = 8;
  const char* order = channels == kStereo        ? " (L R)"
                      : channels == kFiveAndOne  ? " (in the order of WAV: L R C LFE Ls Rs)"
                      : channels == kSevenAndOne ? " (in the order of WAV: L R C LFE Lb Rb Ls Rs)"
                                                 : "";
  return fmt::format("{} channels{}, ", channels, order);
}

std::string sound_text(const Delivery& d) {
  if (d.sounds.empty()) return "SOUND\n  none\n";
  std::string text = "SOUND\n";
  double shortest = duration_s(d);
  for (const auto& [path, sound, cut] : d.sounds) {
    const std::string channel = channel_of_name(path);
    shortest = std::min(shortest, sound.seconds());
    text +=
        fmt::format("  {}\n                 {}{} Hz, {}, {:.3f} s\n", path,
                    sound.channels > 1 ? channels_text(sound.channels)
                    : channel.empty()  ? std::string("1 channel, ")
                                       : "channel " + channel + ", ",
                    sound.rate, sound.bits > 0 ? fmt::format("{} bits", sound.bits) : sound.format,
                    sound.seconds());
  }
  const double frame = duration_s(d) / d.names.count();
  return text + (shortest < duration_s(d) - frame
                     ? "  It begins with the first frame and ends before the last one: the rest is "
                       "silent.\n"
                     : "  It begins with the first frame and lasts as long as the frames do.\n");
}

}  // namespace

std::string readme_text(const Delivery& d) {
  std::string text =
      fmt::format("{}\n\n{}{}\n{}", d.title, pictures_text(d), colour_text(d), sound_text(d));
  if (!d.subtitles.empty()) text += "\nSUBTITLES\n";
  for (const auto& [path, subtitles] : d.subtitles)
    text += fmt::format("  {}\n                 {} of them, to {:.3f} s after the first frame\n",
                        path, subtitles.count, subtitles.end_s);
  text += fmt::format(
      "\nBESIDES\n"
      "  {}\n                 shows how the picture is turned, its geometry, greys and colours;\n"
      "                 not a part of the show\n",
      d.alignment);
  if (d.leader_frames > 0)
    text += fmt::format(
        "  leader/        {} frames of slate and countdown, numbered by themselves. They run\n"
        "                 straight into frame 1; sound and subtitles begin after them.\n",
        d.leader_frames);
  text +=
      "  contact_sheet.png, preview.png\n"
      "                 to look at; not a part of the show\n"
      "  metadata.json  all of the above for programs\n"
      "\nIS IT WHOLE?\n"
      "  sh verify.sh   needs sha256sum or shasum. It says which files are missing, changed or\n"
      "                 not of this delivery. By hand: sha256sum -c checksums.sha256\n"
      "\nMade with " +
      d.software + " from " + d.show_file + ".\n";
  return text;
}

}  // namespace domefall
