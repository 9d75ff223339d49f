#include "pipeline/light/kerr_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace domefall {
namespace {

constexpr int kOrder = 24;

template <class T>
using PowerSeries = std::array<T, kOrder + 1>;

// The coefficients of N's Taylor series, and of N_z^2.
template <class T>
struct Expansion {
  std::array<PowerSeries<T>, 3> n;
  PowerSeries<T> squared;

  explicit Expansion(const KerrSphere<T>& at) {
    for (std::size_t i = 0; i < 3; ++i) n[i][0] = at.place[i], n[i][1] = at.speed[i];
    const double a2 = at.spin * at.spin;
    PowerSeries<T>& u = n[2];
    for (std::size_t k = 0; k + 2 <= kOrder; ++k) {
      squared[k] = u[0] * u[k];
      for (std::size_t i = 1; i <= k; ++i) squared[k] = squared[k] + u[i] * u[k - i];
      // The three sums go on side by side, which no processor waits for.
      std::array<T, 3> sum;
      for (std::size_t j = 0; j < 3; ++j) sum[j] = squared[0] * n[j][k];
      for (std::size_t i = 1; i <= k; ++i)
        for (std::size_t j = 0; j < 3; ++j) sum[j] = sum[j] + squared[i] * n[j][k - i];
      const double over = -1.0 / static_cast<double>((k + 1) * (k + 2));
      for (std::size_t j = 0; j < 3; ++j)
        n[j][k + 2] = over * ((j == 2 ? at.c - a2 : at.c) * n[j][k] + 2 * a2 * sum[j]);
    }
  }

  // Returns how far the series are good to the last digit.
  double reach() const {
    double least = 1e300;
    for (std::size_t k = kOrder - 1; k <= kOrder; ++k) {
      double most = 1e-300;
      for (const PowerSeries<T>& s : n) most = std::max(most, std::abs(value(s[k])));
      least = std::min(least, std::pow(1e-17 / most, 1.0 / static_cast<double>(k)));
    }
    return least;
  }
};

template <class T>
T value_at(const PowerSeries<T>& s, double x) {
  T sum = s[kOrder];
  for (int k = kOrder - 1; k >= 0; --k) sum = sum * x + s[static_cast<std::size_t>(k)];
  return sum;
}

// A value and its derivative, and those of all three series, go on side by side.
template <class T, std::size_t kCount>
struct Along {
  std::array<T, kCount> value, slope;

  Along(const PowerSeries<T>* series, double x) {
    for (std::size_t j = 0; j < kCount; ++j) value[j] = series[j][kOrder], slope[j] = T(0);
    for (std::size_t k = kOrder; k-- > 0;)
      for (std::size_t j = 0; j < kCount; ++j) {
        slope[j] = slope[j] * x + value[j];
        value[j] = value[j] * x + series[j][k];
      }
  }
};

template <class T>
double integral_to(const PowerSeries<T>& s, double x) {
  double sum = 0;
  for (int k = kOrder - 2; k >= 0; --k)
    sum = (sum + value(s[static_cast<std::size_t>(k)]) / (k + 1)) * x;
  return sum;
}

// Returns the zero of u between two places where its signs differ.
double zero_between(const PowerSeries<double>& u, double low, double high) {
  const bool rising = value_at(u, high) > 0;
  double x = (low + high) / 2;
  for (int i = 0; i < 60; ++i) {
    const Along<double, 1> at(&u, x);
    ((at.value[0] > 0) == rising ? high : low) = x;
    double next = x - at.value[0] / at.slope[0];
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - x) <= 1e-16 * std::abs(x)) return next;
    x = next;
  }
  return x;
}

template <class T>
T dual_number(long double v, long double by_delta = 0, long double by_eta = 0) {
  if constexpr (std::is_same_v<T, Dual>)
    return {static_cast<double>(v), static_cast<double>(by_delta), static_cast<double>(by_eta)};
  else
    return static_cast<double>(v);
}

// Returns the Mino time of half a turn of u = N_z, where there are any.  With
//
//     u'^2 = Q - b u^2 - a^2 u^4    Q = kappa^2 - g^2    b = kappa^2 + 2 a g    g = L - a
//
// it is a complete elliptic integral, pi over an arithmetic-geometric mean.
template <class T>
T half_turn_of(const KerrStart& start) {
  using std::sqrt;
  const Scaled &f = start.azimuthal, &kappa = start.kappa;
  const auto a = static_cast<double>(start.at.hole.spin);
  const T k = dual_number<T>(kappa.v, kappa.by_delta, kappa.by_eta),
          g = dual_number<T>(start.sine * f.v - start.at.hole.spin, start.sine * f.by_delta,
                             start.sine * f.by_eta);
  const T q = k * k - g * g, b = k * k + 2 * a * g;
  if (!(value(q) > 0)) return T(0);
  const T root = sqrt(b * b + 4 * a * a * q);
  T one = sqrt((b + root) / 2), other = sqrt(root);
  while (std::abs(value(one) - value(other)) > 1e-15 * value(other)) {
    const T mean = sqrt(one * other);
    one = (one + other) / 2;
    other = mean;
  }
  return std::numbers::pi / one;
}

}  // namespace

