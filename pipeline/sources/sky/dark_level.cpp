#include "pipeline/sources/sky/dark_level.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/cube_face.h"

namespace domefall {
namespace {

// dark_level.h gives these numbers and their reasons.
constexpr int kTexels = 64;
constexpr double kDarkest = 0.01;  // of the sphere
constexpr double kEven = 0.75;     // of the median; from there on the darkest part is not dark

// A patch is one texel: its light, the luminance of that light, and the part of the sphere that the
// texel stands for.
struct Patch {
  double light, luminance, solid_angle;
};

Patch patch_of(const SkyMap& map, const SkyTexel& texel, double solid_angle) {
  const auto channel = [&](int k) { return half_value(texel.channel[k]); };
  if (map.kind() == SkyMapKind::kColour) {
    const double light = map.unit() * luminance({channel(0), channel(1), channel(2)});
    return {light, light, solid_angle};
  }
  if (!(channel(0) > 0)) return {0, 0, solid_angle};
  const double radiance = map.unit() * channel(0);
  // A thermal texel holds radiance I and I theta, so their quotient is theta =
  // log2(T/kThermalBase).
  const double temperature = kThermalBase * std::exp2(channel(1) / channel(0));
  return {radiance, radiance * luminance(blackbody_colours().per_flux(temperature)), solid_angle};
}

// Returns the inner texels of the level at which darkness is measured.
std::vector<Patch> patches_of(const SkyMap& map) {
  const auto& levels = map.levels();
  // If no level is so small, the last and smallest one is taken.
  const auto level = std::find_if(levels.begin(), levels.end() - 1,
                                  [](const SkyLevel& l) { return l.size <= kTexels; });
  const int n = level->size;
  std::vector<Patch> patches;
  patches.reserve(static_cast<std::size_t>(6) * static_cast<std::size_t>(n * n));
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const FacePoint at = texel_centre(face, i, j, n);
        patches.push_back(
            patch_of(map, level->face(face)[static_cast<std::size_t>((j + 1) * (n + 2) + i + 1)],
                     texel_solid_angle(n, at.u, at.v)));
      }
  return patches;
}

const Patch& at_part(const std::vector<Patch>& patches, double part) {
  double sphere = 0, below = 0;
  for (const Patch& patch : patches) sphere += patch.solid_angle;
  for (const Patch& patch : patches) {
    below += patch.solid_angle;
    if (below >= part * sphere) return patch;
  }
  return patches.back();
}

}  // namespace

DarkLevel dark_level(const SkyMap& map) {
  std::vector<Patch> patches = patches_of(map);
  std::ranges::stable_sort(patches, {}, &Patch::light);
  const Patch& darkest = at_part(patches, kDarkest);
  // An even sky has no dark parts, and without a level nothing is taken away from it.
  if (darkest.light > kEven * at_part(patches, 0.5).light) return {};
  return {darkest.light, darkest.luminance};
}

double light_per_luminance(const SkyMap& map) {
  if (map.kind() == SkyMapKind::kColour) return 1;
  // A map may be dark in many places.  Only a part that shines has a temperature, so the darkest of
  // these is taken.
  std::vector<Patch> patches = patches_of(map);
  std::erase_if(patches, [](const Patch& patch) { return !(patch.luminance > 0); });
  const auto darkest = std::ranges::min_element(patches, {}, &Patch::light);
  return darkest == patches.end() ? 0 : darkest->light / darkest->luminance;
}

}  // namespace domefall
