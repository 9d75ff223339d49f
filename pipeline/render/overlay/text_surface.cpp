#include "pipeline/render/overlay/text_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

// Returns the latitude of the text's middle about the pole of its lines.  It is the elevation up to
// 60 degrees.  From there on it falls twice as fast as the elevation rises, to 0 at the zenith.
double latitude_for(double elevation) {
  constexpr double kRight = std::numbers::pi / 2;
  const double above = std::min(std::abs(elevation), 2 * (kRight - std::abs(elevation)));
  return std::copysign(std::max(above, 0.0), elevation);
}

}  // namespace

TextSurface::TextSurface(const M33d& camera_from_audience, double azimuth, double elevation,
                         double height) {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation),
               se = std::sin(elevation);
  const V3d middle(ce * sa, ce * ca, se), up(-se * sa, -se * ca, ce);
  const double latitude = latitude_for(elevation);
  const double cl = std::cos(latitude), sl = std::sin(latitude);
  right_ = apply(camera_from_audience, V3d(ca, -sa, 0));
  front_ = apply(camera_from_audience, middle * cl - up * sl);
  pole_ = apply(camera_from_audience, middle * sl + up * cl);
  // Mercator's ordinate of a latitude is asinh(tan(latitude)), and the sphere is cos(latitude)
  // times as large there as the map.
  scale_ = height / cl;
  start_ = std::asinh(std::tan(latitude));
}

CameraDirection TextSurface::direction(const TextPoint& p) const {
  const double around = p.x * scale_, ordinate = start_ + p.y * scale_;
  // By the inverse of Mercator's projection, the cosine of the latitude is 1/cosh(ordinate) and the
  // sine is tanh(ordinate).
  const double across = 1 / std::cosh(ordinate);
  return {(front_ * std::cos(around) + right_ * std::sin(around)) * across +
          pole_ * std::tanh(ordinate)};
}

}  // namespace domefall
