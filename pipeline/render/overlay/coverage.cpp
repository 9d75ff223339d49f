#include "pipeline/render/overlay/coverage.h"

#include <algorithm>
#include <cmath>

namespace domefall {
namespace {

constexpr double kFarAway = 1e6, kPerPixel = 4096;

ImagePoint on_grid(const ImagePoint& p) {
  return {std::round(p.x * kPerPixel) / kPerPixel, std::round(p.y * kPerPixel) / kPerPixel};
}

bool is_usable(const ImagePoint& p) { return std::abs(p.x) < kFarAway && std::abs(p.y) < kFarAway; }

// Adds an edge that lies within one row of pixels, from x0 to x1 >= x0.  The row holds differences
// from pixel to pixel.  Their running sum is the part of a pixel to the right of the edge.
// `height` has the sign of the edge's direction.
void add_in_row(double x0, double x1, double height, double* row) {
  const double first = std::floor(x0), last = std::ceil(x1);
  auto* at = row + static_cast<std::ptrdiff_t>(first);
  if (last <= first + 1) {
    const double beyond = height * ((x0 + x1) / 2 - first);
    at[0] += height - beyond;
    at[1] += beyond;
    return;
  }
  // Up to a border between pixels, the area to the right of the edge is a parabola in the first and
  // the last pixel, and grows linearly between these.
  const double per_pixel = height / (x1 - x0);
  double before = 0;
  for (double border = first + 1;; ++border, ++at) {
    const double from = std::max(border - 1, x0), to = std::min(border, x1);
    const double within = per_pixel * (to - from);                // of the height, in this pixel
    const double left_out = within * (border - (from + to) / 2);  // its share of this pixel
    at[0] += before + left_out;
    before = within - left_out;
    if (border >= last) {
      at[1] += before;
      return;
    }
  }
}

// Says how much ink a row of pixels gets: part[k] of the pixel in column first + k.
struct InkedRow {
  int row, first, end;  // its columns from first to end - 1
  std::span<const double> parts;
  double opacity;

