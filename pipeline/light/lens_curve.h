// A LensCurve gives the images of a pair of orders, 2 p and 2 p + 1, for every place of a source.
// It evaluates one polynomial, where a SkyTable would have to be inverted.
//
// The light of both orders sweeps an azimuth between 2 p pi and (2 p + 2) pi.  The table's
// coordinate is
//     v = tan((phi_middle - phi)/4),  phi_middle = (2 p + 1) pi,
// which is v_star for the even order and -v_star for the odd one.  v_star = tan((pi - phi_star)/4),
// in [0, 1], is an algebraic function of the source's components.  The table's value is psi, the
// angle of view from the sky's far end, which is smooth from -1 to 1.  Intervals have equal
// widths.  Each holds the cubic that has the exact values and slopes at its ends.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/sky_points.h"
#include "pipeline/light/sky_table.h"

namespace domefall {

class LensCurve {
 public:
  // Each interval is checked against the table at the point where the cubic's slope errs most.  An
  // interval that misses the tolerance is not for use.  The table is inverted twice for each
  // interval.
  LensCurve(const SkyTable& table, int pair, int intervals, const PointTolerance& tolerance);

  int interval_of(double v) const {
    const int i = static_cast<int>((v + 1) * (0.5 * intervals_));
    return i < intervals_ ? i : intervals_ - 1;
  }
  // Returns for each interval an upper bound of amplification * |sin phi_star| * (frequency
  // ratio)^4 in the frame of the tetrad, or a negative number if the interval is not for use, as
  // next to a level edge.  It is 0 where no light sweeps so much.
  const float* bounds() const { return bound_.data(); }
  // Returns the largest bound of the even or the odd order.  Intervals that are not for use count
  // with the bounds that they would have.
  double largest_bound(bool odd) const { return largest_[odd ? 1 : 0]; }

  struct View {
    double psi;    // the angle of view from the far end, radians
    double slope;  // |d psi/d phi|
  };
  // Returns the image at one v in [-1, 1].
  View operator()(double v) const;

  // A Lookup finds the polynomial of any v, for loops that are to become SIMD code.  Such a loop
  // makes a copy of it, so that the compiler knows that no store of the loop alters it.
  static constexpr int kTerms = 4;
  struct Lookup {
    const double* coefficients;  // kTerms of each interval, of powers of the share
    double half;                 // intervals/2
    std::int64_t last;
    // An Index says where v lies in the table.
    struct Index {
      const double* coefficients;  // of its interval
      double share;                // the position in the interval, 0 to 1
    };
    Index operator()(double v) const {
      // The sum with kRounding has the number of the interval, u rounded down, in its low bits.
      const double u = (v + 1) * half;
      const double shifted = (u - 0.5) + kRounding;
      const auto at = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(shifted) & 0xffff);
      return {coefficients + kTerms * (at < last ? at : last), u - (shifted - kRounding)};
    }
    // c0 to c3 are the coefficients of the interval of v, and t is the share.  By the chain rule
    // the slope is the product of d psi/d t, d t/d v = half and |d v/d phi| = (1 + v^2)/4.
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

// Returns a bound as in bounds() that holds for this order and all that follow.
double most_light_from(const SkyTable& table, int order);

// A PsiFrame takes psi to 1 + z for the free-fall observer and to a direction's component along R:
//     1 + z = |sine2 sin^2(psi/2) + cosine2 cos^2(psi/2)|,  component = outward cos(psi).
struct PsiFrame {
  ViewEnergy energy;  // of psi in place of alpha
  double outward;     // 1 or -1
};
PsiFrame psi_frame(const SkyTable& table);

}  // namespace domefall
