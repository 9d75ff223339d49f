#include "pipeline/light/sphere_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kMostPieces = 4096;
// The light of a disc is the sum over so many chords at least.
constexpr int kChords = 16;

// A Sphere is described in planes of the axis, each by its unit vector e across.
//
// Near the axis the light of plane e that is received at one instant was emitted the later the
// farther along e, so that a body which moves across is seen at another place in each plane.  With
// its place p0 at the time at which the light of the axis left, and with the frequency nu(e) that it
// emits, which is nu(0) + swing.e, that place is
//
//     p = p0 - swing (e.p0)/nu(e),
//
// since |swing| is nu(0) times how much farther the body gets for each step along it.  Both orders
// that meet in a ring have the same p0, and each has the half of the planes on its side of it.
class Sphere {
 public:
  Sphere(const BodyImage& image, double radius)
      : image_(image),
        radius_(radius),
        axis_(pi * std::round(image.psi / pi)),
        angle_(std::atan2(image.direction.dot(image.across), -image.direction.x)),
        on_axis_(1 / image.frequency_ratio - image.swing.dot(image.across)) {
    const double own = image.r * std::sin(image.psi);
    const V3d place = (image.across + image.swing / on_axis_) * own;
    from_axis_ = place.length();
    across_ = from_axis_ > 0 ? place / std::copysign(from_axis_, own) : image.across;
    beside_ = V3d(0, -across_.z, across_.y);
    farther_ = own == 0 ? 1 : from_axis_ / std::abs(own);
    widest_ = (azimuth(pi / 2) - azimuth(-pi / 2)) / 2;
  }

  double angle() const { return angle_; }
  double widest() const { return widest_; }
  double half_length() const { return image_.angle_per_length * radius_; }

  // Returns the azimuth about the axis that goes with tau from -pi/2 to pi/2.  Where the axis is
  // far, half a chord is radius cos(tau) long, which is smooth up to the rim.
  double azimuth(double tau) const {
    if (from_axis_ <= radius_) return tau;
    // This is beside(azimuth) = radius sin(tau), solved.
    const double part = radius_ / from_axis_ * std::sin(tau),
                 s = on_axis_ - part * image_.swing.dot(beside_),
                 c = part * image_.swing.dot(across_);
    const double sine = (part * on_axis_ - image_.swing.dot(beside_)) / std::hypot(s, c);
    // Rounding may exceed 1 where the rim touches the axis.
    return std::asin(std::clamp(sine, -1.0, 1.0)) + std::atan2(c, s);
  }
  // These are the angle from the hole of the middle of a chord, and half of the angle that it
  // covers.
  double middle(double azimuth) const {
    const double along = farther_ * std::cos(azimuth) * on_axis_ / emitted(e(azimuth));
    const double psi = axis_ + std::atan(std::tan(image_.psi - axis_) * along);
    return angle_ + image_.angle_per_psi * (psi - image_.psi);
  }
  double half(double azimuth) const {
    const double off = beside(azimuth);
    return image_.angle_per_length * std::sqrt(std::max(0.0, (radius_ - off) * (radius_ + off)));
  }

  V3d direction(double azimuth, double angle) const {
    return e(azimuth) * std::sin(angle) - V3d(std::cos(angle), 0, 0);
  }
  // Returns the distance from the middle of the disc to that of a chord, in radii.
  double off(double azimuth) const { return beside(azimuth) / radius_; }
  // Returns the part of a chord between two shares of its half from its middle.  `footprint` is how
  // much of the disc is seen within the spacing of pieces, in radii.
  SpherePiece piece(double azimuth, double from, double to, double footprint) const {
    const V3d across = e(azimuth), towards = leaving_in(image_, across);
    // The disc is seen along b1, and the plane of the chord is at right angles to m.
    V3d m = contracted(V3d(1, 0, 0).cross(across));
    m = (m - towards * m.dot(towards)).normalized();
    const double h = off(azimuth), c = std::sqrt(std::max(0.0, (1 - h) * (1 + h))),
                 s = (from + to) / 2, up = std::sqrt((1 - s) * (1 + s));
    const auto area = [](double x) {
      return (x * std::sqrt((1 - x) * (1 + x)) + std::asin(x)) / 2;
    };
    const double cosine = c * (area(to) - area(from)) / (to - from);
    return {{{direction(azimuth, middle(azimuth) + half(azimuth) * s)}, 1 / emitted(across), 0},
            cosine,
            m * h + (towards * up + m.cross(towards) * s) * c,
            footprint / cosine};
  }

