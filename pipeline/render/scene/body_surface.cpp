#include "pipeline/render/scene/body_surface.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <numbers>

#include "pipeline/sources/sky/read_sky.h"
#include "pipeline/sources/stars/star_granulation.h"

namespace domefall {
namespace {

struct Texture {
  std::filesystem::file_time_type written;
  std::shared_ptr<const SkyMap> map;
  double mean;
};

// Returns the mean luminance of a map, of its coarsest level.
double mean_of(const SkyMap& map) {
  double sum = 0;
  for (const V3d& d : {V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1)})
    for (const double side : {1.0, -1.0}) sum += luminance(map.sample(d * side, 2));
  return sum / 6;
}

// Textures are kept for all frames of a process.
Texture texture_of(const std::filesystem::path& file) {
  constexpr int kLargestFaceOfTextures = 2048;
  static std::mutex mutex;
  static std::map<std::filesystem::path, Texture> known;
  const std::scoped_lock lock(mutex);
  std::error_code none;
  const auto written = std::filesystem::last_write_time(file, none);
  if (const auto found = known.find(file); found != known.end() && found->second.written == written)
    return found->second;
  const auto map = read_sky(file, kLargestFaceOfTextures).map;
  return known.insert_or_assign(file, Texture{written, map, mean_of(*map)}).first->second;
}

// A sphere is darker towards its limb by the linear law of V for the Sun, I = 1 - u (1 - mu) with
// u = 0.6 (Allen's Astrophysical Quantities, 4th ed., sec. 14.7, has 0.60 at 550 nm).  Over a disc
// the mean of mu is 2/3.
double limb_darkening(double cosine) {
  constexpr double kU = 0.6;
  return (1 - kU * (1 - cosine)) / (1 - kU / 3);
}

// The depth of a ring at right angles.
double depth_of(const BodyRing& ring) { return -std::log(std::max(1 - ring.opacity, 1e-6)); }
constexpr double kLeastSteepness = 1e-3;

// Says how much of a piece of this width is beyond an edge.
double within(double beyond, double width) {
  return width > 0 ? std::clamp(beyond / width + 0.5, 0.0, 1.0) : beyond > 0 ? 1 : 0;
}

// Returns the light of a sphere by Lambert's law, against its full phase.
double phase(double cosine) {
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  return (std::sin(angle) + (std::numbers::pi - angle) * std::cos(angle)) / std::numbers::pi;
}

// Returns what a layer scatters once, by the cosines at which light goes out and in, on the lit side
// or through to the other one.
double scattered_once(double depth, double out, double in, bool is_lit_side) {
  if (is_lit_side) return in / (in + out) * (1 - std::exp(-depth * (1 / in + 1 / out)));
  if (std::abs(in - out) < 1e-6 * in) return depth / in * std::exp(-depth / in);
  return in / (in - out) * (std::exp(-depth / in) - std::exp(-depth / out));
}

}  // namespace

// A lamp is where it was when the body's light left, by v.
BodySurface::BodySurface(const Body& body, const BodyImage& image, const ObserverState& observer)
    : body_(body),
      image_(image),
      observer_(observer),
      axes_(own_axes(body)),
      place_((V3d(std::cos(image.psi), 0, 0) + image.across * std::sin(image.psi)) * image.r) {
  rings_.normal = apply_transposed(observer.sky_from_tetrad, column(axes_, 2));
  for (const BodyRing& ring : body.rings) rings_.edges.emplace_back(ring.inner, ring.outer);
  if (!body.texture.empty()) {
    const Texture texture = texture_of(body.texture);
    map_ = texture.map;
    mean_ = texture.mean;
  }
  if (!body.lit_from) return;
  if (const auto* place = std::get_if<SkyDirection>(&*body.lit_from)) {
    from_ = apply_transposed(observer.sky_from_tetrad, place->v);
  } else if (const auto* lamp = std::get_if<std::shared_ptr<const Body>>(&*body.lit_from)) {
    const double v = motion_of(observer.spacetime, body, observer.sky_from_tetrad)
                         .at(image.proper_time)
                         .null_time;
    const auto tau = time_of_null(observer.spacetime, **lamp, v);
    if (!tau) return;
    const BodyPoint point =
        motion_of(observer.spacetime, **lamp, observer.sky_from_tetrad).at(*tau);
    lamp_ = point.direction * point.r;
  } else {
    lamp_ = V3d(0, 0, 0);
  }
}

