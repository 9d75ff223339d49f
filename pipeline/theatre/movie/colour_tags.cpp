#include "pipeline/theatre/movie/colour_tags.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace domefall {
namespace {

int transfer_code(const DisplayColour& display) {
  if (display.curve == DisplayColour::Curve::kSrgb) return 13;
  if (display.curve == DisplayColour::Curve::kPq) return kH273Pq;
  if (display.curve == DisplayColour::Curve::kHlg) return kH273Hlg;
  // 1 is the camera's curve of BT.709, which stands for the display's of BT.1886.  ST 428-1 has the
  // power 2.6, but of X'Y'Z' and with another white.
  constexpr std::array<std::pair<double, int>, 3> kPowers{{{2.2, 4}, {2.4, 1}, {2.8, 5}}};
  constexpr double kNear = 0.01;
  for (const auto& [gamma, code] : kPowers)
    if (std::abs(display.gamma - gamma) <= kNear) return code;
  return 2;
}

const char* name_of_primaries(int code) {
  switch (code) {
    case 1:
      return "bt709";
    case 9:
      return "bt2020";
    case 11:
      return "smpte431 (DCI-P3)";
    case 12:
      return "smpte432 (P3-D65)";
    default:
      return "unspecified";
  }
}

const char* name_of_transfer(int code) {
  switch (code) {
    case 1:
      return "bt709 (BT.1886, gamma 2.4)";
    case 4:
      return "bt470m (gamma 2.2)";
    case 5:
      return "bt470bg (gamma 2.8)";
    case 13:
      return "iec61966-2-1 (sRGB)";
    case 14:
      return "bt2020-10 (BT.1886, gamma 2.4)";
    case kH273Pq:
      return "smpte2084 (PQ)";
    case kH273Hlg:
      return "arib-std-b67 (HLG)";
    default:
      return "unspecified";
  }
}

}  // namespace

ColourTags tags_of(const std::optional<DisplayColour>& display) {
  if (!display) return {};
  ColourTags tags{h273_primaries(display->xy), transfer_code(*display), 1};
  if (tags.primaries != 9) return tags;
  tags.matrix = 9;
  if (tags.transfer == 1) tags.transfer = 14;  // the same curve under BT.2020's own number
  return tags;
}

std::string describe(const ColourTags& tags) {
  return fmt::format("primaries {}, transfer {}, matrix {}", name_of_primaries(tags.primaries),
                     name_of_transfer(tags.transfer), tags.matrix == 9 ? "bt2020nc" : "bt709");
}

}  // namespace domefall
