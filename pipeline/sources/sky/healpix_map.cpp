#include "pipeline/sources/sky/healpix_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/colour/colour_space.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kLargestFaceOfHealpix = 4096;

// Returns the number made of every other bit, from the lowest on.  A pixel's number in NESTED order
// interleaves the bits of its coordinates x and y in this way.
long every_other_bit(long bits) {
  long out = 0;
  for (int k = 0; bits >> (2 * k) != 0; ++k) out |= ((bits >> (2 * k)) & 1) << k;
  return out;
}

double mean_temperature(const CmbSettings& cmb) { return kCmbTemperature * cmb.redshift; }

// Returns the factor that thins the radiance of a full surface to the luminance of the settings.
double thinning(const CmbSettings& cmb) {
  return cmb.luminance / luminance(blackbody_colours().surface(mean_temperature(cmb)));
}

// The second channel of a thermal map is the radiance times this (SkyMapKind::kThermal).
double theta(double temperature) { return std::log2(temperature / kThermalBase); }

M33d frame_from_equatorial(SkyFrame frame) {
  Orientation o;
  o.frame = frame;
  return panorama_from_equatorial(o);
}

// Returns the number of samples along the side of a texel.  A level that is coarser than the map
// takes several, whose mean is the texel.
int samples_across(const HealpixMap& map, const SkyPyramid::Level& level) {
  return std::max(healpix_face(map.nside()) / level.size, 1);
}

}  // namespace

// Gorski et al. 2005, sec. 5.2, numbers the pixels like this.  The southern corner of a base pixel
// has the coordinates (0, 0), from which x grows to the north-east and y to the north-west.  The
// corner is kRing/4 of the way to the south pole and kEast eighths of a turn from longitude 0.
long ring_from_nested(int nside, long pixel) {
  static constexpr std::array<int, 12> kRing{2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4};
  static constexpr std::array<int, 12> kEast{1, 3, 5, 7, 0, 2, 4, 6, 1, 3, 5, 7};
  const long n = nside, base = pixel / (n * n), inside = pixel % (n * n);
  const long x = every_other_bit(inside), y = every_other_bit(inside >> 1);
  const long ring = kRing[static_cast<std::size_t>(base)] * n - x - y - 1;
  const long north = std::min(ring, 4 * n - ring), length = 4 * std::min(north, n);
  const long shifted = north >= n && (ring - n) % 2 != 0 ? 0 : 1;
  // The rings of a polar cap have 4, 8, ... pixels, so that 2 ring (ring - 1) pixels lie north of
  // ring number `ring`.
  const long before = ring < n        ? 2 * ring * (ring - 1)
                      : ring <= 3 * n ? 2 * n * (n - 1) + (ring - n) * 4 * n
                                      : 12 * n * n - 2 * north * (north + 1);
  // This is twice the pixel's number along the ring, which is 1 for the first pixel.
  const long east = kEast[static_cast<std::size_t>(base)] * (length / 4) + x - y + 2 - shifted;
  return before + (east / 2 - 1 + length) % length;
}

HealpixMap::HealpixMap(HealpixFile file, float missing) : file_(std::move(file)) {
  for (float& v : file_.values)
    if (std::isnan(v)) v = missing;
  if (!file_.nested) return;
  std::vector<float> rings(file_.values.size());
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const long at = ring_from_nested(file_.nside, static_cast<long>(k));
    rings[static_cast<std::size_t>(at)] = file_.values[k];
  }
  file_.values = std::move(rings);
  file_.nested = false;
}

// Gorski et al. 2005, sec. 5.1, places the rings like this.  Those of the polar caps have 4, 8, ...
// pixels and are all shifted by half a pixel.  Those between have 4 nside pixels, and every other
// one is shifted.
HealpixMap::Ring HealpixMap::ring(long number) const {
  const long n = file_.nside, north = std::min(number, 4 * n - number);
  const auto nn = static_cast<double>(n);
  if (north >= n)
    return {2 * n * (n - 1) + (number - n) * 4 * n, 4 * n,
            std::acos(static_cast<double>(2 * n - number) * 2 / (3 * nn)),
            (number - n) % 2 == 0 ? 0.5 : 0.0};
  const auto k = static_cast<double>(north);
  // The ring has 1 - cos(theta) = k^2/(3 n^2).  This is 2 sin^2(theta/2).  An arcsine keeps its
  // digits near the pole, where an arccosine would lose them.
  const double theta = 2 * std::asin(k / (nn * std::sqrt(6.0)));
  if (number == north) return {2 * north * (north - 1), 4 * north, theta, 0.5};
  return {12 * n * n - 2 * north * (north + 1), 4 * north, pi - theta, 0.5};
}

