#include "pipeline/render/overlay/title_ground.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/render/rays/sky_borders.h"
#include "projections/pixel_directions.h"

namespace domefall {
namespace {

// Lengths are in heights of a capital.  Descenders reach 0.3 below the base line, and a plate that
// is a capital and a half larger than its text has room for them.
constexpr double kPlateMargin = 0.5;  // of the plate around the text
constexpr double kPlateEdge = 1.2;    // in which the plate goes to nothing
constexpr double kReach = kPlateMargin + kPlateEdge;

// The shadow's grid, and the boxes whose means blur it.  Three boxes of 9 points have a standard
// deviation of 4.5 points, 0.28 capitals, which is more than the width of a stroke.
constexpr int kPerCapital = 16, kBox = 9, kBoxes = 3;

// Goes from 1 at 0 to 0 at 1, level at both ends.
double falling(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

// Replaces `count` values, `stride` apart, by the means of kBox neighbours.  Beyond the ends all
// are 0.
void blur_line(float* values, int count, int stride, std::vector<float>& line) {
  constexpr int kHalf = kBox / 2;
  line.assign(static_cast<std::size_t>(count + kBox), 0);
  for (int k = 0; k < count; ++k)
    line[static_cast<std::size_t>(k + kHalf)] = values[static_cast<std::ptrdiff_t>(k) * stride];
  double sum = 0;
  for (int k = 0; k < kBox - 1; ++k) sum += line[static_cast<std::size_t>(k)];
  for (int k = 0; k < count; ++k) {
    sum += line[static_cast<std::size_t>(k + kBox - 1)];
    values[static_cast<std::ptrdiff_t>(k) * stride] = static_cast<float>(std::max(sum, 0.0) / kBox);
    sum -= line[static_cast<std::size_t>(k)];
  }
}

PixelBox whole_image(const Projection& projection) {
  return {0, columns(projection) - 1, 0, rows(projection) - 1};
}

// Returns pixels among which the image of the text's points within these half sides is.  The image
// of a region lies within the bounds of its border's image, unless the image has a seam, or the
// region holds the direction that projections have no image of.
PixelBox bounds(double half_width, double half_height, const TextSurface& surface,
                const Projection& projection) {
  if (traits_of(projection).has_seam) return whole_image(projection);
  const TextPoint behind = surface.point({{0, 0, -1}});
  if (std::abs(behind.x) <= half_width && std::abs(behind.y) <= half_height)
    return whole_image(projection);
  constexpr int kSteps = 100;
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL;
  for (int k = -kSteps; k <= kSteps; ++k)
    for (const int side : {-1, 1}) {
      const double part = static_cast<double>(k) / kSteps;
      for (const TextPoint p : {TextPoint{part * half_width, side * half_height},
                                TextPoint{side * half_width, part * half_height}}) {
        const auto pixel = pixel_of(projection, surface.direction(p));
        if (!pixel) return whole_image(projection);
        const ImagePoint at = image_point(*pixel);
        left = std::min(left, at.x), right = std::max(right, at.x);
        top = std::min(top, at.y), bottom = std::max(bottom, at.y);
      }
    }
  // Between two points of the border its image is curved, by less than a tenth of the way.
  const double slack = 1 + ((right - left) + (bottom - top)) / kSteps;
  const auto clamped = [](double at, int size) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, size - 1.0));
  };
  return {clamped(left - slack, columns(projection)), clamped(right + slack, columns(projection)),
          clamped(top - slack, rows(projection)), clamped(bottom + slack, rows(projection))};
}

}  // namespace

