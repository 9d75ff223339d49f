// A smooth function of a positive number that spans many octaves, as a table: the intervals divide
// each octave evenly and are found from the bits of x; in each a polynomial of degree 7 matches the
// value and three derivatives at both ends.  Those come from Chebyshev interpolation of the
// function in ln x.
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

  // `f` over [about x_min, x_max], 0 < x_min < x_max; it is asked up to one interval beyond x_max.
  // 2^bits intervals an octave.  The error falls with the eighth power of their width: that of a
  // logarithm is 1e-11 with 3 bits.
  // About 8 calls of f for each octave.
  OctaveCurve(double x_min, double x_max, const std::function<double(double)>& f,
              int bits = kPerOctaveBits);

  double x_min() const { return x_min_; }
  double x_max() const { return start(intervals_.back()); }  // of the last interval, its start
  std::size_t node_count() const { return intervals_.size() + 1; }

  struct Jet {
    double value, first, second;  // f, df/dx, d2f/dx2
  };
  // x in [x_min, x_max].
  Jet at(double x) const;
  double value(double x) const {
    const Interval& q = interval(x);
    return polynomial(q.c, (x - start(q)) * inverse_width(q));
  }
  // The x in [x_min, x_end] with value(x) = wanted, of the same polynomials.  The function must be
  // monotone there and take the value.
  double inverse(double wanted, double x_end) const;

  // Whether every interval that ends before x_end is monotone, all the same way: proven, by the
  // signs of the slope's Bernstein coefficients.
  bool is_monotone(double x_end) const;

  static constexpr int kTerms = 8;

  // Where the polynomials of any number of x stand, without a branch, for loops that are to become
  // SIMD code: a copy of what a look-up needs, which no store of the loop can be taken to alter.
  // Good while the curve lives.  x below x_min is looked up there, x beyond the last interval at
  // its end.
  class Lookup;
  Lookup lookup() const;

 private:
  // The coefficients in 0 <= u <= 1 across it: a line of the cache.
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
  // kTerms of each interval, of powers of u.
  const double* coefficients() const { return coefficients_; }
  struct Spot {
    std::int64_t interval;
    double u, inverse_width;  // the place in it, 0 to 1, and du/dx
  };
  // From the bits of x: the interval's number ends where u begins, and its width is that of an
  // octave's part.
  Spot operator()(double x) const {
    constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1,
                            kOne = std::uint64_t{1023} << 52;
    const double above = x > x_min_ ? x : x_min_;
    const auto bits = std::bit_cast<std::uint64_t>(above < x_last_ ? above : x_last_);
    const auto parts = static_cast<std::uint64_t>(52 - shift_);
    const std::uint64_t beyond = (bits << parts) & kMantissa;
    return {static_cast<std::int64_t>(bits >> shift_) - first_key_,
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