 private:
  V3d e(double azimuth) const { return across_ * std::cos(azimuth) + beside_ * std::sin(azimuth); }
  double emitted(const V3d& e) const { return on_axis_ + image_.swing.dot(e); }
  double beside(double azimuth) const {  // of the chord, from the middle of the disc
    const double off = from_axis_ * (on_axis_ * std::sin(azimuth) + image_.swing.dot(beside_)) /
                       emitted(e(azimuth));
    return std::clamp(off, -radius_, radius_);
  }
  V3d contracted(const V3d& v) const {
    const double gamma = std::hypot(1, image_.celerity.length());
    return v - image_.celerity * (image_.celerity.dot(v) / (gamma * (gamma + 1)));
  }

  const BodyImage& image_;
  double radius_;
  double axis_;          // psi of the axis that is next to the image
  double angle_;         // of the image from the hole
  double on_axis_;       // nu(0)
  double from_axis_;     // |p0|, M
  double farther_;       // |p0| over the distance from the axis at which the image is seen
  V3d across_, beside_;  // azimuths 0 and pi/2: the plane of p0, on the side of the image
  double widest_;        // half of the azimuths that the image covers
};

int count_of(double length, double spacing, int least) {
  return static_cast<int>(
      std::clamp(std::ceil(length / spacing), double(least), double(kMostPieces)));
}

}  // namespace

double area_up_to(double x) {
  const double half = std::sin(x / 2);
  if (x < 0) return -2 * half * half;
  if (x > pi) return 4 - 2 * half * half;
  return 2 * half * half;
}

V3d leaving_in(const BodyImage& image, const V3d& e) {
  // The ray is turned about R from its own plane.
  const V3d& k = image.ray;
  const V3d axis(1, 0, 0), turned = axis * k.x + e * image.across.dot(k), &u = image.celerity;
  const double gamma = std::hypot(1, u.length());
  return (turned + u * (turned.dot(u) / (gamma + 1) - 1)).normalized();
}

double size_of_sphere(const BodyImage& image, double radius) {
  const Sphere sphere(image, radius);
  return 2 * std::max(sphere.half_length(), sphere.widest() * std::abs(std::sin(sphere.angle())));
}

std::vector<SpherePiece> image_of_sphere(const BodyImage& image, double radius,
                                         const std::function<double(const V3d&)>& spacing) {
  const Sphere sphere(image, radius);
  const double low = sphere.angle() - sphere.half_length(),
               high = sphere.angle() + sphere.half_length();
  const bool is_side = low < pi / 2 && high > pi / 2;
  const double girth = is_side ? 1 : std::max(std::abs(std::sin(low)), std::abs(std::sin(high)));
  const int chords = count_of(pi * sphere.widest() * girth, spacing(image.direction), kChords);
  std::vector<SpherePiece> pieces;
  for (int k = 0; k < chords; ++k) {
    const auto at = [&](double share) { return sphere.azimuth(pi * (share / chords - 0.5)); };
    const double first = at(k), last = at(k + 1), width = last - first, azimuth = at(k + 0.5);
    const double middle = sphere.middle(azimuth), half = sphere.half(azimuth);
    const double apart = spacing(sphere.direction(azimuth, middle)),
                 thick = width * std::abs(std::sin(middle)),
                 footprint =
                     apart * std::max(std::abs(sphere.off(last) - sphere.off(first)) / thick,
                                      1 / sphere.half_length());
    const int parts = count_of(2 * half, apart, 1);
    for (int j = 0; j < parts; ++j) {
      const double from = 2.0 * j / parts - 1, to = 2.0 * (j + 1) / parts - 1;
      const auto area = [&](double share) {
        return area_up_to(std::clamp(middle + half * share, -pi, 2 * pi));
      };
      const double solid_angle = width * (area(to) - area(from));
      if (!(solid_angle > 0)) continue;
      pieces.push_back(sphere.piece(azimuth, from, to, footprint));
      pieces.back().at.amplification = solid_angle;
    }
  }
  return pieces;
}

}  // namespace domefall