  template <class Draw>
  void each(const Draw& draw) const {
    for (int x = first; x < end; ++x) {
      const auto part = static_cast<float>(parts[static_cast<std::size_t>(x - first)] * opacity);
      if (part != 0) draw(x, part);
    }
  }
};

template <class T>
void draw_light(const InkedRow& inked, const WorkingRgb& ink, ImageRgb<T>& image) {
  const float light[3] = {ink.r, ink.g, ink.b};
  T* const pixels = image.row(inked.row);
  inked.each([&](int x, float part) {
    for (int c = 0; c < 3; ++c) {
      T& value = pixels[3 * x + c];
      value = static_cast<float>(value) * (1 - part) + light[c] * part;
    }
  });
}

// Draws over a row of the picture, and of its titles if it has them.
template <class T>
void draw_row(const InkedRow& inked, const WorkingRgb& ink, const OverlaidImages<T>& images) {
  draw_light(inked, ink, *images.picture);
  if (!images.titles) return;
  images.titles->add_pixels(true);
  draw_light(inked, ink, images.titles->light);
  float* const alpha =
      images.titles->alpha.data() + static_cast<std::ptrdiff_t>(inked.row) * images.picture->width;
  inked.each([&](int x, float part) { alpha[x] = alpha[x] * (1 - part) + part; });
}

void draw_within(const ColumnRange& range, int row, int first, std::span<const double> parts,
                 const Ink& ink, const FrameRef& frame) {
  const int begin = std::max(first, range.first),
            end = std::min(first + static_cast<int>(parts.size()), range.last + 1);
  if (begin >= end) return;
  const InkedRow inked{row, begin, end, parts.subspan(static_cast<std::size_t>(begin - first)),
                       ink.opacity};
  std::visit([&](const auto& images) { draw_row(inked, ink.light, images); }, frame.images);
}

}  // namespace

void Coverage::add(const ImagePolygon& polygon) {
  if (!std::ranges::all_of(polygon, is_usable)) return;
  edges_.resize(static_cast<std::size_t>((height_ + kRows - 1) / kRows));
  for (std::size_t k = 0; k < polygon.size(); ++k)
    add_edge(on_grid(polygon[k]), on_grid(polygon[(k + 1) % polygon.size()]));
}

void Coverage::add_edge(ImagePoint from, ImagePoint to) {
  if (from.y == to.y) return;
  const double direction = from.y < to.y ? 1 : -1;
  if (direction < 0) std::swap(from, to);
  if (to.y <= 0 || from.y >= height_) return;
  const int first = std::max(0, static_cast<int>(from.y) / kRows),
            last = std::min(static_cast<int>(edges_.size()) - 1, static_cast<int>(to.y) / kRows);
  for (int band = first; band <= last; ++band)
    edges_[static_cast<std::size_t>(band)].push_back({from.x, from.y, to.x, to.y, direction});
}

// The part of an edge to the left of the image counts as if it ran along the left border.  The
// part to the right of the image covers nothing.
Coverage::Span Coverage::accumulate(int top, std::vector<double>& band) const {
  if (edges_.empty()) return {};
  const std::vector<Edge>& edges = edges_[static_cast<std::size_t>(top / kRows)];
  if (edges.empty()) return {};
  double left = HUGE_VAL, right = -HUGE_VAL;
  for (const Edge& e : edges) {
    left = std::min({left, e.x0, e.x1});
    right = std::max({right, e.x0, e.x1});
  }
  Span span;
  span.first = static_cast<int>(std::clamp(std::floor(left), 0.0, double(width_)));
  const int end = static_cast<int>(std::clamp(std::ceil(right), 0.0, double(width_)));
  if (end <= span.first) return {};
  span.count = static_cast<std::size_t>(end - span.first);
  band.assign(span.stride() * kRows, 0);
  const auto limit = static_cast<double>(span.count);
  for (const Edge& e : edges) {
    // Each edge is cut at the borders between rows.
    const double slope = (e.x1 - e.x0) / (e.y1 - e.y0);
    const double begin = std::max(e.y0, double(top)), stop = std::min(e.y1, double(top + kRows));
    for (double y = begin; y < stop;) {
      const double next = std::min(std::floor(y) + 1, stop);
      double* row = band.data() + static_cast<std::size_t>(y - top) * span.stride();
      double x0 = e.x0 + slope * (y - e.y0) - span.first,
             x1 = e.x0 + slope * (next - e.y0) - span.first;
      if (x0 > x1) std::swap(x0, x1);
      const double height = e.direction * (next - y), width = x1 - x0;
      const double low = std::clamp(x0, 0.0, limit), high = std::clamp(x1, 0.0, limit);
      if (width > 0) {
        row[0] += height * (std::min(x1, 0.0) - std::min(x0, 0.0)) / width;
        if (high > low) add_in_row(low, high, height * (high - low) / width, row);
      } else {
        add_in_row(low, low, height, row);
      }
      y = next;
    }
  }
  // The running sum of the differences is the signed area.
  for (int row = 0; row < kRows; ++row) {
    double* at = band.data() + static_cast<std::size_t>(row) * span.stride();
    double sum = 0;
    for (std::size_t k = 0; k < span.count; ++k) {
      sum += at[k];
      constexpr double kNothing = 1e-9;  // what rounding leaves
      const double part = std::min(std::abs(sum), 1.0);
      at[k] = part > kNothing ? part : 0;
    }
  }
  return span;
}

void draw_over(const Coverage& coverage, const Ink& ink, const Projection& projection,
               const FrameRef& frame) {
  coverage.for_each_row([&](int row, int first, std::span<const double> parts) {
    draw_within(inside_columns(projection, row), row, first, parts, ink, frame);
  });
}

void draw_over(const std::vector<CoveredRow>& covered, const Ink& ink, const Projection& projection,
               const FrameRef& frame) {
  for (const auto& [row, first, parts] : covered)
    draw_within(inside_columns(projection, row), row, first, parts, ink, frame);
}

void draw_anywhere(const Coverage& coverage, const Ink& ink, const FrameRef& frame) {
  coverage.for_each_row([&](int row, int first, std::span<const double> parts) {
    draw_within({0, frame.width - 1}, row, first, parts, ink, frame);
  });
}

}  // namespace domefall
