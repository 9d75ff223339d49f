// Each question to a projection as a function of its type.  What a projection does not say of itself
// follows here from what it must say (projection_parts.h).
#pragma once

#include <cmath>
#include <vector>

#include "projections/projection_parts.h"

namespace domefall {

template <class P>
constexpr bool kHasSides = requires(P p) {
  p.columns + p.rows;
};
template <class P>
constexpr bool kHasFieldOfView = requires(P p) {
  p.fov;
};
template <class P>
constexpr bool kCanBeCut = requires(P p) {
  p.cut_back;
};

template <class P>
constexpr bool kHasPixelAspect = requires(P p) {
  p.pixel_aspect;
};

// Returns the width of a pixel over its height.
template <class P>
double pixel_aspect_of(const P& p) {
  if constexpr (kHasPixelAspect<P>)
    return p.pixel_aspect;
  else
    return 1;
}

template <class P>
int width_of(const P& p) {
  if constexpr (kHasSides<P>)
    return p.columns;
  else
    return p.width();
}

template <class P>
int height_of(const P& p) {
  if constexpr (kHasSides<P>)
    return p.rows;
  else
    return p.height();
}

template <class P>
PixelPosition origin_of(const P& p) {
  PixelPosition origin{(width_of(p) + 1) / 2.0, (height_of(p) + 1) / 2.0};
  // It lies below the middle by half of what more is cut at the bottom than at the top.
  if constexpr (kCanBeCut<P>)
    origin.j += (p.columns * pixel_aspect_of(p) - p.rows) * (0.5 - p.cut_back);
  return origin;
}

template <class P>
Centred centred(const P& p, PixelPosition pixel) {
  const PixelPosition o = origin_of(p);
  return {pixel.i - o.i, (pixel.j - o.j) * (1 / pixel_aspect_of(p))};
}
template <class P>
PixelPosition uncentred(const P& p, Centred at) {
  const PixelPosition o = origin_of(p);
  return {o.i + at.x, o.j + at.y * pixel_aspect_of(p)};
}

// Brings a metric by widths of a pixel to one by pixels, which are so many widths high.
template <class P>
PixelMetric by_pixels(const P& p, const PixelMetric& m) {
  const double high = 1 / pixel_aspect_of(p);
  return {m.xx, m.xy * high, m.yy * high * high};
}

// Of two differences over an eighth of a width, as the metric by default.  The relative error is
// below the square of a pixel's angle (radians) and 1e-15 of that angle's inverse.
template <class P>
PixelMetric metric_by_differences(const P& p, Centred at) {
  constexpr double kStep = 0.0625;
  const Imath::V3d dx = p.direction({at.x + kStep, at.y}).v - p.direction({at.x - kStep, at.y}).v;
  const Imath::V3d dy = p.direction({at.x, at.y + kStep}).v - p.direction({at.x, at.y - kStep}).v;
  constexpr double kScale = 1 / (4 * kStep * kStep);
  return {dx.dot(dx) * kScale, dx.dot(dy) * kScale, dy.dot(dy) * kScale};
}

template <class P>
PixelMetric metric_of(const P& p, Centred at) {
  if constexpr (requires { p.metric(at); })
    return by_pixels(p, p.metric(at));
  else if constexpr (requires { p.scales(at); })
    return by_pixels(p, metric_about_z(p.scales(at), at));
  else
    return by_pixels(p, metric_by_differences(p, at));
}

template <class P>
double solid_angle_of(const P& p, Centred at) {
  if constexpr (requires { p.solid_angle(at); }) {
    return p.solid_angle(at) / pixel_aspect_of(p);
  } else if constexpr (requires { p.scales(at); }) {
    const AngularScales s = p.scales(at);
    return s.radial * s.tangential / pixel_aspect_of(p);
  } else {
    const PixelMetric m = metric_of(p, at);
    return std::sqrt(std::max(0.0, m.xx * m.yy - m.xy * m.xy));
  }
}

// Along the longer axis of the ellipse of a metric a pixel covers the root of its larger eigenvalue.
template <class P>
double pixel_angle_of(const P& p, Centred at) {
  if (pixel_aspect_of(p) == 1) {
    if constexpr (requires { p.pixel_angle(at); }) return p.pixel_angle(at);
    if constexpr (requires { p.scales(at); }) {
      const AngularScales s = p.scales(at);
      return std::max(s.radial, s.tangential);
    }
  }
  const PixelMetric m = metric_of(p, at);
  return std::sqrt((m.xx + m.yy) / 2 + std::hypot((m.xx - m.yy) / 2, m.xy));
}

template <class P>
double largest_pixel_angle_of(const P& p) {
  return p.largest_pixel_angle() * std::max(1.0, 1 / pixel_aspect_of(p));
}

template <class P>
bool shows_at(const P& p, Centred at) {
  if constexpr (requires { p.shows(at); }) return p.shows(at);
  const double radius = width_of(p) / 2.0;
  return !P::kTraits.is_dome || at.x * at.x + at.y * at.y <= radius * radius;
}

template <class P>
ColumnRange inside_columns_of(const P& p, int row) {
  const int width = width_of(p);
  const double y = (row + 1 - origin_of(p).j) / pixel_aspect_of(p);
  ColumnRange range{0, width - 1};
  // The search begins beside the edge of a circle.
  if constexpr (P::kTraits.is_dome) {
    const double radius = width / 2.0, half = std::sqrt(std::max(0.0, radius * radius - y * y));
    range.first = std::max(0, static_cast<int>((width - 1) / 2.0 - half) - 1);
    range.last = width - 1 - range.first;
  }
  const auto is_shown = [&](int column) { return shows_at(p, {column + 1 - origin_of(p).i, y}); };
  while (range.first <= range.last && !is_shown(range.first)) ++range.first;
  while (range.first <= range.last && !is_shown(range.last)) --range.last;
  return range;
}

// Frames would be taken for each other if a key lacked a number that defines them.
template <class P>
void add_parameters(const P& p, std::vector<double>& parameters) {
  if constexpr (kHasFieldOfView<P>) parameters.push_back(p.fov);
  if constexpr (kCanBeCut<P>) parameters.push_back(p.cut_back);
  // Square pixels add nothing, so that their frames keep their keys.
  if (pixel_aspect_of(p) != 1) parameters.push_back(pixel_aspect_of(p));
  constexpr std::size_t kKnown = kHasFieldOfView<P> + kCanBeCut<P> + kHasPixelAspect<P>;
  static_assert(kHasFieldOfView<P> == (P::kTraits.widest_deg > 0), "a show may set it, or may not");
  static_assert(sizeof(P) <= 2 * sizeof(int) + kKnown * sizeof(double),
                "a further parameter belongs here");
}

template <class P>
double scale_change_of(const P& p, const CameraDirection& n) {
  if constexpr (requires { p.scale_change(n); }) return p.scale_change(n);
  return kEndlessChange;
}

template <class P>
bool slants_of(const P& p, int row) {
  if constexpr (requires { p.has_slanted_areas(row); }) return p.has_slanted_areas(row);
  return true;
}

// The rim of a cap, and so all of it, lies in the box of places along the rim and of what the rim
// bulges between two of them, which is less than their distance.  That is so unless the projection
// tears the cap.  Then the place halfway between two neighbours is elsewhere on the sphere, or the
// rim does not go around the middle, and the box is the whole image.
template <class P>
CapBox cap_box_of_rim(const P& p, const CameraDirection& n, double angle) {
  constexpr int kPlaces = 32;
  const std::optional<Centred> middle = p.place(n);
  if (!middle || angle > 1) return square_box(kWholeImage);
  const Imath::V3d aside = std::abs(n.v.z) < 0.7 ? Imath::V3d(0, 0, 1) : Imath::V3d(1, 0, 0);
  const Imath::V3d e1 = n.v.cross(aside).normalized(), e2 = n.v.cross(e1);
  const double step = 2 * std::numbers::pi / kPlaces;
  double longest = 0, turned = 0;
  CapBox box{};
  Centred before{};
  for (int k = 0; k <= kPlaces; ++k) {
    const Imath::V3d rim = n.v * std::cos(angle) +
                           (e1 * std::cos(k * step) + e2 * std::sin(k * step)) * std::sin(angle);
    const std::optional<Centred> at = p.place({rim});
    if (!at) return square_box(kWholeImage);
    const Centred off{at->x - middle->x, at->y - middle->y};
    if (k > 0) {
      const Centred halfway{middle->x + (off.x + before.x) / 2, middle->y + (off.y + before.y) / 2};
      if ((p.direction(halfway).v - rim).length() > step * std::sin(angle))
        return square_box(kWholeImage);
      turned +=
          std::atan2(before.x * off.y - before.y * off.x, before.x * off.x + before.y * off.y);
      longest = std::max(longest, std::hypot(off.x - before.x, off.y - before.y));
    }
    box.left = std::max(box.left, -off.x), box.right = std::max(box.right, off.x);
    box.up = std::max(box.up, -off.y), box.down = std::max(box.down, off.y);
    before = off;
  }
  if (std::abs(turned) < std::numbers::pi) return square_box(kWholeImage);
  for (double* side : {&box.left, &box.right, &box.up, &box.down}) *side += longest + 1;
  box.reach = std::hypot(std::max(box.left, box.right), std::max(box.up, box.down));
  return box;
}

template <class P>
CapBox cap_box_by_widths(const P& p, const CameraDirection& n, double angle) {
  if constexpr (requires { p.cap_box(n, angle); }) return p.cap_box(n, angle);
  return cap_box_of_rim(p, n, angle);
}

// A box has a margin for what a pixel covers, of a width.
template <class P>
CapBox cap_box_of(const P& p, const CameraDirection& n, double angle) {
  CapBox box = cap_box_by_widths(p, n, angle);
  const double aspect = pixel_aspect_of(p);
  if (aspect == 1) return box;
  box.up = box.up * aspect + 1, box.down = box.down * aspect + 1;
  box.reach = box.reach * std::max(1.0, aspect) + 1;
  return box;
}

template <class P>
CapSpans cap_spans_of(const P& p, const CapPlace& cap, int row, const ColumnRange& inside) {
  if constexpr (requires { p.cap_spans(cap, origin_of(p), row, inside); })
    if (pixel_aspect_of(p) == 1) return p.cap_spans(cap, origin_of(p), row, inside);
  CapSpans spans;
  if (const auto part = part_of_row(cap, row)) spans.add(part->left, part->right, inside);
  return spans;
}

}  // namespace domefall
