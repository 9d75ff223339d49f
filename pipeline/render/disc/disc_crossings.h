// For each pixel of a batch, the columns of this file describe where its view ray meets a disc.
// A column named "..._per" says by how much the quantity changes across the pixel.
#pragma once

#include <array>

#include "pipeline/render/disc/disc_pass.h"

namespace domefall {

struct DiscPass::Crossings {
  template <class T>
  using Column = std::array<T, ViewRayBatch::kSize>;
  FrameRayBatch rays;
  Column<double> energy;  // E; 0 where light does not come from region I
  Column<double> label;   // p of disc_images.h
  Column<double> label_per;
  Column<double> turn;  // psi_0, radians
  // The azimuth about R counts from where psi_0 is least.
  Column<double> azimuth_cosine, azimuth_sine;
  Column<double> azimuth_per;  // radians
  Column<double> turn_per;     // radians, at most
};

}  // namespace domefall
