// Many stars at once from their catalogue to their pixels: loops over columns that become SIMD
// code.  Units and names are those of StarImages, which looks after everything that is not plain.
#pragma once

#include <array>

#include "pipeline/optics/aberration.h"
#include "pipeline/render/scene/scene_stars.h"
#include "pipeline/render/stars/lens_curve.h"
#include "projections/projection.h"

namespace domefall {

inline constexpr int kStarBatch = static_cast<int>(SceneStars::kBlock);

// What of a frame the loops need.
struct StarFrame {
  M33d sky_from_tetrad, tetrad_from_camera;
  Aberration from_tetrad{V3d(0, 0, 0)};
  PsiFrame psi{0, 1, 1};
  // A star of magnitude m gives gain * min(1, (limit - m) * inverse_fade) of its light, and none
  // from the limit on.
  double gain = 1, limit = 0, inverse_fade = 0;
};

template <class T>
using StarColumn = std::array<T, kStarBatch>;

// Sources in the frame of the tetrad.
struct StarSources {
  StarColumn<double> x, y, z;
  StarColumn<double> sine;  // of the angle from the axis
  StarColumn<double> v;     // as LensCurve has it, of the even order: 0 to 1
  StarColumn<double> flux, temperature;
};

// Images as the observer receives them.
struct StarViews {
  StarColumn<double> x, y, z;      // camera components
  StarColumn<double> flux;         // bolometric, observed
  StarColumn<double> temperature;  // observed
  StarColumn<double> i, j;         // pixels, counted as StarImage does
};

// Stars first to first + count - 1 of the catalogue.
void find_sources(const StarFrame& frame, const SceneStars& stars, std::size_t first, int count,
                  StarSources& sources);

// Through the lens and the boost: the images of the curve's even (side = 1) or odd (-1) order.  No
// source may be on the axis.
void bend(const StarFrame& frame, const LensCurve& curve, double side, const StarSources& sources,
          int count, StarViews& views);
// The same where light goes straight.
void go_straight(const StarFrame& frame, const StarSources& sources, int count, StarViews& views);

// Where in a picture, and what is in it.
class StarPlane {
 public:
  // Blobs of up to `reach` radians are to be seen.
  StarPlane(const Projection& projection, double reach);
  // False if blobs reach so far that views for the dome's other half would be needed.
  bool usable() const { return usable_; }
  // Fills i and j, and lists the views from which a blob may reach the picture; their number.
  int place(StarViews& views, int count, int* listed) const;

 private:
  bool dome_ = true, usable_ = true;
  double scale_ = 1;  // pixels per radian, or per half tangent
  double middle_i_ = 0, middle_j_ = 0;
  double half_i_ = 0, half_j_ = 0;  // of the picture, with the margin
  double least_z_ = -1;
};

}  // namespace domefall
