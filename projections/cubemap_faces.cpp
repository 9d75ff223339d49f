#include "projections/cubemap_faces.h"

#include "projections/sphere_formulas.h"

namespace domefall {

std::vector<CubemapFace> cubemap_faces(const Projection& p) {
  const auto* cube = std::get_if<Cubemap>(&p);
  if (!cube) return {};
  std::vector<CubemapFace> faces;
  for (int k = 0; k < static_cast<int>(kFaceAxes.size()); ++k) {
    const FaceAxes& f = kFaceAxes[static_cast<std::size_t>(k)];
    faces.push_back({k % kFacesInARow * cube->face,
                     k / kFacesInARow * cube->face,
                     face_projection(*cube),
                     {f.right, f.down, f.forward}});
  }
  return faces;
}

}  // namespace domefall
