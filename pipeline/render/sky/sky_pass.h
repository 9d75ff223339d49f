// The skies of a frame, band by band: interpolated from a coarse grid of looks where the view is smooth,
// looked at pixel by pixel where it is not.
#pragma once

#include "pipeline/render/sky/pixel_shader.h"
#include "pipeline/render/sky/ray_grid.h"

namespace domefall {

// About which a coarse grid of looks may miss what there is: where all light crowds ahead of a fast
// observer and is spread behind it, and the axis, where the singularity's azimuth is a cube root.
std::vector<CameraDirection> special_directions(const FrameScene& scene);

class SkyPass {
 public:
  // Fills the grid, unless the image or the settings call for a ray through every pixel.  `grid` is memory
  // that is kept from frame to frame.  Scene and grid must outlive this.
  SkyPass(const FrameScene& scene, AntiAliasing anti_aliasing, std::vector<DarkenedCap> darkened,
          RayGrid& grid);

  // Pixel values of rows [number kStep, ...) into rgb[rows][3 columns], plus one float; 0 out of the picture.
  void fill_band(int number, float* rgb) const;

  // Pixels that were looked at one by one, of those in the picture: 0 to 1.
  double traced_fraction() const;

 private:
  // The columns of the picture in each row of a band.
  struct Band {
    int number, rows;  // cell row; rows of pixels that there are
    std::array<ColumnRange, RayGrid::kStep> inside;
    float* rgb;
  };
  Band band_at(int number) const;
  float* row_of(const Band& band, int row) const {
    return band.rgb + static_cast<std::size_t>(row) * 3 *
                          static_cast<std::size_t>(columns(scene_.projection()));
  }
  void blacken_outside(const Band& band) const;
  void blacken(const Band& band, int first, int end) const;
  void fill_plain(const Band& band, int first, int end) const;
  void fill_block(const Band& band, int first, int end) const;
  void add_pixels(const Band& band, int first, int end, std::vector<Pixel>& pixels) const;

  const FrameScene& scene_;
  PixelShader shader_;
  RayGrid& grid_;
  bool interpolates_;
};

}  // namespace domefall
