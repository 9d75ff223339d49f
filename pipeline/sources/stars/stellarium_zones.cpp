#include "pipeline/sources/stars/stellarium_zones.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "trajectories/equatorial.h"

namespace domefall {
namespace {

using Triangle = std::array<V3d, 3>;

V3d unit(const V3d& v) { return v / std::sqrt(v.dot(v)); }

// Returns the faces of an icosahedron.  Corners and faces have the order of the files, which number
// their zones by it.
std::vector<Triangle> icosahedron() {
  // The corners of an icosahedron lie at (0, +-1, +-golden ratio) and its cyclic permutations.
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  const double b = 1 / std::sqrt(1 + golden * golden), a = b * golden;
  const std::array<V3d, 12> corners{V3d(a, -b, 0), V3d(a, b, 0), V3d(-a, b, 0), V3d(-a, -b, 0),
                                    V3d(0, a, -b), V3d(0, a, b), V3d(0, -a, b), V3d(0, -a, -b),
                                    V3d(-b, 0, a), V3d(b, 0, a), V3d(b, 0, -a), V3d(-b, 0, -a)};
  constexpr std::array<std::array<int, 3>, 20> kFaces{
      {{1, 0, 10}, {0, 1, 9},   {0, 9, 6},  {9, 8, 6},  {0, 7, 10}, {6, 7, 0},   {7, 6, 3},
       {6, 8, 3},  {11, 10, 7}, {7, 3, 11}, {3, 2, 11}, {2, 3, 8},  {10, 11, 4}, {2, 4, 11},
       {5, 4, 2},  {2, 8, 5},   {4, 1, 10}, {4, 5, 1},  {5, 9, 1},  {8, 9, 5}}};
  std::vector<Triangle> triangles;
  triangles.reserve(kFaces.size());
  for (const auto& face : kFaces)
    triangles.push_back({corners[static_cast<std::size_t>(face[0])],
                         corners[static_cast<std::size_t>(face[1])],
                         corners[static_cast<std::size_t>(face[2])]});
  return triangles;
}

// Cuts each triangle into the three at its corners and the one in the middle, in the files' order.
std::vector<Triangle> cut(const std::vector<Triangle>& triangles) {
  std::vector<Triangle> smaller;
  smaller.reserve(4 * triangles.size());
  for (const auto& [c0, c1, c2] : triangles) {
    const V3d e0 = unit(c1 + c2), e1 = unit(c2 + c0), e2 = unit(c0 + c1);
    smaller.push_back({c0, e2, e1});
    smaller.push_back({e2, c1, e0});
    smaller.push_back({e1, e0, c2});
    smaller.push_back({e0, e1, e2});
  }
  return smaller;
}

// Returns a number of a record, which need not be aligned in the file.
template <class Number>
Number number_at(const char* bytes, std::size_t offset) {
  Number value;
  std::memcpy(&value, bytes + offset, sizeof value);
  return value;
}

// Returns the whole number of three bytes, of which the first is the least significant.
std::uint32_t three_bytes(const char* bytes) {
  const auto byte = [&](int k) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k]));
  };
  return byte(0) | byte(1) << 8 | byte(2) << 16;
}

constexpr double kDegreesPerMas = 1 / 3.6e6, kMicro = 1e-3, kMilli = 1e-3;

// A declination beyond the poles gives no direction.
SkyDirection place(double ra_deg, double dec_deg) {
  return std::abs(dec_deg) <= 90 ? sky_direction(ra_deg, dec_deg) : SkyDirection{V3d(0)};
}

