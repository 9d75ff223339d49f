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
  // A part of a pixel, which is `high` and `wide` (radians) along delta and across it.
  struct Piece {
    KerrPlane::Sight sight;
    double high, wide, weight, frequency;
  };
  // The image of one order in a piece covers what lies beyond its outer rim and not beyond its inner.
  struct Image {
    double w, per;  // 1/r, and by how much it changes across the piece
    double beyond_inner, beyond_outer;

    double covered() const { return beyond_outer - beyond_inner; }
  };
  double gather_pixel(int k) override;
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
  };
  std::array<Pixel, kSize> at_{};
};

}  // namespace domefall
