// A SkyPass renders the skies of a frame, in bands of pixel rows.  Where the view is smooth, pixels
// are interpolated from a coarse grid of view rays.  Elsewhere every pixel is traced.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "pipeline/render/sky/pixel_shader.h"
#include "pipeline/render/sky/ray_grid.h"

namespace domefall {

// Returns the directions around which a coarse grid of view rays may miss detail.  The first two
// are the motion of a fast observer, where all light is crowded, and its opposite, where it is
// spread out.  The others are the two directions of the axis, if the singularity is seen, because
// its azimuth starts there like a cube root.
std::vector<CameraDirection> special_directions(const FrameScene& scene);

class SkyPass {
 public:
  // Makes the grid, unless the image or the settings require a ray through every pixel.  `grid` is
  // memory that is kept from frame to frame.  Scene and grid must outlive this object.
  SkyPass(const FrameScene& scene, AntiAliasing anti_aliasing, std::vector<DarkenedCap> darkened,
          RayGrid& grid);

  // Writes the pixel values of the rows from number * kStep on into rgb[rows][3 columns].  There
  // are kStep rows, or as many as are left of the image.  One more float behind them may be
  // overwritten.  Pixels outside the image become 0.
  void fill_band(int number, float* rgb) const;

  // Returns the part (0 to 1) of the image's pixels that were traced one by one.
  double traced_fraction() const;

 private:
  // A Band is one row of cells with the pixels that are made of it.
  struct Band {
    int number, rows;                                // the row of cells; its rows in the image
    std::array<ColumnRange, RayGrid::kStep> inside;  // the image's columns in each row of pixels
    float* rgb;

    // Returns the columns of the cells [first, end) that lie in the image.
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
