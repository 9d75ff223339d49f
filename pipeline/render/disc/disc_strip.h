// A Strip computes the light of a disc for a batch of pixels, each by itself.  The pixels may
// belong to several rows.
#pragma once

#include <array>
#include <memory>

#include "pipeline/render/disc/disc_pass.h"

namespace domefall {

// The samples that pixels take of the disc are collected, and turned into light many at a time.
class DiscPass::Strip {
 public:
  static constexpr int kSize = ViewRayBatch::kSize;
  static constexpr int kOrders = PlaneImages::kOrders;

  explicit Strip(const DiscPass& pass);
  Strip(const Strip&) = delete;
  Strip& operator=(const Strip&) = delete;
  virtual ~Strip() = default;

  // Finds where `count` <= kSize pixels of these directions and widths (radians) see the disc.  All
  // that follows is about them.
  virtual void locate(const CameraDirection* n, const double* angle, int count) = 0;

  // A Sighting says where the ray of a pixel lies.
  struct Sighting {
    // For each order two bits, of a Side.  Orders behind an opaque image have none set.
    unsigned sight = 0;
    bool lit = false;      // whether it is in an image
    double clearance = 0;  // pixels to the nearest rim, at least; 0 where that cannot be told
  };
  virtual Sighting sighting(int k) const = 0;

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

  // Finds light() and left() of all pixels.
  void gather();
  // Finds looks() and left() of those that are `wanted`.
  void look(const bool* wanted);

  // These return the light that the k-th pixel gets from the disc (cd/m^2), and the part of the
  // light from behind that is left there.
  const WorkingRgb& light(int k) const { return light_[static_cast<std::size_t>(k)]; }
  const Looks& looks(int k) const { return looks_[static_cast<std::size_t>(k)]; }
  double left(int k) const { return left_[static_cast<std::size_t>(k)]; }
  // Returns the part of the light from behind that the image of an order takes.
  double taken(int k, std::size_t order) const {
    return taken_[static_cast<std::size_t>(k)][order];
  }

 protected:
  // Where a ray lies relative to the image of an order.  kWherePlunging is apart from kWithin because
  // the light has a kink where gas begins to plunge, which no cubic may cross.
  enum Side : unsigned { kBeneath, kWithin, kWherePlunging, kAbove };
  static constexpr unsigned kNoLight = ~0u;
  static constexpr double kFar = 1e3;  // of a clearance

  static double length(double x, double y) { return __builtin_sqrt(x * x + y * y); }

  // Adds the samples of a pixel, and returns the part of the light from behind that is left.
  virtual double gather_pixel(int k) = 0;
  // Adds a sample of gas, whose light counts with a weight.  The place is for a pattern alone.
  void add(int k, const Gas& gas, double weight, const PatternPlace& place);
  double& take(int k, int order) {
    return taken_[static_cast<std::size_t>(k)][static_cast<std::size_t>(order)];
  }

  const DiscPass& pass_;
  const Disc& disc_;
  int pixels_ = 0;

 private:
  void gather(const bool* wanted);
  void flush();
  void note_looks(std::size_t count);

  const Effects& effects_;
  template <class T>
  using Column = std::array<T, kSize>;
  Column<double> left_{};
  Column<std::array<double, kOrders>> taken_{};
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
