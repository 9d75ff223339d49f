// The Strip of a disc about a hole without spin, in terms of the angle psi that light sweeps
// (plane_rays.h).
#pragma once

#include "pipeline/render/disc/disc_strip.h"

namespace domefall {

class DiscPass::SphereStrip : public DiscPass::Strip {
 public:
  using Strip::Strip;

  void locate(const CameraDirection* n, const double* angle, int count) override;
  Sighting sighting(int k) const override;

 private:
  // A Division is a part of a pixel in which psi_0 changes little.  As a rule it is the whole
  // pixel.
  struct Division {
    double turn, turn_per;  // psi_0, and by how much it changes here
    double azimuth_cosine, azimuth_sine;
    double part;  // of the pixel
  };
  // A Share gives the part of a pixel that lies beyond an image's inner rim, and the part beyond
  // its outer rim.  The image covers what is between these two.
  struct Share {
    double from, to;
  };

  // Samples are the places at which a pixel looks at an image, each with an even part of u.
  static constexpr int kMostSamples = 32;
  struct Samples {
    int count = 0;
    double part = 0, absorbed = 0;  // of u, of one; the sum over all
    std::array<double, kMostSamples> u;
    std::array<Gas, kMostSamples> gas;
  };

  double gather_pixel(int k) override;
  double gather_by_divisions(int k);
  double gather_division(int k, const Division& division);
  Samples sample(int k, const Division& division, double turn, const PlaneImages::Interval& rims,
                 const Share& share) const;
  PatternPlace place(int k, const Division& division, double turn, double u, double part) const;

  Crossings crossings_;
};

}  // namespace domefall
