#include "pipeline/light/einstein_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/lens_curve.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kMostPieces = 4096;
// The light of a disc is summed over this number of chords.  The sum converges fast, but slowly
// where the axis lies within the disc or near its rim.
constexpr int kChords = 8, kChordsAtRim = 64;
constexpr double kAtRim = 1.5;  // the distance, in radii, up to which there are more chords

// A StarDisc is the disc in polar coordinates about the axis.  It is small enough to be flat.
class StarDisc {
 public:
  StarDisc(double from_axis, double radius)
      : from_axis_(from_axis),
        radius_(radius),
        drawn_part_(std::clamp((kPoint - from_axis / radius) / (kPoint - 1), 0.0, 1.0)) {}

  bool is_ring() const { return from_axis_ < radius_; }
  bool is_at_rim() const { return from_axis_ < kAtRim * radius_; }
  // Returns an upper bound of the angle about the axis over which the image is drawn.
  double extent() const { return drawn_part_ * (is_ring() ? 2 * pi : pi * radius_ / from_axis_); }

  struct Chord {
    double azimuth;    // about the axis, against the disc's middle; where the chord is drawn
    double near, far;  // distances of its ends from the axis
    double width;      // in azimuth
  };
  // Returns the k-th of `count` chords, which lie on lines through the axis.  Where the axis lies
  // in the disc, they are evenly spaced in azimuth.  Otherwise they are evenly spaced in tau, with
  // sin(azimuth) = radius/from_axis sin(tau).  Half a chord is then radius cos(tau) long, which is
  // smooth up to the rim.
  Chord chord(int k, int count) const {
    const double share = (k + 0.5) / count;
    if (is_ring()) {
      const double azimuth = 2 * pi * share - pi, across = from_axis_ * std::sin(azimuth);
      const double half = std::sqrt(radius_ * radius_ - across * across);
      return {azimuth, 0, from_axis_ * std::cos(azimuth) + half, 2 * pi / count};
    }
    const double tau = pi * share - pi / 2, s = radius_ / from_axis_ * std::sin(tau);
    const double c = std::sqrt((1 - s) * (1 + s)), half = radius_ * std::cos(tau);
    return {drawn_part_ * std::asin(s), std::max(0.0, from_axis_ * c - half), from_axis_ * c + half,
            radius_ / from_axis_ * std::cos(tau) / c * pi / count};
  }

 private:
  static constexpr double kPoint = 3;  // the distance, in radii, from which on arcs are points

  double from_axis_, radius_;
  double drawn_part_;  // of the arc's length
};

// A Caustic is one order of the images of the sky about the axis, on the source's side of the
// observer.
class Caustic {
 public:
  Caustic(const SkyTable& table, const V3d& source, int order)
      : table_(table), frame_(psi_frame(table)), side_(order % 2 == 0 ? 1 : -1) {
    const bool below = source.x < 0, even = order % 2 == 0;
    // Light of even order k sweeps k pi + phi_star, and that of odd order (k + 1) pi - phi_star, as
    // lens_curve.h has it.  Here phi_star is near pi for a source below and near 0 for one above.
    axis_ = pi * (order + (below == even ? 1 : 0));
    sign_ = below == even ? -1 : 1;
    const double sine = std::hypot(source.y, source.z);
    if (sine > 0) across_ = V3d(0, source.y, source.z) / sine;
  }

  // Returns the x of SkyTable for light that starts at the angle from_axis from the axis.
  double distance(double from_axis) const { return table_.distance(axis_ + sign_ * from_axis); }

  // Returns the image of a chord, with its solid angle in place of the amplification.  This is the
  // width times the difference of cos(psi) between the chord's ends.  With psi = psi_0 - 4
  // atan(x/2), and with atan(x/2) = a and b at the ends, the difference is 2 sin(psi_0 - 2 (a + b))
  // sin(2 |a - b|).
  SkyImage image(const StarDisc::Chord& chord) const {
    const double a = std::atan(distance(chord.near) / 2), b = std::atan(distance(chord.far) / 2);
    const ZoneRay ray = table_.ray_at_distance(2 * std::tan((a + b) / 2));
    const double psi = 4 * std::atan(table_.x_max() / 2) - 2 * (a + b);
    SkyImage image;
    image.amplification = 2 * std::sin(psi) * std::sin(2 * std::abs(a - b)) * chord.width;
    image.frequency_ratio = 1 / ray.one_plus_z;
    image.direction = direction(psi, chord.azimuth);
    return image;
  }

