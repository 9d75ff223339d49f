// Where the images of a pair of orders are seen, 2 p and 2 p + 1, for every place of a source: one
// polynomial look-up instead of the inversion of a SkyTable.
//
// The light of both sweeps an azimuth between 2 p pi and (2 p + 2) pi.  It is tabulated against
//     v = tan((phi_middle - phi)/4),  phi_middle = (2 p + 1) pi,
// which is v_star for the even order and -v_star for the odd one, v_star = tan((pi - phi_star)/4)
// in [0, 1] an algebraic function of the source.  What is tabulated is psi, the angle of view from
// the sky's far end: smooth from -1 to 1, odd in phi about the far end itself.  Intervals are even,
// each holds the cubic with the exact values and slopes at its ends.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "pipeline/optics/sky_table.h"
#include "pipeline/simd/vector_math.h"

namespace domefall {

class LensCurve {
 public:
  struct Wanted {
    double position = 1e-6;  // radians: error of psi
    double flux = 1e-4;      // relative error of the flux
  };
  // Where an interval misses what is wanted, measured at the point where the
  // cubic's slope errs most, it is not for use.  Costs 2 look-ups of the table for each interval.
  LensCurve(const SkyTable& table, int pair, int intervals, const Wanted& wanted);

  int intervals() const { return intervals_; }
  bool good(int interval) const { return bound_[static_cast<std::size_t>(interval)] >= 0; }
  int interval_of(double v) const {
    const int i = static_cast<int>((v + 1) * (0.5 * intervals_));
    return i < intervals_ ? i : intervals_ - 1;
  }
  // No image there has more of amplification times |sin phi_star| times (frequency ratio)^4 than
  // this, in the frame of the tetrad; negative where the curve is not for use.
  const float* bound() const { return bound_.data(); }
  // The largest of all bounds of the even (order 0) or the odd order, unusable intervals included.
  double largest_bound(bool odd) const { return largest_[odd ? 1 : 0]; }

  struct View {
    double psi;    // from the far end
    double slope;  // |d psi/d phi|
  };
  // Of one v, in [-1, 1].
  View operator()(double v) const;

  // Finds the polynomial of any v, for loops that are to become SIMD code.  It is a copy, so that
  // the compiler knows that no store of the loop alters it.
  static constexpr int kTerms = 4;
  struct Lookup {
    const double* coefficients;  // kTerms of each interval, of powers of the share
    double half;                 // intervals/2
    std::int64_t last;
    // Where v lies in the table.
    struct Index {
      const double* coefficients;  // of its interval
      double share;                // the position in the interval, 0 to 1
    };
    Index operator()(double v) const {
      const double u = (v + 1) * half;
      const double shifted = (u - 0.5) + kRounding;
      const auto at = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(shifted) & 0xffff);
      return {coefficients + kTerms * (at < last ? at : last), u - (shifted - kRounding)};
    }
    // c0 to c3 are the coefficients of the interval of v, t is its share.
    View view(double v, double t, double c0, double c1, double c2, double c3) const {
      const double by_t = (3 * c3 * t + 2 * c2) * t + c1;
      const double slope = by_t * half * (1 + v * v) * 0.25;
      return {((c3 * t + c2) * t + c1) * t + c0, slope < 0 ? -slope : slope};
    }
  };
  Lookup lookup() const { return {coefficients_.data(), 0.5 * intervals_, intervals_ - 1}; }

 private:
  std::vector<double> coefficients_;  // 4 for each interval, of powers of its share
  std::vector<float> bound_;
  double largest_[2] = {0, 0};
  int intervals_;
};

// The same bound for everything from this order on.
double most_light_from(const SkyTable& table, int order);

// |E| = 1 + z of the free-fall observer, and the direction's component along R, from psi.
struct PsiFrame {
  double sine2, cosine2;  // |E| = |sine2 sin^2(psi/2) + cosine2 cos^2(psi/2)|
  double outward;         // R.direction = outward cos(psi)
};
PsiFrame psi_frame(const SkyTable& table);

}  // namespace domefall
