// The Strip of a disc in the equator of a hole that spins (kerr_plane.h).
#pragma once

#include "pipeline/light/kerr_clock.h"
#include "pipeline/render/disc/disc_strip.h"

namespace domefall {

class DiscPass::KerrStrip : public DiscPass::Strip {
 public:
  explicit KerrStrip(const DiscPass& pass);

  void locate(const CameraDirection* n, const double* angle, int count) override;
  Sighting sighting(int k) const override;

  // As of DiscPass.  Where a place is says |E| times Mino's time from it.
  double left_before(const CameraDirection& n, double mino, double width);
  std::vector<Place> places(const CameraDirection& n, double width);

 private:
  // A part of a pixel, which is `high` (radians) along delta.  It is `wide` across, on a line along which
  // delta changes by `slope`.
  struct Piece {
    KerrPlane::Sight sight;
    double high, wide, weight, frequency, slope = 0;

    // By how much a value changes on each of these ways.
    double along(const KerrPlane::Value& value) const { return value.by_delta * high; }
    double across(const KerrPlane::Value& value) const {
      return (value.across + value.by_delta * slope) * wide;
    }
  };
  // The image of one order in a piece covers what lies beyond its outer rim and not beyond its inner.
  struct Image {
    double w, per;  // 1/r, and by how much it changes across the piece
    double beyond_inner, beyond_outer;

    double covered() const { return beyond_outer - beyond_inner; }
  };
  double gather_pixel(int k) override;
  double gather_side(int k, int side, double off);
  double gather_piece(int k, const Piece& piece);
  Image image(const Piece& piece, const KerrPlane::Crossing& at) const;
  Gas gas(const Piece& piece, const KerrPlane::Crossing& at, double r) const;
  PatternPlace place(const Piece& piece, const KerrPlane::Crossing& at, double r, double part,
                     double of_width) const;
  double azimuth(double angle, double r) const;

  const KerrPlane& plane_;
  KerrClock clock_;
  double low_, high_;  // 1/r of the outer rim, and of the inner one
  double sense_;       // 1 of gas that goes with the hole, else -1
  double sine_, cosine_;
  FrameRayBatch rays_;
  struct Pixel {
    double delta, eta, width;
    KerrPlane::Sight sight;

    // The cosine of the angle at which the edge runs to a circle about the hole.
    double edge_cosine() const { return 1 / length(1, sight.edge_slope); }
    // How many of its widths it is from the edge, less than 0 towards the hole.
    double from_edge() const { return sight.to_edge * edge_cosine() / width; }
  };
  std::array<Pixel, kSize> at_{};
};

}  // namespace domefall
