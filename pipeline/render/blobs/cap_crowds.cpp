#include "pipeline/render/blobs/cap_crowds.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace domefall {
namespace {

constexpr std::size_t kCrowd = 16;
constexpr double kSide = 0.25;  // of a crowd's square, in sigmas

struct Cell {
  std::uint64_t key;
  std::uint32_t blob;
};

std::uint64_t key_of(const CapBlob& b, double pixels_per_radian) {
  // Half a pixel at least, so that 16 bits suffice for a picture of 32k.
  const double side = std::max(kSide * b.sigma * pixels_per_radian, 0.5);
  const auto place = [side](double at) {
    return static_cast<std::uint64_t>(std::clamp(at / side + 1024, 0.0, 65535.0));
  };
  return (std::uint64_t{std::bit_cast<std::uint32_t>(b.sigma)} << 32) | place(b.x) << 16 |
         place(b.y);
}

// The first of a crowd takes in the others, which are marked by an empty range of rows.  Together they
// are brighter and reach farther: where no blob so large has a place, at the end of a very wide flat
// picture, they stay as they are.
void merge(const Projection& projection, const Cell* first, const Cell* end,
           std::vector<CapBlob>& blobs) {
  double x = 0, y = 0, light = 0, rgb[3] = {0, 0, 0};
  for (const Cell* cell = first; cell != end; ++cell) {
    const CapBlob& b = blobs[cell->blob];
    const double weight = std::max({b.rgb[0], b.rgb[1], b.rgb[2]});
    x += weight * b.x, y += weight * b.y, light += weight;
    for (int c = 0; c < 3; ++c) rgb[c] += b.rgb[c];
  }
  CapBlob one = blobs[first->blob];
  one.x = static_cast<float>(x / light), one.y = static_cast<float>(y / light);
  for (int c = 0; c < 3; ++c) one.rgb[c] = static_cast<float>(rgb[c]);
  if (!place_cap(projection, one)) return;
  for (const Cell* cell = first; cell != end; ++cell)
    blobs[cell->blob].last_row = blobs[cell->blob].first_row - 1;
  blobs[first->blob] = one;
}

}  // namespace

void merge_crowds(const Projection& projection, std::vector<CapBlob>& blobs) {
  if (blobs.size() < kCrowd) return;
  const double pixels_per_radian = 1 / central_pixel_angle(projection);
  std::vector<Cell> cells(blobs.size());
  for (std::size_t k = 0; k < blobs.size(); ++k)
    cells[k] = {key_of(blobs[k], pixels_per_radian), static_cast<std::uint32_t>(k)};
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
    return std::pair(a.key, a.blob) < std::pair(b.key, b.blob);
  });
  for (auto first = cells.begin(); first != cells.end();) {
    const auto end = std::find_if(first, cells.end(),
                                  [key = first->key](const Cell& c) { return c.key != key; });
    if (static_cast<std::size_t>(end - first) >= kCrowd)
      merge(projection, &*first, &*first + (end - first), blobs);
    first = end;
  }
  std::erase_if(blobs, [](const CapBlob& b) { return b.last_row < b.first_row; });
}

}  // namespace domefall