TitleGround::TitleGround(const LetteredText& text, double plate, double shadow)
    : half_width_(text.half_width), half_height_(text.half_height), plate_(plate), shadow_(shadow) {
  if (!(shadow > 0)) return;
  columns_ = static_cast<int>(std::ceil(2 * (half_width_ + kReach) * kPerCapital));
  rows_ = static_cast<int>(std::ceil(2 * (half_height_ + kReach) * kPerCapital));
  blurred_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  Coverage letters(columns_, rows_);
  add_flat_text(text, {columns_ / 2.0, rows_ / 2.0}, kPerCapital, {1, 1}, letters);
  letters.for_each_row([&](int row, int first, std::span<const double> parts) {
    std::ranges::copy(parts,
                      blurred_.begin() + static_cast<std::ptrdiff_t>(row) * columns_ + first);
  });
  std::vector<float> line;
  for (int box = 0; box < kBoxes; ++box) {
    for (int row = 0; row < rows_; ++row)
      blur_line(blurred_.data() + static_cast<std::ptrdiff_t>(row) * columns_, columns_, 1, line);
    for (int column = 0; column < columns_; ++column)
      blur_line(blurred_.data() + column, rows_, columns_, line);
  }
  // A single stroke covers three tenths of the blur.  Sixteen such layers make the shadow whole
  // where a letter is, half at the foot of the blur, and soft beyond.
  for (float& value : blurred_) {
    float left = 1 - value;
    for (int doubling = 0; doubling < 4; ++doubling) left *= left;
    value = 1 - left;
  }
}

double TitleGround::plate_at(const TextPoint& p) const {
  const double beyond = std::hypot(std::max(std::abs(p.x) - half_width_ - kPlateMargin, 0.0),
                                   std::max(std::abs(p.y) - half_height_ - kPlateMargin, 0.0));
  return falling(beyond / kPlateEdge);
}

double TitleGround::shadow_at(const TextPoint& p) const {
  // The middle of the first point of the grid is at half a step.
  const double x = columns_ / 2.0 + p.x * kPerCapital - 0.5,
               y = rows_ / 2.0 - p.y * kPerCapital - 0.5;
  if (!(x >= 0 && y >= 0 && x < columns_ - 1 && y < rows_ - 1)) return 0;
  const auto column = static_cast<std::ptrdiff_t>(x), row = static_cast<std::ptrdiff_t>(y);
  const double u = x - static_cast<double>(column), v = y - static_cast<double>(row);
  const float* const upper = blurred_.data() + row * columns_ + column;
  const float* const lower = upper + columns_;
  return (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
}

double TitleGround::darkness(const TextPoint& p) const {
  double left = 1;
  if (plate_ > 0) left *= 1 - plate_ * plate_at(p);
  if (shadow_ > 0) left *= 1 - shadow_ * shadow_at(p);
  return 1 - left;
}

std::vector<CoveredRow> TitleGround::covered(const TextSurface& surface,
                                             const Projection& projection) const {
  std::vector<CoveredRow> covered;
  if (!(plate_ > 0 || shadow_ > 0)) return covered;
  const double half_width = half_width_ + kReach, half_height = half_height_ + kReach;
  const PixelBox box = bounds(half_width, half_height, surface, projection);
  const TextRegion region(surface, half_width, half_height);
  std::vector<double> across, down, angles;
  std::vector<CameraDirection> directions;
  for (int row = box.first_row; row <= box.last_row; ++row) {
    const ColumnRange inside = inside_columns(projection, row);
    const int first = std::max(box.first_column, inside.first),
              last = std::min(box.last_column, inside.last);
    if (first > last) continue;
    const int count = last - first + 1;
    const auto size = static_cast<std::size_t>(count);
    across.resize(size), angles.resize(size), directions.resize(size);
    std::iota(across.begin(), across.end(), first + 1.0);
    down.assign(size, row + 1.0);
    find_directions(projection, across.data(), down.data(), count, directions.data(),
                    angles.data());
    CoveredRow& parts = covered.emplace_back(CoveredRow{row, first, {}});
    parts.parts.reserve(size);
    for (const CameraDirection& n : directions)
      parts.parts.push_back(region.holds(n) ? darkness(surface.point(n)) : 0);
  }
  return covered;
}

}  // namespace domefall
