// An OctaveCurve is a table of a smooth function of a positive number that spans many octaves.  Its
// intervals divide each octave evenly and are found from the bits of x.  In each interval a
// polynomial of degree 7 matches the value and three derivatives at both ends, which come from
// Chebyshev interpolation of the function in ln x.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

namespace domefall {

class OctaveCurve {
 public:
  static constexpr int kPerOctaveBits = 3;

  // Tabulates `f` over [x_min rounded down to an interval, x_max] with 2^bits intervals to the
  // octave, where 0 < x_min < x_max.  `f` is called about 8 times an octave, up to one interval
  // beyond x_max.  The error falls with the eighth power of the intervals' width.  That of a
  // logarithm is 1e-11 with 3 bits.
  OctaveCurve(double x_min, double x_max, const std::function<double(double)>& f,
              int bits = kPerOctaveBits);

  double x_min() const { return x_min_; }
  double x_max() const { return start(intervals_.back()); }  // where the last interval begins
  std::size_t node_count() const { return intervals_.size() + 1; }

  struct Jet {
    double value, first, second;  // f, df/dx, d2f/dx2
  };
  // Returns the value and two derivatives at x in [x_min, x_max].
  Jet at(double x) const;
  double value(double x) const {
    const Interval& q = interval(x);
    return polynomial(q.c, (x - start(q)) * inverse_width(q));
  }
  // Returns the x in [x_min, x_end] with value(x) = wanted, by the same polynomials.  The function
  // must be monotone there and take the value.
  double inverse(double wanted, double x_end) const;

  // Says whether the curve rises, or falls, in every interval that ends before x_end.  A result of
  // true is proven, by the signs of the Bernstein coefficients of the slope.
  bool is_monotone(double x_end) const;

  static constexpr int kTerms = 8;

  // A Lookup finds the polynomial of any x without a branch, for loops that are to become SIMD
  // code.  It is a copy of what finding needs, so that the compiler knows that no store of the loop
  // alters it, and is valid while the curve lives.  An x below x_min counts as x_min, and one
  // beyond the last interval as the end of that.
  class Lookup;
  Lookup lookup() const;

 private:
  // An Interval holds the coefficients of powers of u, which runs from 0 to 1 across it.  They fill
  // one cache line.
  struct alignas(kTerms * sizeof(double)) Interval {
    std::array<double, kTerms> c;
  };

  static double polynomial(const std::array<double, kTerms>& c, double u) {
    double sum = c[kTerms - 1];
    for (int k = kTerms - 2; k >= 0; --k) sum = sum * u + c[k];
    return sum;
  }
  static double polynomial_slope(const std::array<double, kTerms>& c, double u) {
    double sum = (kTerms - 1) * c[kTerms - 1];
    for (int k = kTerms - 2; k >= 1; --k) sum = sum * u + k * c[k];
    return sum;
  }

  static std::int64_t key(double x, int shift) {
    return static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> shift);
  }
  double key_start(std::int64_t k) const {
    return std::bit_cast<double>(static_cast<std::uint64_t>(k) << shift_);
  }
  const Interval& interval(double x) const {
    const auto last = static_cast<std::int64_t>(intervals_.size()) - 1;
    return intervals_[static_cast<std::size_t>(
        std::clamp<std::int64_t>(key(x, shift_) - first_key_, 0, last))];
  }

  double start(const Interval& q) const { return key_start(first_key_ + (&q - intervals_.data())); }
  double inverse_width(const Interval& q) const {
    const std::int64_t key = first_key_ + (&q - intervals_.data());
    return 1 / (key_start(key + 1) - key_start(key));
  }

  static Jet at_unit(const Interval& q, double u);  // derivatives with respect to u

  int shift_;
  std::int64_t first_key_;
  double x_min_;
  std::vector<Interval> intervals_;
};

class OctaveCurve::Lookup {
 public:
  Lookup() = default;
  double x_min() const { return x_min_; }
  // An Index says where x lies in the table.
  struct Index {
    const double* coefficients;  // of its interval: kTerms, of ascending powers of u
    double u, inverse_width;     // the position in the interval, 0 to 1, and du/dx
  };
  // The bits of x hold all three.  The interval's number ends where u begins, and the interval's
  // width is 2^-bits of the octave that the exponent names.
  Index operator()(double x) const {
    constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1,
                            kOne = std::uint64_t{1023} << 52;
    const double above = x > x_min_ ? x : x_min_;
    const auto bits = std::bit_cast<std::uint64_t>(above < x_last_ ? above : x_last_);
    const auto parts = static_cast<std::uint64_t>(52 - shift_);
    const std::uint64_t beyond = (bits << parts) & kMantissa;
    return {coefficients_ + kTerms * (static_cast<std::int64_t>(bits >> shift_) - first_key_),
            std::bit_cast<double>(beyond | kOne) - 1,
            std::bit_cast<double>((2 * 1023 + parts - (bits >> 52)) << 52)};
  }

 private:
  friend class OctaveCurve;
  const double* coefficients_ = nullptr;
  std::int64_t first_key_ = 0;
  int shift_ = 0;
  double x_min_ = 0, x_last_ = 0;
};

inline OctaveCurve::Lookup OctaveCurve::lookup() const {
  Lookup l;
  l.coefficients_ = intervals_.front().c.data();
  l.first_key_ = first_key_;
  l.shift_ = shift_;
  l.x_min_ = x_min_;
  const auto end = static_cast<std::uint64_t>(first_key_) + intervals_.size();
  l.x_last_ = std::bit_cast<double>((end << shift_) - 1);
  return l;
}

}  // namespace domefall