template <class T>
KerrSphere<T> kerr_sphere_of(const KerrStart& start) {
  const long double a = start.at.hole.spin;
  const long double sine = start.sine, cosine = start.cosine;
  const Scaled &k = start.kappa, &mu = start.mu, &p = start.polar, &f = start.azimuthal;
  KerrSphere<T> sphere{};
  sphere.spin = static_cast<double>(a);
  const auto derivative = [&](long double Scaled::*by) { return 2 * (k.v * (k.*by) + (mu.*by)); };
  sphere.c = dual_number<T>(k.v * k.v + 2 * mu.v + a * a * (sine - cosine) * (sine + cosine),
                            derivative(&Scaled::by_delta), derivative(&Scaled::by_eta));
  sphere.half_turn = half_turn_of<T>(start);
  sphere.place = {dual_number<T>(sine), dual_number<T>(0), dual_number<T>(cosine)};
  sphere.speed = {dual_number<T>(-cosine * p.v, -cosine * p.by_delta, -cosine * p.by_eta),
                  dual_number<T>(-f.v, -f.by_delta, -f.by_eta),
                  dual_number<T>(sine * p.v, sine * p.by_delta, sine * p.by_eta)};
  return sphere;
}

template <class T>
void KerrSphere<T>::follow(double mino, bool with_crossings) {
  constexpr int kLooks = 4;  // a step, which is shorter than a turn
  // Where the observer is on the equator, this is no crossing.
  const bool on_equator = std::abs(value(place[2])) < 1e-15;
  for (double done = 0; done < mino;) {
    const Expansion<T> series(*this);
    PowerSeries<double> u;
    for (std::size_t k = 0; k <= kOrder; ++k) u[k] = value(series.n[2][k]);
    const double reach = series.reach();
    const bool ends = reach >= mino - done;
    const double step = ends ? mino - done : reach;
    const Along<T, 3> end(series.n.data(), step);
    double rise = u[1], height = done == 0 && on_equator ? 0 : u[0];
    if (rise == 0) rise = u[2];
    for (int i = 1; i <= kLooks; ++i) {
      const double x = step * i / kLooks, before = step * (i - 1) / kLooks;
      const Along<double, 1> at(&u, x);
      const double rises = at.slope[0], there = at.value[0];
      if ((rises > 0) != (rise > 0) && rise != 0) ++turns;
      if (with_crossings && height != 0 && (there > 0) != (height > 0)) {
        const double zero = zero_between(u, before, x);
        crossings.push_back(
            {done + zero,
             {value(value_at(series.n[0], zero)), value(value_at(series.n[1], zero)), 0},
             squares + integral_to(series.squared, zero)});
      }
      rise = rises, height = there;
    }
    if (with_crossings) squares += integral_to(series.squared, step);
    place = end.value, speed = end.slope;
    if (ends) return;
    done += step;
  }
}

// Each half turn mirrors N in the equator and turns it about the axis, all by the same angle.
template <class T>
void KerrSphere<T>::follow(const T& mino) {
  using std::atan2, std::cos, std::sin;
  constexpr int kWorthIt = 3;
  T rest = mino;
  const double count = value(half_turn) > 0 ? std::floor(value(mino) / value(half_turn)) : 0;
  if (count >= kWorthIt) {
    KerrSphere half = *this;
    half.follow(half_turn);
    // Of the place and of the speed, one may be small.
    double square = 0;
    for (const T& v : speed) square += value(v) * value(v);
    const auto product = [&](std::size_t i, std::size_t j) {
      return place[i] * half.place[j] + speed[i] * half.speed[j] / square;
    };
    const T angle = count * atan2(product(0, 1) - product(1, 0), product(0, 0) + product(1, 1));
    const T c = cos(angle), s = sin(angle);
    const double mirror = std::fmod(count, 2) == 0 ? 1 : -1;
    for (std::array<T, 3>* v : {&place, &speed})
      *v = {(*v)[0] * c - (*v)[1] * s, (*v)[0] * s + (*v)[1] * c, (*v)[2] * mirror};
    turns += static_cast<int>(count);
    rest = mino - count * half_turn;
  }
  follow(value(rest), false);
  const T late = rest - value(rest), pull = c + 2 * spin * spin * place[2] * place[2];
  const std::array<T, 3> there = place;
  for (std::size_t i = 0; i < 3; ++i) place[i] = place[i] + speed[i] * late;
  speed[0] = speed[0] - pull * there[0] * late, speed[1] = speed[1] - pull * there[1] * late;
  speed[2] = speed[2] - (pull - spin * spin) * there[2] * late;
}

template struct KerrSphere<double>;
template struct KerrSphere<Dual>;
template KerrSphere<double> kerr_sphere_of<double>(const KerrStart& start);
template KerrSphere<Dual> kerr_sphere_of<Dual>(const KerrStart& start);

}  // namespace domefall
