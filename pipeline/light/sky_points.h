// SkyPoints say where the points of one sky are seen through a lens, in the lens's frame.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "trajectories/directions.h"

namespace domefall {

// A SkyImage is one image of a point of a sky.
struct SkyImage {
  TetradDirection direction;
  double frequency_ratio;  // observed in the frame / emitted: 1/(1+z)
  double amplification;    // solid angle of the image / of the source; inf on the axis of a lens
  // By how many radians an image that was listed moves for one of its source, or somewhat less.
  double speed = 0;
};

// A PointBatch holds points of a sky.
struct PointBatch {
  static constexpr int kSize = 256;
  template <class T>
  using Column = std::array<T, kSize>;
  Column<double> x, y, z;  // unit vectors along R, Theta, Phi
  // These two are set by locate().  The amplification goes like the inverse of `sine`, which is 1
  // for a lens without an axis.  `v` is the lens's own.
  Column<double> sine, v;
};

// A PointImageBatch holds images of one order.
struct PointImageBatch {
  PointBatch::Column<double> x, y, z;  // unit vectors along the axes of the lens's frame
  PointBatch::Column<double> frequency_ratio, amplification;
};

// PointTolerance says how accurate the images of a batch are.
struct PointTolerance {
  double position = 1e-6;  // radians
  double flux = 1e-4;      // relative
};

// Through a lens with an axis a star is an even disc (einstein_rings.h) if it is nearer to the axis
// than this many radii, and a point elsewhere.
// If the middle of the disc is d radii from the axis, the mean of 1/distance over the disc is
// 1 + 1/(8 d^2) times its value in the middle.  So at 8 radii the light changes by two parts in a
// thousand.
inline constexpr double kNearAxis = 8;

// Says whether images of this order lie on a caustic for a source near the axis.  All do except the
// primary image of a source above the observer.
inline bool on_caustic(const V3d& source, int order) { return source.x < 0 || order > 0; }

class SkyPoints {
 public:
  SkyPoints() = default;
  SkyPoints(const SkyPoints&) = delete;
  SkyPoints& operator=(const SkyPoints&) = delete;
  virtual ~SkyPoints() = default;

  // Returns the number of images of a point that are looked for.
  virtual int orders() const { return 1; }
  // Says whether points near the line through the hole, the axis R, are bright without bound, and
  // have images that turn about it as they move.
  virtual bool has_axis() const { return false; }

  // Returns one image.  `blur` (radians) is the angular radius of the source, which bounds its
  // amplification on the axis.
  virtual SkyImage image(const V3d& source, int order, double blur) const = 0;
  // Returns the image of an even disc near the axis in pieces (arc_of).  Only lenses with an axis
  // are asked.
  virtual std::vector<SkyImage> arc(const V3d&, int, double,
                                    const std::function<double(const V3d&)>&) const {
    return {};
  }

  // Says whether a point has any number of images, which are listed and have no orders.
  virtual bool lists_images() const { return false; }
  // Appends those whose amplification times (frequency ratio)^4 may be above `least_light`.
  virtual void list_images(const V3d&, double, double, std::vector<SkyImage>&) const {}

  // ---- many points at a time, if the lens was asked for a tolerance ----

  // Returns how many orders, from 0 on, are found many points at a time.
  virtual int orders_in_batches() const { return 1; }
  // Returns an upper bound of amplification * sine * (frequency ratio)^4 of an order.
  virtual double most_light(int order) const = 0;
  virtual void locate(PointBatch& points, int count) const;
  // Finds such bounds for `count` of the points.  The bound is negative where the image has to be
  // found by itself.
  virtual void bounds(int order, const PointBatch& points, const int* chosen, int count,
                      float* out) const;
  // Finds the images of points that are off the axis.
  virtual void images(int order, const PointBatch& points, int count,
                      PointImageBatch& images) const = 0;
};

inline void SkyPoints::locate(PointBatch& points, int count) const {
  for (int k = 0; k < count; ++k) points.sine[k] = 1, points.v[k] = 0;
}

inline void SkyPoints::bounds(int order, const PointBatch&, const int*, int count,
                              float* out) const {
  for (int k = 0; k < count; ++k) out[k] = static_cast<float>(most_light(order));
}

}  // namespace domefall