double HealpixMap::on_ring(const Ring& r, double phi) const {
  // `at` counts pixels from the centre of the ring's first one, which is `shift` pixels east of
  // longitude 0.  It may be negative, so that `count` is added before the remainder is taken.
  const double at = phi / (2 * pi) * static_cast<double>(r.count) - r.shift;
  const double low = std::floor(at);
  const long k = (static_cast<long>(low) + r.count) % r.count;
  const double a = file_.values[static_cast<std::size_t>(r.first + k)],
               b = file_.values[static_cast<std::size_t>(r.first + (k + 1) % r.count)];
  return a + (at - low) * (b - a);
}

double HealpixMap::pole(std::size_t first) const {
  // The first and the last ring have four pixels each.
  const float* v = &file_.values[first];
  return (static_cast<double>(v[0]) + v[1] + v[2] + v[3]) / 4;
}

// Returns the last ring at or north of a place, or 0 if the place is north of the first ring.
long HealpixMap::ring_above(double z, double across) const {
  // The formulas for z of a ring are solved for its number.  from_pole is 1 - |z| without
  // cancellation.  Between the caps z = 2 (2 - ring/n)/3, and in a cap 1 - |z| = ring^2/(3 n^2),
  // with rings counted from its pole.
  const double n = file_.nside, from_pole = across * across / (1 + std::abs(z));
  if (std::abs(z) <= 2.0 / 3) return static_cast<long>(n * (2 - 1.5 * z));
  const auto north = static_cast<long>(n * std::sqrt(3 * from_pole));
  return z > 0 ? north : 4L * file_.nside - north - 1;
}

double HealpixMap::at(const V3d& direction) const {
  const V3d d = direction.normalized();
  const double across = std::hypot(d.x, d.y), theta = std::atan2(across, d.z);
  double phi = std::atan2(d.y, d.x);
  if (phi < 0) phi += 2 * pi;
  const long last = 4L * file_.nside - 1, above = ring_above(d.z, across);
  double from = 0, to = pi, a = 0, b = 0;
  if (above >= 1) {
    const Ring r = ring(above);
    from = r.theta;
    a = on_ring(r, phi);
  } else {
    a = pole(0);
  }
  if (above < last) {
    const Ring r = ring(above + 1);
    to = r.theta;
    b = on_ring(r, phi);
  } else {
    b = pole(file_.values.size() - 4);
  }
  // If a place is on a ring, rounding may have found the ring beside it.
  return a + std::clamp((theta - from) / (to - from), 0.0, 1.0) * (b - a);
}

// A pixel is as wide as a square of sqrt(pi/3)/nside radians, or 58.6 degrees/nside.  That is 2.6
// texels of 90 degrees/(4 nside).
int healpix_face(int nside) { return std::clamp(4 * nside, 4, kLargestFaceOfHealpix); }

double healpix_unit(const HealpixMap& map, double luminance) {
  return sky_unit(luminance * std::max(0.0f, *std::ranges::max_element(map.values())));
}

void paint_healpix(const HealpixMap& map, SkyFrame frame, double luminance,
                   const SkyPyramid& pyramid) {
  const M33d turn = frame_from_equatorial(frame);
  const double scale = luminance / pyramid.unit;
  const ColourMatrix& m = working_from_rec709();
  const auto painter = [&](const V3d& d, float* channel) {
    // Equal red, green and blue of Rec. 709 are the grey of D65, which becomes a row's sum here.
    const double grey = std::max(map.at(apply(turn, d)), 0.0) * scale;
    for (int k = 0; k < 3; ++k)
      channel[k] = static_cast<float>(grey * (m[k][0] + m[k][1] + m[k][2]));
  };
  paint(pyramid.levels[0], painter, samples_across(map, pyramid.levels[0]));
}

double cmb_unit(const CmbSettings& cmb) {
  const double hottest = mean_temperature(cmb) * (1 + kCmbLargest);
  // The greater of the two channels of the hottest texel decides.
  const double radiance = thinning(cmb) * blackbody_radiance(hottest);
  return sky_unit(radiance * std::max(1.0, theta(hottest)));
}

void paint_cmb(const HealpixMap& map, SkyFrame frame, const CmbSettings& cmb,
               const SkyPyramid& pyramid) {
  const M33d turn = frame_from_equatorial(frame);
  const double scale = thinning(cmb) / pyramid.unit, mean = mean_temperature(cmb);
  // The map's value times this is contrast dT/2.725 K.
  const double amplified = cmb.contrast * cmb.kelvin / kCmbTemperature;
  const auto painter = [&](const V3d& d, float* channel) {
    // The cut keeps T above 0 and below the hottest place, for which cmb_unit() leaves room.
    const double part = std::clamp(amplified * map.at(apply(turn, d)), -kCmbLargest, kCmbLargest);
    const double t = mean * (1 + part), radiance = scale * blackbody_radiance(t);
    channel[0] = static_cast<float>(radiance);
    channel[1] = static_cast<float>(radiance * theta(t));
  };
  paint(pyramid.levels[0], painter, samples_across(map, pyramid.levels[0]));
}

}  // namespace domefall
