// Pixels by what decides where they see a disc.
#pragma once

#include <array>

#include "pipeline/render/disc/disc_pass.h"

namespace domefall {

struct DiscPass::Pixels {
  template <class T>
  using Column = std::array<T, ViewRayBatch::kSize>;
  FrameRayBatch rays;
  Column<double> energy;     // E; 0 where light does not come from region I
  Column<double> label;      // p
  Column<double> label_per;  // of a pixel
  Column<double> turn;       // psi_0
  // Of the azimuth about R, counted from where psi_0 is least.
  Column<double> azimuth_cosine, azimuth_sine;
  Column<double> azimuth_per;
  Column<double> turn_per;
};

}  // namespace domefall