  // Returns the direction at the angle psi from the sky's far end and this azimuth about the axis.
  TetradDirection direction(double psi, double azimuth) const {
    const V3d left(0, -across_.z, across_.y);
    const V3d e = (across_ * std::cos(azimuth) + left * std::sin(azimuth)) * side_;
    return {V3d(frame_.outward * std::cos(psi), 0, 0) + e * std::sin(psi)};
  }

  double psi(double from_axis) const {
    return 4 * (std::atan(table_.x_max() / 2) - std::atan(distance(from_axis) / 2));
  }

 private:
  const SkyTable& table_;
  PsiFrame frame_;
  double side_;          // 1 if the images are on the source's side of the hole, else -1
  double axis_, sign_;   // light from the distance d off the axis sweeps axis_ + sign_ * d
  V3d across_{0, 1, 0};  // the direction from the axis to the source, across the axis
};

// Returns the number of pieces of the arc, which have the least spacing found along it.
int pieces(const Caustic& caustic, const StarDisc& disc, double from_axis,
           const std::function<double(const V3d&)>& spacing) {
  constexpr int kSamples = 16;
  const double psi = caustic.psi(from_axis), length = disc.extent() * std::sin(psi);
  double least = HUGE_VAL;
  for (int k = 0; k < kSamples; ++k) {
    const double azimuth = disc.extent() * ((k + 0.5) / kSamples - 0.5);
    least = std::min(least, spacing(caustic.direction(psi, azimuth).v));
  }
  const double count = std::ceil(length / least);
  return count < kMostPieces ? std::max(1, static_cast<int>(count)) : kMostPieces;
}

// A Piece joins several neighbouring chords to one image, in the middle of their light.
class Piece {
 public:
  void add(const SkyImage& image) {
    light_ += image.amplification;
    direction_ += image.direction.v * image.amplification;
    // The light is proportional to the fourth power of the frequency ratio.  The mean of this power
    // is kept.
    const double g2 = image.frequency_ratio * image.frequency_ratio;
    fourth_ += image.amplification * g2 * g2;
  }
  SkyImage image(double disc_angle) const {
    return {{direction_.normalized()}, std::sqrt(std::sqrt(fourth_ / light_)), light_ / disc_angle};
  }
  bool lit() const { return light_ > 0; }

 private:
  double light_ = 0, fourth_ = 0;
  V3d direction_{0, 0, 0};
};

// Lets the light of an arc fall towards its ends by (1 - t^2)^(kTaper part), where t goes from -1
// to 1 along the arc, and keeps the sum.  An even disc ends so abruptly that a bright arc would
// seem cut off.
void taper(double part, std::vector<SkyImage>& arc) {
  constexpr double kTaper = 6;
  const auto count = static_cast<double>(arc.size());
  double before = 0, after = 0;
  for (std::size_t k = 0; k < arc.size(); ++k) {
    const double t = (2 * static_cast<double>(k) + 1) / count - 1;
    before += arc[k].amplification;
    arc[k].amplification *= std::pow((1 - t) * (1 + t), kTaper * part);
    after += arc[k].amplification;
  }
  for (SkyImage& image : arc) image.amplification *= before / after;
}

}  // namespace

std::vector<SkyImage> arc_of(const SkyTable& table, const V3d& source, int order, double radius,
                             const std::function<double(const V3d&)>& spacing) {
  const double from_axis = std::hypot(source.y, source.z);
  const Caustic caustic(table, source, order);
  const StarDisc disc(from_axis, radius);
  const int count = pieces(caustic, disc, from_axis, spacing);
  const int chords = disc.is_at_rim() ? kChordsAtRim : kChords, each = (chords + count - 1) / count;
  std::vector<SkyImage> arc;
  for (int p = 0; p < count; ++p) {
    Piece piece;
    for (int k = p * each; k < (p + 1) * each; ++k)
      piece.add(caustic.image(disc.chord(k, count * each)));
    if (piece.lit()) arc.push_back(piece.image(pi * radius * radius));
  }
  if (!disc.is_ring()) taper(std::min(1.0, from_axis / radius - 1), arc);
  return arc;
}

}  // namespace domefall
