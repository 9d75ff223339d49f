#include "projections/picture_parts.h"

#include "projections/sphere_formulas.h"

namespace domefall {

std::vector<PicturePart> picture_parts(const Projection& p) {
  const auto* cube = std::get_if<Cubemap>(&p);
  if (!cube) return {};
  std::vector<PicturePart> faces;
  for (int k = 0; k < static_cast<int>(kCubeFaces.size()); ++k) {
    const CubeFace& f = kCubeFaces[static_cast<std::size_t>(k)];
    faces.push_back({k % kFacesInARow * cube->face,
                     k / kFacesInARow * cube->face,
                     face_picture(*cube),
                     {f.right, f.down, f.forward}});
  }
  return faces;
}

}  // namespace domefall
