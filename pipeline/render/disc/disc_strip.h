// A Strip computes the light of a disc for a batch of pixels, each by itself.  The pixels may
// belong to several rows.
#pragma once

#include <array>

#include "pipeline/render/disc/disc_pass.h"

namespace domefall {

// The samples that pixels take of the disc are collected, and turned into light many at a time.
class DiscPass::Strip {
 public:
  static constexpr int kSize = ViewRayBatch::kSize;

  explicit Strip(const DiscPass& pass);

  // A Look is what a pixel sees at one place: the place, and light that no pattern has multiplied.
  struct Look {
    WorkingRgb light{0, 0, 0};
    PatternPlace place{};
  };
  // The looks of one pixel, if there are at most this many.  Otherwise `count` is larger.
  static constexpr int kMostLooks = 2;
  struct Looks {
    int count = 0;
    std::array<Look, kMostLooks> at;
  };

  // Finds light() and left() of `count` <= kSize pixels.
  void gather(const Crossings& crossings, int count);
  // Finds looks() and left() of those that are `wanted`.
  void look(const Crossings& crossings, int count, const bool* wanted);

  // These return the light that the k-th pixel gets from the disc (cd/m^2), and the part of the
  // light from behind that is left there.
  const WorkingRgb& light(int k) const { return light_[static_cast<std::size_t>(k)]; }
  const Looks& looks(int k) const { return looks_[static_cast<std::size_t>(k)]; }
  double left(int k) const { return left_[static_cast<std::size_t>(k)]; }
  // Returns the part of the light from behind that the image of an order takes.
  double taken(int k, std::size_t order) const {
    return taken_[static_cast<std::size_t>(k)][order];
  }

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

  void gather(const Crossings& crossings, int count, const bool* wanted);
  double gather_by_divisions(const Crossings& crossings, int k);
  double gather_division(const Crossings& crossings, int k, const Division& division);
  Samples sample(const Crossings& crossings, int k, const Division& division, double turn,
                 const PlaneImages::Interval& rims, const Share& share) const;
  void shade(const Crossings& crossings, int k, const Division& division, double turn,
             const Samples& samples, double weight);
  void note_place(const Crossings& crossings, int k, const Division& division, double turn,
                  double u, double part);
  void flush();
  void note_looks(std::size_t count);

  const DiscPass& pass_;
  const Effects& effects_;
  const Disc& disc_;
  template <class T>
  using Column = std::array<T, kSize>;
  Column<double> left_{};
  Column<std::array<double, PlaneImages::kOrders>> taken_{};
  Column<WorkingRgb> light_{}, colour_{};
  Column<Looks> looks_{};
  bool looks_only_ = false;
  struct {
    Column<float> r, g, weight;
    Column<int> pixel;
    Column<PatternPlace> place;
  } samples_{};
  Column<float> factor_{};
  std::size_t count_ = 0;
};

}  // namespace domefall
