#include "pipeline/render/sphere_blur.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <kissfft/kissfft.hh>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/base/simd/vector_math.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The real and imaginary parts of three colours, and two zeros that make them one SIMD vector.
using Parts = std::array<float, kLanes>;

[[gnu::always_inline]] inline void add_times(const Parts& parts, float factor, Lanes& sum) {
  Lanes lanes;
  std::memcpy(&lanes, parts.data(), sizeof lanes);
  sum += factor * lanes;
}

// OrderRows are the rows of one hemisphere, in which each harmonic is even or odd about the equator.
struct OrderRows {
  std::vector<double> cosine, last,
      now;  // of theta; the associated Legendre functions of l - 1 and l
  std::vector<float> legendre;
  // By the parity of l - m: what the rows are, and what becomes of them.
  std::array<std::vector<Parts>, 2> light, blurred;
};

// Multiplies the coefficient of one harmonic by k, and adds it to what the rows become.
[[gnu::always_inline]] inline void pass_harmonic_loop(const float* legendre, const Parts* light,
                                                      int rows, float k, Parts* blurred) {
  // Four sums do not wait for each other's additions.
  Lanes a = {}, b = {}, c = {}, d = {};
  for (int j = 0; j < rows; j += 4) {
    add_times(light[j], legendre[j], a);
    add_times(light[j + 1], legendre[j + 1], b);
    add_times(light[j + 2], legendre[j + 2], c);
    add_times(light[j + 3], legendre[j + 3], d);
  }
  const Lanes sum = k * ((a + b) + (c + d));
  for (int j = 0; j < rows; ++j) {
    Lanes lanes = legendre[j] * sum;
    add_times(blurred[j], 1, lanes);
    std::memcpy(blurred[j].data(), &lanes, sizeof lanes);
  }
}
Dispatched<pass_harmonic_loop> pass_harmonic;

// Goes from the functions of l - 1 and l to that of l + 1, a cos(theta) P_l - b P_(l-1).
[[gnu::always_inline]] inline void raise_loop(double a, double b, const double* cosine, int rows,
                                              double* last, const double* now, float* legendre) {
  for (int j = 0; j < rows; ++j) {
    last[j] = a * cosine[j] * now[j] - b * last[j];
    legendre[j] = static_cast<float>(last[j]);
  }
}
Dispatched<raise_loop> raise_order;

// Blurs what all rows have of exp(i m phi).  Next to the poles a function of a high m is below the
// least double, and so is all that it has there of the orders that are used.
void blur_one(int m, std::span<const double> kernel, OrderRows& rows) {
  const int count = static_cast<int>(rows.cosine.size()), orders = static_cast<int>(kernel.size());
  double norm = 1 / (4 * pi);  // of P_mm = sqrt(norm) sin^m, up to a sign
  for (int k = 1; k <= m; ++k) norm *= 1 + 0.5 / k;
  for (std::size_t j = 0; j < rows.cosine.size(); ++j) {
    const double sine = std::sqrt(1 - rows.cosine[j] * rows.cosine[j]);
    rows.now[j] = std::sqrt(norm) * std::pow(sine, m);
    rows.last[j] = 0;
    rows.legendre[j] = static_cast<float>(rows.now[j]);
  }
  for (auto& blurred : rows.blurred) std::ranges::fill(blurred, Parts{});
  double before = 0;  // sqrt((l^2 - m^2)/(4 l^2 - 1))
  for (int l = m; l < orders; ++l) {
    const auto parity = static_cast<std::size_t>((l - m) % 2);
    pass_harmonic(rows.legendre.data(), rows.light[parity].data(), count,
                  static_cast<float>(kernel[static_cast<std::size_t>(l)]),
                  rows.blurred[parity].data());
    const double next = l + 1,
                 after = std::sqrt((next * next - double(m) * m) / (4 * next * next - 1));
    raise_order(1 / after, before / after, rows.cosine.data(), count, rows.last.data(),
                rows.now.data(), rows.legendre.data());
    std::swap(rows.last, rows.now);
    before = after;
  }
}

// Returns a number of rows, at least so many, that come in pairs of fours.  A Fourier transform is quick
// where it has no prime factor beyond 5.
int quick_rows(double least) {
  for (int fours = static_cast<int>(std::ceil(least / 8));; ++fours) {
    int left = fours;
    for (const int prime : {2, 3, 5})
      while (left % prime == 0) left /= prime;
    if (left == 1) return 8 * fours;
  }
}

}  // namespace

SphereBlur::SphereBlur(double least_sigma)
    : orders_(static_cast<int>(std::ceil(4 / least_sigma)) + 1),
      rows_(quick_rows(2 * pi / least_sigma)),
      columns_(2 * rows_),
      step_(pi / rows_),
      grid_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_)) {}

