// The loops of this file take columns of many stars from the catalogue to pixels.  The compiler
// turns them into SIMD code.  They include all effects of nature.
#pragma once

#include <array>

#include "pipeline/light/aberration.h"
#include "pipeline/light/sky_points.h"
#include "pipeline/render/scene/scene_stars.h"
#include "projections/projection.h"

namespace domefall {

inline constexpr int kStarBatch = static_cast<int>(SceneStars::kBlock);

// A StarFrame holds the constants of a frame that the loops need.
struct StarFrame {
  M33d axes;  // of R, Theta and Phi on the sky (sky_axes)
  M33d tetrad_from_camera;
  Aberration from_tetrad{V3d(0, 0, 0)};
  // The flux of a star of magnitude m is multiplied by gain * min(1, (limit - m) * inverse_fade),
  // and by 0 from the limit on.
  double gain = 1, limit = 0, inverse_fade = 0;
};

template <class T>
using StarColumn = std::array<T, kStarBatch>;

// StarSources are the stars as sources of light, with their directions in the frame of the tetrad.
struct StarSources : PointBatch {
  StarColumn<double> flux, temperature;  // W/m^2 and K at no redshift
};
static_assert(PointBatch::kSize == kStarBatch);

// StarViews are images of stars as the moving camera receives them.
struct StarViews {
  StarColumn<double> x, y, z;            // unit vector along the camera's axes
  StarColumn<double> flux, temperature;  // W/m^2 and K
  StarColumn<double> i, j;               // position in pixels, as StarImage has it
};

// ReceivedLight is the light of one image as the moving camera receives it.
struct ReceivedLight {
  V3d direction;           // unit vector along the camera's axes
  double frequency_ratio;  // with that of the boost
  double flux;             // for a unit of flux without redshift
};

// Returns the light that comes from `direction` in the frame of the tetrad, as the camera receives
// it.  Let the boost have the frequency ratio D, and let g be D times the ratio in the tetrad.  The
// intensity is multiplied by g^4.  The boost divides solid angles, and so the amplification, by
// D^2.  So the flux is amplification * g^4/D^2, which is computed as amplification *
// (g * frequency_ratio)^2.
inline ReceivedLight received(const Aberration& boost, const M33d& camera, const V3d& direction,
                              double frequency_ratio, double amplification) {
  const AberratedLight seen = boost.to_rest(direction);
  const double g = frequency_ratio * seen.frequency_ratio, g2 = g * frequency_ratio;
  return {apply_transposed(camera, seen.direction), g, amplification * (g2 * g2)};
}

// Fills the sources with the stars from `first` to first + count - 1, but for what the lens sets.
void find_sources(const StarFrame& frame, const SceneStars& stars, std::size_t first, int count,
                  StarSources& sources);

// Makes views of images in the frame of the tetrad.
void receive_images(const StarFrame& frame, const PointImageBatch& images,
                    const StarSources& sources, int count, StarViews& views);

// A StarPlane projects views to the frame's pixels.  It uses SIMD code for a stereographic image,
// and for a Domemaster unless blobs reach farther over its rim than angle_over_sine() holds.
class StarPlane {
 public:
  // `reach` is the radius of the largest blob in radians.
  StarPlane(const Projection& projection, double reach);
  // Fills i and j of the views.  Lists those from which a blob may reach the frame and returns
  // their number.
  int place(StarViews& views, int count, int* listed) const;

 private:
  Projection projection_;
  bool fast_dome_ = false;
  double scale_ = 1;                    // pixels per radian, or per tan(theta/2) if not a dome
  double middle_i_ = 0, middle_j_ = 0;  // pixels
  double half_i_ = 0, half_j_ = 0;      // half the frame's sides with the margin, pixels
  double least_z_ = -1;                 // cosine of the largest angle from the camera's axis
};

}  // namespace domefall
