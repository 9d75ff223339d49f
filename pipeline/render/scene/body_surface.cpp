#include "pipeline/render/scene/body_surface.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>

#include "pipeline/sources/sky/read_sky.h"

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

}  // namespace

// A lamp is where it was when the body's light left, by v.
BodySurface::BodySurface(const Body& body, const BodyImage& image, const ObserverState& observer)
    : body_(body),
      image_(image),
      observer_(observer),
      place_((V3d(std::cos(image.psi), 0, 0) + image.across * std::sin(image.psi)) * image.r) {
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

// By Lambert's law a place is as bright as its light comes in steeply.  The disc of a sphere that is
// lit from behind the observer has the mean 2/3.
double BodySurface::light(const SpherePiece& piece) const {
  if (!body_.lit_from) return limb_darkening(piece.cosine);
  if (!lamp_ && !from_) return 0;
  const V3d to_lamp = from_ ? *from_ : (*lamp_ - place_ - piece.place * body_.radius).normalized();
  return 1.5 * std::max(piece.place.dot(to_lamp), 0.0);
}

WorkingRgb BodySurface::tint(const SpherePiece& piece) const {
  if (!map_) return {1, 1, 1};
  if (!(mean_ > 0)) return {0, 0, 0};
  // On the surface a piece is this wide, at a slant that ends where its light does.
  constexpr double kLeastCosine = 0.1;
  const double width = std::sqrt(piece.at.amplification / image_.solid_angle_per_area /
                                 std::max(piece.cosine, kLeastCosine)) /
                       body_.radius;
  const V3d on_sky = apply(observer_.sky_from_tetrad, piece.place);
  const V3d &node = body_.node.v, &normal = body_.normal.v;
  // From outside longitudes grow to the right.
  const WorkingRgb light =
      map_->sample({on_sky.dot(node), -on_sky.dot(normal.cross(node)), on_sky.dot(normal)}, width);
  const auto scaled = [&](float value) { return static_cast<float>(value / mean_); };
  return {scaled(light.r), scaled(light.g), scaled(light.b)};
}

}  // namespace domefall