V3d BodySurface::own_place(const V3d& place) const {
  return apply_transposed(axes_, apply(observer_.sky_from_tetrad, place));
}

// By Lambert's law a place is as bright as its light comes in steeply.  The disc of a sphere that is
// lit from behind the observer has the mean 2/3.
double BodySurface::light(const SpherePiece& piece) const {
  if (!body_.lit_from) {
    const double even = limb_darkening(piece.cosine);
    if (map_ || !(body_.granulation > 0)) return even;
    return even * granulation(own_place(piece.place), piece.width, body_.granulation);
  }
  const auto lamp = to_lamp(piece.place);
  if (!lamp) return 0;
  const double light = 1.5 * std::max(piece.place.dot(*lamp), 0.0);
  return light > 0 ? light * left_in_shadow(piece, *lamp) : 0;
}

std::optional<V3d> BodySurface::to_lamp(const V3d& place) const {
  if (from_) return from_;
  if (!lamp_) return std::nullopt;
  return (*lamp_ - place_ - place * body_.radius).normalized();
}

// Light goes straight, and a shadow's edge is as soft as a piece is wide.
double BodySurface::left_in_shadow(const SpherePiece& piece, const V3d& to_lamp) const {
  if (rings_.edges.empty()) return 1;
  const double steep = to_lamp.dot(rings_.normal), way = -piece.place.dot(rings_.normal) / steep;
  if (!(way > 0)) return 1;
  const double radius = (piece.place + to_lamp * way).length();
  double left = 1;
  for (std::size_t k = 0; k < rings_.edges.size(); ++k) {
    const auto& [inner, outer] = rings_.edges[k];
    const double covered =
        within(radius - inner, piece.width) * within(outer - radius, piece.width);
    left *= 1 - covered * (1 - left_by({static_cast<int>(k), std::abs(steep)}));
  }
  return left;
}

double BodySurface::left_by(const RingCrossing& crossing) const {
  if (crossing.ring < 0) return 1;
  return std::exp(-depth_of(body_.rings[static_cast<std::size_t>(crossing.ring)]) /
                  std::max(crossing.steepness, kLeastSteepness));
}

double BodySurface::left_by(const RingPiece& piece) const {
  return left_by({piece.ring, std::abs(piece.leaving.dot(rings_.normal))});
}

// What is lit from elsewhere scatters light once, in a layer of this depth (Chandrasekhar 1960,
// Radiative Transfer, sec. 45).  A star's disc has the radius 1/radius at a ring, and its particles
// reflect three quarters of its light.
double BodySurface::light(const RingPiece& piece) const {
  const double radius = piece.place.length();
  if (!body_.lit_from)
    return (1 - left_by(piece)) * phase(-piece.place.dot(piece.leaving) / radius) /
           (2 * radius * radius);
  const auto lamp = to_lamp(piece.place);
  if (!lamp) return 0;
  const double ahead = piece.place.dot(*lamp), out = piece.leaving.dot(rings_.normal),
               in = lamp->dot(rings_.normal);
  const double shadow =
      ahead < 0 ? within((piece.place - *lamp * ahead).length() - 1, piece.width) : 1;
  const double scattered =
      scattered_once(depth_of(body_.rings[static_cast<std::size_t>(piece.ring)]),
                     std::max(std::abs(out), kLeastSteepness),
                     std::max(std::abs(in), kLeastSteepness), out * in > 0);
  return 2 * shadow * scattered * phase(lamp->dot(piece.leaving));
}

WorkingRgb BodySurface::tint(const SpherePiece& piece) const {
  if (!map_) return {1, 1, 1};
  if (!(mean_ > 0)) return {0, 0, 0};
  // On the surface a piece is this wide, at a slant that ends where its light does.
  constexpr double kLeastCosine = 0.1;
  const double width = std::sqrt(piece.at.amplification / image_.solid_angle_per_area /
                                 std::max(piece.cosine, kLeastCosine)) /
                       body_.radius;
  const V3d own = own_place(piece.place);
  // From outside longitudes grow to the right.
  const WorkingRgb light = map_->sample({own.x, -own.y, own.z}, width);
  const auto scaled = [&](float value) { return static_cast<float>(value / mean_); };
  return {scaled(light.r), scaled(light.g), scaled(light.b)};
}

}  // namespace domefall
