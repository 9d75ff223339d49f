#include "pipeline/sky/catalogue/import/stellarium_zones.h"

#include <algorithm>
#include <cmath>

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

}  // namespace domefall
