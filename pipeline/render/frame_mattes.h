// Mattes say how much of each pixel belongs to what a compositor wants to change alone: to a sky, to
// the hole's silhouette, to an image of the disc, to a body (docs/compositing.md).
#pragma once

#include <string>
#include <vector>

#include "pipeline/image/layer.h"
#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/cryptomatte.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/frame_bodies.h"
#include "pipeline/render/rays/sky_borders.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// Returns the mattes that the frames of a show are rendered with, still empty.  Those of bodies come
// first, in the show's order.
std::vector<Matte> mattes_of(const Show& show);

// A MattePass fills in the mattes of an instant, band by band.
class MattePass {
 public:
  // `disc` is null where there is none.  Both must outlive this pass.
  MattePass(const FrameScene& scene, const DiscPass* disc);

  // Fills in the rows [first, end) of all mattes that a frame has, whose light in these rows is rgb,
  // 3 values a pixel.
  void fill_rows(int first, int end, const float* rgb, SplatBuffer& splats,
                 std::vector<Matte>& mattes) const;

 private:
  void fill_body(std::size_t body, int first, int end, const float* rgb, SplatBuffer& splats,
                 float* covered) const;
  // Fills in the mattes of the skies, and that of the silhouette after them.
  void fill_skies(int row, std::span<float* const> covered) const;

  const FrameScene& scene_;
  const DiscPass* disc_;
  std::vector<std::vector<BodyLayer>> bodies_;  // each with its own light alone
  SkyBorders borders_;
  PerSky<bool> seen_;
};

// Returns the names of all objects that a cryptomatte of the show can tell apart.
std::vector<std::string> objects_of(const Show& show);

// Returns the identities of a frame's bodies and titles, from its mattes.
Cryptomatte identities(const Show& show, const FrameState& state, const std::vector<Matte>& mattes);

}  // namespace domefall
