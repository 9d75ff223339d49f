#include "pipeline/theatre/delivery/delivery.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "pipeline/base/ratio.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

const char* kind_word(const GradedFormat& format) {
  switch (format.kind) {
    case GradedKind::kPng16:
    case GradedKind::kPng8:
      return "PNG";
    case GradedKind::kTiff16:
    case GradedKind::kTiff8:
      return "TIFF";
    case GradedKind::kJpeg:
      break;
  }
  return "JPEG";
}

std::string transfer_of(const DisplayColour& colour) {
  switch (colour.curve) {
    case DisplayColour::Curve::kSrgb:
      return "sRGB (IEC 61966-2-1)";
    case DisplayColour::Curve::kPq:
      return "PQ (SMPTE ST 2084)";
    case DisplayColour::Curve::kHlg:
      return "HLG (ITU-R BT.2100)";
    case DisplayColour::Curve::kPower:
      break;
  }
  return fmt::format("power {}", short_number(colour.gamma));
}

Json colour_json(const Delivery& d) {
  Json colour = {{"display", d.display}, {"view", d.view}, {"transfer", nullptr}};
  if (d.colour) {
    colour["transfer"] = transfer_of(*d.colour);
    constexpr std::array kNames{"red", "green", "blue", "white"};
    for (std::size_t k = 0; k < kNames.size(); ++k)
      colour["xy"][kNames[k]] = {d.colour->xy[2 * k], d.colour->xy[2 * k + 1]};
  }
  colour["range"] = "full";
  return colour;
}

Json sounds_json(const Delivery& d) {
  Json sounds = Json::array();
  for (const auto& [path, sound, cut] : d.sounds) {
    Json entry = {{"file", path},
                  {"format", sound.format},
                  {"channels", sound.channels},
                  {"channel", nullptr},
                  {"sample_rate", sound.rate},
                  {"bits", sound.bits > 0 ? Json(sound.bits) : Json()},
                  {"duration_s", sound.seconds()}};
    if (sound.channels == 1 && !channel_of_name(path).empty())
      entry["channel"] = channel_of_name(path);
    sounds.push_back(entry);
  }
  return sounds;
}

}  // namespace

int bits_of(const GradedFormat& format) {
  constexpr int kFine = 16, kCoarse = 8;
  return format.kind == GradedKind::kPng16 || format.kind == GradedKind::kTiff16 ? kFine : kCoarse;
}

double duration_s(const Delivery& delivery) {
  return duration_of(delivery.names.count(), delivery.rate);
}

ShowLines show_lines(const Delivery& d) {
  const double aspect = pixel_aspect(d.projection);
  return {
      d.title,
      fmt::format("{} x {}{}, {}", columns(d.projection), rows(d.projection),
                  aspect == 1 ? "" : " pixels of " + ratio_text(aspect),
                  projection_name(d.projection)),
      fmt::format("{} frames a second", rate_text(d.rate)),
      fmt::format("{} frames, {:.3f} s", d.names.count(), duration_s(d)),
      fmt::format("{}, {} bits a colour, {}", kind_word(d.format), bits_of(d.format), d.display)};
}

std::string metadata_text(const Delivery& d) {
  Json subtitles = Json::array();
  for (const auto& [path, text] : d.subtitles)
    subtitles.push_back({{"file", path}, {"count", text.count}, {"end_s", text.end_s}});
  Json leader;
  if (d.leader_frames > 0)
    leader = {{"folder", "leader"},
              {"frames", d.leader_frames},
              {"slate_s", kSlateSeconds},
              {"countdown_s", kCountdownSeconds}};
  Json all = {
      {"title", d.title},
      {"files", d.files},
      {"frames", d.names.count()},
      {"frame_rate", {{"numerator", d.rate.frames}, {"denominator", d.rate.seconds}}},
      {"duration_s", duration_s(d)},
      {"width", columns(d.projection)},
      {"height", rows(d.projection)},
      {"pixel_aspect", pixel_aspect(d.projection)},
      {"projection", projection_name(d.projection)},
      {"front", traits_of(d.projection).is_dome ? Json("bottom") : Json()},
      {"dimensions", "2D"},
      {"image",
       {{"kind", kind_word(d.format)},
        {"bits_per_colour", bits_of(d.format)},
        {"channels", "RGB"},
        {"alpha", false}}},
      {"names",
       {{"pattern", pattern_text(d.names.pattern())},
        {"extension", d.names.extension()},
        {"first", 1},
        {"last", d.names.count()},
        {"most_in_folder", kMostDeliveredInFolder}}},
      {"colour", colour_json(d)},
      {"audio", sounds_json(d)},
      {"subtitles", subtitles},
      {"leader", leader},
      {"alignment", d.alignment},
      {"show", {{"file", d.show_file}, {"sha256", d.show_sha256}, {"digest", d.show_digest}}},
      {"software", d.software}};
  if (d.format.kind == GradedKind::kJpeg) all["image"]["quality"] = d.format.quality;
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace domefall
