// A Veil says how much of a pixel's light is left behind several images of a disc.
//
// Within a pixel the rims of the images are almost parallel.  The thin images at the edge of the
// silhouette lie side by side there, so that one does not hide the other although both are in one
// pixel.  Therefore one coordinate from 0 to 1 says where a line parallel to the rims cuts the
// pixel.  It is the part of the pixel on one side of the line.  An image covers an interval of it.
#pragma once

#include <algorithm>
#include <array>

namespace domefall {

// At most kImages images are laid over one another.
template <int kImages>
class Veil {
 public:
  // Lays an image of this opacity over the part [from, to] of the pixel, 0 <= from <= to <= 1,
  // behind the images that are there.  Returns how much of the image's light is seen, as a part of
  // the pixel.
  double lay(double from, double to, double opacity) {
    divide(from);
    divide(to);
    double seen = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      if (!(start_[k] >= from && start_[k] < to)) continue;
      seen += left_[k] * opacity * width(k);
      left_[k] *= 1 - opacity;
    }
    return seen;
  }

  // Returns the part of the light from behind that is left.
  double left() const {
    double sum = 0;
    for (std::size_t k = 0; k < count_; ++k) sum += left_[k] * width(k);
    return sum;
  }

 private:
  double width(std::size_t k) const { return (k + 1 < count_ ? start_[k + 1] : 1) - start_[k]; }

  // Lets a piece of the pixel begin at `at`, 0 < at < 1.  Other values change nothing.
  void divide(double at) {
    if (!(at > 0 && at < 1)) return;
    const auto end = start_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto after = std::upper_bound(start_.begin(), end, at);
    const auto k = static_cast<std::size_t>(after - start_.begin());
    if (start_[k - 1] == at) return;
    std::copy_backward(after, end, end + 1);
    std::copy_backward(left_.begin() + static_cast<std::ptrdiff_t>(k) - 1,
                       left_.begin() + static_cast<std::ptrdiff_t>(count_),
                       left_.begin() + static_cast<std::ptrdiff_t>(count_) + 1);
    start_[k] = at;
    ++count_;
  }

  static constexpr std::size_t kPieces = 2 * kImages + 1;
  std::size_t count_ = 1;
  std::array<double, kPieces> start_{0}, left_{1};
};

}  // namespace domefall
