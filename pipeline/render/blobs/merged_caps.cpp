#include "pipeline/render/blobs/merged_caps.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace domefall {
namespace {

constexpr std::size_t kCrowd = 16;  // the fewest caps of a crowd
constexpr double kSide = 0.25;      // the side of a crowd's square, in sigmas

// A Member is a cap with the number of the square in which it lies.
struct Member {
  std::uint64_t square;
  std::uint32_t blob;
};

// Returns the number of a cap's square.  The number contains the width, so caps of different widths
// never share a square.
std::uint64_t square_of(const CapBlob& b, double pixels_per_radian, double least_side) {
  const double side = std::max(kSide * b.sigma * pixels_per_radian, least_side);
  const auto place = [side](double at) {
    return static_cast<std::uint64_t>(std::clamp(at / side + 1024, 0.0, 65535.0));
  };
  return (std::uint64_t{std::bit_cast<std::uint32_t>(b.sigma)} << 32) | place(b.x) << 16 |
         place(b.y);
}

// Merges a crowd into its first cap and marks the others by an empty range of rows.  The merged cap
// is brighter and therefore reaches farther.  If it cannot be placed, as happens at the end of a
// very wide flat image, the crowd stays as it is.
void merge(const Projection& projection, const Member* first, const Member* end,
           std::vector<CapBlob>& blobs) {
  double x = 0, y = 0, light = 0, rgb[3] = {0, 0, 0};
  for (const Member* member = first; member != end; ++member) {
    const CapBlob& b = blobs[member->blob];
    const double weight = std::max({b.rgb[0], b.rgb[1], b.rgb[2]});
    x += weight * b.x;
    y += weight * b.y;
    light += weight;
    for (int c = 0; c < 3; ++c) rgb[c] += b.rgb[c];
  }
  CapBlob one = blobs[first->blob];
  one.x = static_cast<float>(x / light);
  one.y = static_cast<float>(y / light);
  for (int c = 0; c < 3; ++c) one.rgb[c] = static_cast<float>(rgb[c]);
  if (!place_cap(projection, one)) return;
  for (const Member* member = first; member != end; ++member)
    blobs[member->blob].last_row = blobs[member->blob].first_row - 1;
  blobs[first->blob] = one;
}

}  // namespace

void merge_crowds(const Projection& projection, std::vector<CapBlob>& blobs) {
  if (blobs.size() < kCrowd) return;
  const double pixels_per_radian = 1 / largest_pixel_angle(projection);
  // The sides are at least half a pixel, so 16 bits suffice for 32,000 pixels, nearly twice the
  // largest frame.  Frames whose pixels are drawn in parts may have twice as many.
  const double least_side = std::max(0.5, std::max(columns(projection), rows(projection)) / 64000.);
  std::vector<Member> members(blobs.size());
  for (std::size_t k = 0; k < blobs.size(); ++k)
    members[k] = {square_of(blobs[k], pixels_per_radian, least_side),
                  static_cast<std::uint32_t>(k)};
  std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
    return std::pair(a.square, a.blob) < std::pair(b.square, b.blob);
  });
  for (auto first = members.begin(); first != members.end();) {
    const auto end = std::find_if(first, members.end(), [square = first->square](const Member& c) {
      return c.square != square;
    });
    if (static_cast<std::size_t>(end - first) >= kCrowd)
      merge(projection, &*first, &*first + (end - first), blobs);
    first = end;
  }
  std::erase_if(blobs, [](const CapBlob& b) { return b.last_row < b.first_row; });
}

}  // namespace domefall