SphereBlur::Place SphereBlur::place(const CameraDirection& n) const {
  const double theta = arc_tangent2(std::sqrt(n.v.x * n.v.x + n.v.y * n.v.y), n.v.z),
               phi = arc_tangent2(n.v.y, n.v.x);
  const double down = theta / step_ - 0.5, across = (phi + pi) / step_;
  const double row = std::floor(down), column = std::floor(across);
  return {static_cast<int>(row), static_cast<int>(column), static_cast<float>(down - row),
          static_cast<float>(across - column)};
}

// Beyond a pole a row is the same one, half a turn on.
std::array<std::size_t, 4> SphereBlur::points(const Place& place) const {
  std::array<std::size_t, 4> found;
  for (int k = 0; k < 4; ++k) {
    const int row = place.row + k / 2, inside = std::clamp(row, 0, rows_ - 1);
    const int column = place.column + k % 2 + (row == inside ? 0 : columns_ / 2);
    found[static_cast<std::size_t>(k)] =
        static_cast<std::size_t>(inside) * static_cast<std::size_t>(columns_) +
        static_cast<std::size_t>(column % columns_);
  }
  return found;
}

namespace {

std::array<float, 4> weights(const SphereBlur::Place& p) {
  return {(1 - p.down) * (1 - p.across), (1 - p.down) * p.across, p.down * (1 - p.across),
          p.down * p.across};
}

}  // namespace

void SphereBlur::add(const Place& place, const Rgb& light) {
  const auto of = points(place);
  const auto weight = weights(place);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 3; ++c) grid_[of[k]][c] += weight[k] * light[c];
}

SphereBlur::Rgb SphereBlur::at(const Place& place) const {
  const auto of = points(place);
  const auto weight = weights(place);
  Rgb sum{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight[k] * grid_[of[k]][c];
  return sum;
}

void SphereBlur::blur(std::span<const double> kernel) {
  const auto rows = static_cast<std::size_t>(rows_), columns = static_cast<std::size_t>(columns_),
             orders = static_cast<std::size_t>(orders_), half = rows / 2;
  using Complex = std::complex<float>;
  // Of some sizes a transform has memory of its own, so that each thread needs one.
  tbb::enumerable_thread_specific<kissfft<float>> forward(columns, false), backward(columns, true);
  std::vector<Parts> waves(orders * rows);  // [m][row]
  tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t j) {
    std::vector<Complex> row(columns), transformed(columns);
    const kissfft<float>& fft = forward.local();
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < columns; ++i) row[i] = grid_[j * columns + i][c];
      // Half of the sphere is dark about a dome.
      if (std::ranges::all_of(row, [](const Complex& light) { return light == Complex{}; }))
        continue;
      fft.transform(row.data(), transformed.data());
      for (std::size_t m = 0; m < orders; ++m) {
        Parts& wave = waves[m * rows + j];
        wave[2 * c] = transformed[m].real();
        wave[2 * c + 1] = transformed[m].imag();
      }
    }
  });
  tbb::parallel_for(std::size_t{0}, orders, [&](std::size_t m) {
    OrderRows of;
    of.last.resize(half), of.now.resize(half), of.legendre.resize(half);
    for (std::size_t p = 0; p < 2; ++p) of.light[p].resize(half), of.blurred[p].resize(half);
    Parts* const wave = &waves[m * rows];
    for (std::size_t j = 0; j < half; ++j) {
      of.cosine.push_back(std::cos((static_cast<double>(j) + 0.5) * step_));
      for (std::size_t c = 0; c < wave[j].size(); ++c) {
        of.light[0][j][c] = wave[j][c] + wave[rows - 1 - j][c];
        of.light[1][j][c] = wave[j][c] - wave[rows - 1 - j][c];
      }
    }
    blur_one(static_cast<int>(m), kernel, of);
    for (std::size_t j = 0; j < half; ++j)
      for (std::size_t c = 0; c < wave[j].size(); ++c) {
        wave[j][c] = of.blurred[0][j][c] + of.blurred[1][j][c];
        wave[rows - 1 - j][c] = of.blurred[0][j][c] - of.blurred[1][j][c];
      }
  });
  tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t j) {
    std::vector<Complex> row(columns), transformed(columns);
    const kissfft<float>& fft = backward.local();
    for (std::size_t c = 0; c < 3; ++c) {
      std::ranges::fill(row, Complex{});
      for (std::size_t m = 0; m < orders; ++m) {
        const Parts& wave = waves[m * rows + j];
        // The waves of -m are the conjugates of those of m.
        row[m] = Complex(wave[2 * c], wave[2 * c + 1]) * (m == 0 ? 1.0f : 2.0f);
      }
      fft.transform(row.data(), transformed.data());
      for (std::size_t i = 0; i < columns; ++i) grid_[j * columns + i][c] = transformed[i].real();
    }
  });
}

}  // namespace domefall
