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

class Sphere {
 public:
  Sphere(const BodyImage& image, double radius)
      : image_(image),
        radius_(radius),
        axis_(pi * std::round(image.psi / pi)),
        from_axis_(std::abs(image.r * std::sin(image.psi))),
        angle_(std::atan2(image.direction.dot(image.across), -image.direction.x)),
        widest_(from_axis_ > radius ? std::asin(radius / from_axis_) : pi / 2) {}

  double angle() const { return angle_; }
  double widest() const { return widest_; }
  double half_length() const { return image_.angle_per_length * radius_; }

  // Returns the azimuth about the axis, from the plane of the image, that goes with tau from -pi/2
  // to pi/2.  Where the axis is far, half a chord is about radius cos(tau) long, which is smooth up
  // to the rim.
  double azimuth(double tau) const {
    return from_axis_ > radius_ ? std::asin(radius_ / from_axis_ * std::sin(tau)) : tau;
  }
  // These are the angle from the hole of the middle of a chord, and half of the angle that it
  // covers.
  double middle(double azimuth) const {
    const double psi = axis_ + std::atan(std::tan(image_.psi - axis_) * std::cos(azimuth));
    return angle_ + image_.angle_per_psi * (psi - image_.psi);
  }
  double half(double azimuth) const {
    const double beside = from_axis_ * std::sin(azimuth);
    return image_.angle_per_length *
           std::sqrt(std::max(0.0, (radius_ - beside) * (radius_ + beside)));
  }

  SkyImage piece(double azimuth, double angle, double solid_angle) const {
    const V3d& a = image_.across;
    const V3d e = a * std::cos(azimuth) + V3d(0, -a.z, a.y) * std::sin(azimuth);
    const double emitted = 1 / image_.frequency_ratio + image_.swing.dot(e - a);
    return {{e * std::sin(angle) - V3d(std::cos(angle), 0, 0)}, 1 / emitted, solid_angle};
  }

 private:
  const BodyImage& image_;
  double radius_;
  double axis_;       // psi of the axis that is next to the image
  double from_axis_;  // M
  double angle_;      // of the image from the hole
  double widest_;     // azimuth that the image reaches
};

// Returns the integral of |sin x| up to x, between -pi and 2 pi.
double area_up_to(double x) {
  const double half = std::sin(x / 2);
  if (x < 0) return -2 * half * half;
  if (x > pi) return 4 - 2 * half * half;
  return 2 * half * half;
}

int count_of(double length, double spacing, int least) {
  return static_cast<int>(
      std::clamp(std::ceil(length / spacing), double(least), double(kMostPieces)));
}

}  // namespace

double size_of_sphere(const BodyImage& image, double radius) {
  const Sphere sphere(image, radius);
  return 2 * std::max(sphere.half_length(), sphere.widest() * std::abs(std::sin(sphere.angle())));
}

std::vector<SkyImage> image_of_sphere(const BodyImage& image, double radius,
                                      const std::function<double(const V3d&)>& spacing) {
  const Sphere sphere(image, radius);
  const double low = sphere.angle() - sphere.half_length(),
               high = sphere.angle() + sphere.half_length();
  const bool is_side = low < pi / 2 && high > pi / 2;
  const double girth = is_side ? 1 : std::max(std::abs(std::sin(low)), std::abs(std::sin(high)));
  const int chords = count_of(pi * sphere.widest() * girth, spacing(image.direction), kChords);
  std::vector<SkyImage> pieces;
  for (int k = 0; k < chords; ++k) {
    const auto tau = [&](double share) { return pi * (share / chords - 0.5); };
    const double width = sphere.azimuth(tau(k + 1)) - sphere.azimuth(tau(k));
    const double azimuth = sphere.azimuth(tau(k + 0.5));
    const double middle = sphere.middle(azimuth), half = sphere.half(azimuth);
    const V3d direction = sphere.piece(azimuth, middle, 0).direction.v;
    const int parts = count_of(2 * half, spacing(direction), 1);
    for (int j = 0; j < parts; ++j) {
      const auto angle = [&](double share) {
        return std::clamp(middle + half * (2 * share / parts - 1), -pi, 2 * pi);
      };
      const double solid_angle = width * (area_up_to(angle(j + 1)) - area_up_to(angle(j)));
      if (solid_angle > 0) pieces.push_back(sphere.piece(azimuth, angle(j + 0.5), solid_angle));
    }
  }
  return pieces;
}

}  // namespace domefall
