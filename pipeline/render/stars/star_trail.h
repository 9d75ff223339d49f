// A star that passes the axis of the lens while a frame lasts has an image along the Einstein ring.
// This file makes that trail.
//
// As a source passes the hole at the angle b from the axis, its image races around the ring.  It
// covers half of the ring in the time in which the source moves by a few b.  No single instant
// stands for that time.  So an image near the axis is the mean over a window of time about the
// frame's instant.  The window's weight falls to 0 at both ends, so that the trail tapers.  If it
// falls linearly, the windows of successive instants add up to an even exposure.
//
// Near the axis the sky is flat and the source moves along a line.  Let s be the distance along
// this line from the point closest to the axis, and x = asinh(s/b).  Then the distance from the
// axis is b cosh(x), and the amplification is proportional to its inverse.  Because ds / (b cosh x)
// = dx, an image brings equal light in equal steps of x.  Its path in x is as smooth as the lens.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "pipeline/light/aberration.h"
#include "pipeline/light/sky_points.h"
#include "pipeline/render/stars/star_loops.h"

namespace domefall {

// A PassageWindow is the window of time, in frames to either side of the instant, over which an
// image near the axis is a mean.  Its weight is proportional to (1 - |u|)^sharpness, where u goes
// from -1 to 1.
struct PassageWindow {
  double half, sharpness;
};
// Returns the window of a source whose distance from the axis is `ratio` times its path from frame to
// frame.  From a third of `instant` to `instant` the window shrinks to the instant.
PassageWindow passage_window(double ratio, double instant);

// Windows reach at most kWindow frames, and have shrunk to the instant where the ratio is kInstant.
inline constexpr double kWindow = 5, kInstant = 24;
// A passage is at most this far from the axis (as a sine), and half of its path is at most this
// long.  The sky is taken as flat up to there.
inline constexpr double kFarthestPassage = 0.25, kLongestWay = 0.3;
// With an open shutter an image is at least the mean over the gap between two instants.  Images
// that move by less than this many pixels in the gap are left to the mean of the instants.  Their
// sum ripples by 2 exp(-2 pi^2 (0.9/1.5)^2) = 0.2 %, as a row of Gaussians with a sigma of 0.9
// pixels (kLeastSigmaPixels).
inline constexpr double kTrailPixels = 1.5;

// An AxisPassage is the path of a source past the axis, from u = -1 to u = 1, with its middle at
// u = 0.  It counts as no closer to the axis than `radius`/2, because the mean of 1/distance over a
// disc about the axis is 2/radius.
class AxisPassage {
 public:
  // `source` is a unit vector along R, Theta, Phi.  From u = 0 to u = 1 the vector `half_way` is
  // added to it, which is small against 1 and not along R.  The radius is in radians, > 0.  The
  // weight is (sharpness + 1)/2 (1 - |u|)^sharpness, whose integral is 1, with a sharpness of at
  // least 1.
  AxisPassage(const V3d& source, const V3d& half_way, double radius, double sharpness = 1);

  double begin() const { return begin_; }    // the x of u = -1
  double middle() const { return middle_; }  // the x of u = 0
  double end() const { return end_; }        // the x of u = 1
  double distance(double x) const;           // from the axis: the sine of the angle
  V3d source(double x) const;                // unit vector along R, Theta, Phi
  V3d across(double x) const;                // unit vector from the axis towards the source

  // Returns the integral of weight/distance over u between two x, which lie on one side of the
  // middle.
  double mean_inverse_distance(double from, double to) const;
  // A Way holds what a loop needs to compute this integral for many pieces of the path.
  struct Way {
    double u_least, u_per_sinh;  // u = u_least + u_per_sinh sinh(x)
    double sharpness, factor;    // of the weight, (sharpness + 1)/2/half_way
    V3d outward, along;          // across(x) = (outward + along sinh(x))/cosh(x)
  };
  Way way() const {
    return {u_least_, least_ / half_way_, sharpness_, (sharpness_ + 1) / 2 / half_way_, outward_,
            along_};
  }
  // Returns an upper bound of this integral over the whole path.  The weight is at most
  // (sharpness + 1)/2, and du/distance = dx/half_way.
  double most_inverse_distance() const {
    return (sharpness_ + 1) / 2 * (end_ - begin_) / half_way_;
  }

 private:
  double u(double x) const;

  double side_;      // the sign of the source's component along R
  double least_;     // distance from the axis at x = 0
  double half_way_;  // the length of the path from u = 0 to u = 1
  double sharpness_;
  double u_least_;       // u at x = 0
  V3d outward_, along_;  // unit vectors across R: from the axis to x = 0, and along the path
  double begin_, middle_, end_;
};

// A StarTrail is the image of one order of a source on its path near the axis.  It is made of
// parts, from one end of the trail to the other, between places where the lens was evaluated.  The
// amplification of a part is what the part adds to the mean.
class StarTrail {
 public:
  // The function returns the image of a source, without a blur.
  using ImageOf = std::function<SkyImage(const V3d& source)>;
  StarTrail(const ImageOf& image_of, const AxisPassage& passage);

  std::size_t parts() const { return nodes_.size() - 1; }
  // Returns the light of a part, as if all of it came from the middle of the part.
  SkyImage part(std::size_t k) const;
  // Returns the direction in which part k begins.  With k = parts() it is the direction in which
  // the last part ends.
  const V3d& begin(std::size_t k) const { return nodes_[k].direction; }
  // Appends part k in `pieces` pieces, between 1 and kMostPieces.  Their lengths differ by a tenth.
  void split(std::size_t k, int pieces, std::vector<SkyImage>& images) const;

  // Stores pieces of a star of unit flux and temperature, as a camera receives them after a boost.
  // The camera's axes are the columns of the matrix.  Of the `pieces` that split() makes of part k,
  // `count` from `first` on become the views from `at` on.  The loop becomes SIMD code.
  void store(std::size_t k, int pieces, int first, int count, const Aberration& boost,
             const M33d& camera, StarViews& views, int at) const;

  static constexpr int kMostPieces = 4096;

 private:
  // A Node is the image of the source at one place of its path.  Its direction has one component
  // along R, and one along passage_.across(x).  Only these components are interpolated.  The vector
  // across(x), which turns around the ring, is known for any x.
  struct Node {
    double x;
    V3d direction;
    double across;
    double frequency_ratio;
    double strength;  // amplification times the distance from the axis, which is finite on it
  };
  void add_nodes(const ImageOf& image_of, double from, double to);
  Node node_at(const ImageOf& image_of, double x) const;
  SkyImage between(std::size_t k, double x) const;
  // These return the first of the nodes by which part k is interpolated, and the number of them.
  std::size_t first_around(std::size_t k) const;
  std::size_t count_around() const { return std::min<std::size_t>(4, nodes_.size()); }

  AxisPassage passage_;
  std::vector<Node> nodes_;
};

}  // namespace domefall
