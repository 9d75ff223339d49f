#include "pipeline/light/kerr_sphere.h"

#include <algorithm>
#include <cmath>

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
      squared[k] = product(u, u, k);
      const double over = -1.0 / static_cast<double>((k + 1) * (k + 2));
      const double twice = 2 * a2;
      n[0][k + 2] = over * (at.c * n[0][k] + twice * product(squared, n[0], k));
      n[1][k + 2] = over * (at.c * n[1][k] + twice * product(squared, n[1], k));
      u[k + 2] = over * ((at.c - a2) * u[k] + twice * product(squared, u, k));
    }
  }

  static T product(const PowerSeries<T>& a, const PowerSeries<T>& b, std::size_t k) {
    T sum = a[0] * b[k];
    for (std::size_t i = 1; i <= k; ++i) sum = sum + a[i] * b[k - i];
    return sum;
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

template <class T>
T slope_at(const PowerSeries<T>& s, double x) {
  T sum = s[kOrder] * double{kOrder};
  for (int k = kOrder - 1; k >= 1; --k)
    sum = sum * x + s[static_cast<std::size_t>(k)] * static_cast<double>(k);
  return sum;
}

template <class T>
double integral_to(const PowerSeries<T>& s, double x) {
  double sum = 0;
  for (int k = kOrder - 2; k >= 0; --k)
    sum = (sum + value(s[static_cast<std::size_t>(k)]) / (k + 1)) * x;
  return sum;
}

// Returns the zero of u between two places where its signs differ.
template <class T>
double zero_between(const PowerSeries<T>& u, double low, double high) {
  const bool rising = value(value_at(u, high)) > 0;
  double x = (low + high) / 2;
  for (int i = 0; i < 60; ++i) {
    const double f = value(value_at(u, x));
    ((f > 0) == rising ? high : low) = x;
    double next = x - f / value(slope_at(u, x));
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - x) <= 1e-16 * std::abs(x)) return next;
    x = next;
  }
  return x;
}

}  // namespace

template <class T>
void KerrSphere<T>::follow(double mino, bool with_crossings) {
  constexpr int kLooks = 4;  // a step, which is shorter than a turn
  // Where the observer is on the equator, this is no crossing.
  const bool on_equator = std::abs(value(place[2])) < 1e-15;
  for (double done = 0; done < mino;) {
    const Expansion<T> series(*this);
    const PowerSeries<T>& u = series.n[2];
    const double reach = series.reach();
    const bool ends = reach >= mino - done;
    const double step = ends ? mino - done : reach;
    double rise = value(u[1]), height = done == 0 && on_equator ? 0 : value(u[0]);
    if (rise == 0) rise = value(u[2]);
    for (int i = 1; i <= kLooks; ++i) {
      const double x = step * i / kLooks, before = step * (i - 1) / kLooks;
      const double rises = value(slope_at(u, x)), there = value(value_at(u, x));
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
    for (std::size_t i = 0; i < 3; ++i) {
      place[i] = value_at(series.n[i], step);
      speed[i] = slope_at(series.n[i], step);
    }
    if (ends) return;
    done += step;
  }
}

template struct KerrSphere<double>;
template struct KerrSphere<Dual>;

}  // namespace domefall