// A star of type 0 has place and motion as vectors.  The place is in units of 2^-31 or so, and the
// motion in thousandths of a mas a year.  The five lowest bits before the Hipparcos number are
// those of a component.
CatalogueStar gaia_bright(const char* bytes) {
  constexpr double kUnit = 2e9;
  const auto vector = [&](std::size_t offset) {
    return V3d(number_at<std::int32_t>(bytes, offset), number_at<std::int32_t>(bytes, offset + 4),
               number_at<std::int32_t>(bytes, offset + 8));
  };
  CatalogueStar star;
  const V3d at = vector(8) / kUnit, motion = vector(20) * kMicro;
  const double length = std::sqrt(at.dot(at)), rho = std::hypot(at.x, at.y);
  star.direction = {at / length};
  // East and north are those of moved().
  const V3d& p = star.direction.v;
  const double c = rho > 0 ? at.x / rho : 1, s = rho > 0 ? at.y / rho : 0;
  star.pm_ra = static_cast<float>(motion.y * c - motion.x * s);
  star.pm_dec = static_cast<float>(motion.z * rho / length - p.z * (motion.x * c + motion.y * s));
  star.colour = colour_of_b_v(kMilli * number_at<std::int16_t>(bytes, 32));
  star.v = static_cast<float>(kMilli * number_at<std::int16_t>(bytes, 34));
  star.hip = three_bytes(bytes + 45) >> 5;
  return star;
}

// A star of type 1 has RA and Dec in mas and the motions in thousandths of a mas a year.  That in
// RA is not multiplied by cos Dec.
CatalogueStar gaia_faint(const char* bytes) {
  CatalogueStar star;
  const double dec = kDegreesPerMas * number_at<std::int32_t>(bytes, 12);
  star.direction = place(kDegreesPerMas * number_at<std::int32_t>(bytes, 8), dec);
  star.pm_ra = static_cast<float>(kMicro * number_at<std::int32_t>(bytes, 16) *
                                  std::cos(dec * std::numbers::pi / 180));
  star.pm_dec = static_cast<float>(kMicro * number_at<std::int32_t>(bytes, 20));
  star.colour = colour_of_b_v(kMilli * number_at<std::int16_t>(bytes, 24));
  star.v = static_cast<float>(kMilli * number_at<std::int16_t>(bytes, 26));
  return star;
}

// A star of type 2 has RA and Dec + 90 degrees in tenths of arcseconds, B-V + 1 in steps of 0.025,
// V - 16 in steps of 0.02, and no motion.
CatalogueStar gaia_faintest(const char* bytes) {
  constexpr double kTenths = 36000;
  return {
      .direction = place(three_bytes(bytes + 8) / kTenths, three_bytes(bytes + 11) / kTenths - 90),
      .v = static_cast<float>(16 + 0.02 * static_cast<unsigned char>(bytes[15])),
      .colour = colour_of_b_v(0.025 * static_cast<unsigned char>(bytes[14]) - 1)};
}

}  // namespace

std::size_t zone_count(int level) { return std::size_t{20} << (2 * level); }

StellariumZones::StellariumZones(int level) {
  std::vector<Triangle> triangles = icosahedron();
  for (int i = 0; i < level; ++i) triangles = cut(triangles);
  for (const Triangle& triangle : triangles) {
    Zone zone{};
    zone.centre = unit(triangle[0] + triangle[1] + triangle[2]);
    zone.east = unit(V3d(0, 0, 1).cross(zone.centre));
    zone.north = zone.centre.cross(zone.east);
    for (const V3d& corner : triangle) {
      // A corner is projected from the sphere's centre onto the plane that touches the sphere at
      // the zone's centre.  This divides its components by the cosine of its angle from there.
      const V3d d = corner - zone.centre;
      const double mu0 = d.dot(zone.east), mu1 = d.dot(zone.north);
      const double stretch = 1 / std::sqrt(1 - mu0 * mu0 - mu1 * mu1);
      scale_ = std::max({scale_, std::abs(mu0) * stretch, std::abs(mu1) * stretch});
    }
    zones_.push_back(zone);
  }
}

StellariumZones::Place StellariumZones::place(std::size_t zone, double x0, double x1) const {
  const Zone& z = zones_[zone];
  // p lies in the plane that touches the sphere at the zone's centre, so that p.p = 1/cos^2(angle).
  const V3d p = z.centre + (z.east * x0 + z.north * x1) * scale_;
  return {{unit(p)}, p.dot(p)};
}

CatalogueStar stellarium_gaia_star(int type, const char* bytes) {
  return type == 0 ? gaia_bright(bytes) : type == 1 ? gaia_faint(bytes) : gaia_faintest(bytes);
}

}  // namespace domefall
