// The skies of a frame, in bands of pixel rows.  Where the view is smooth they are interpolated
// from a coarse grid of view rays, elsewhere every pixel is traced.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "pipeline/render/sky/pixel_shader.h"
#include "pipeline/render/sky/ray_grid.h"

namespace domefall {

// Directions about which a coarse grid of view rays may miss detail.  One is the motion of a fast
// observer, where all light is crowded, and another its opposite, where it is spread out.  The last
// two are the axis, if the singularity is seen, whose azimuth starts there like a cube root.
std::vector<CameraDirection> special_directions(const FrameScene& scene);

class SkyPass {
 public:
  // Fills the grid, unless the image or the settings call for a ray through every pixel.  `grid` is
  // memory that is kept from frame to frame.  Scene and grid must outlive this.
  SkyPass(const FrameScene& scene, AntiAliasing anti_aliasing, std::vector<DarkenedCap> darkened,
          RayGrid& grid);

  // Writes the pixel values of the rows from number * kStep on into rgb[rows][3 columns], of which
  // there are kStep or what is left of the image.  One more float behind them may be overwritten.
  // Pixels outside the image become 0.
  void fill_band(int number, float* rgb) const;

  // The part (0 to 1) of the image's pixels that were traced one by one.
  double traced_fraction() const;

 private:
  // One row of cells, and the pixels that become of it.
  struct Band {
    int number, rows;                                // of the cells; of pixels in the image
    std::array<ColumnRange, RayGrid::kStep> inside;  // the image's columns in each row of pixels
    float* rgb;

    // The columns of the cells [first, end) that lie in the image.
    ColumnRange columns_of(int row, int first, int end) const {
      return {std::max(first * RayGrid::kStep, inside[row].first),
              std::min(end * RayGrid::kStep - 1, inside[row].last)};
    }
  };
  Band band_at(int number, float* rgb) const;
  float* row_of(const Band& band, int row) const {
    return band.rgb + static_cast<std::size_t>(row) * 3 *
                          static_cast<std::size_t>(columns(scene_.projection()));
  }
  void blacken_outside(const Band& band) const;
  void blacken(const Band& band, int first, int end) const;
  void fill_plain(const Band& band, int first, int end) const;
  void fill_block(const Band& band, int first, int end) const;
  void append_pixels(const Band& band, int first, int end, std::vector<Pixel>& pixels) const;

  const FrameScene& scene_;
  PixelShader shader_;
  RayGrid& grid_;
  bool interpolates_;
};

}  // namespace domefall
