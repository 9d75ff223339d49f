#include "pipeline/report/integrated_fall.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <stdexcept>

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;

constexpr double kSingular = 1e-6;  // M
constexpr double kFirstStep = 0.01;
constexpr int kMostSteps = 20'000'000;

// The Numbers of a body are x, y, the celerity along both axes, and gamma.  They begin as 0 because
// Odeint also copies buffers that it has not filled yet.
struct Numbers : std::array<double, 5> {
  Numbers() : std::array<double, 5>{} {}
};

// Returns the state in polar form: the celerity by its parts along n and at right angles to it.
FallState polar(const Numbers& y, double azimuth) {
  const double r = std::hypot(y[0], y[1]);
  return {r, azimuth, y[4], (y[0] * y[2] + y[1] * y[3]) / r, (y[0] * y[3] - y[1] * y[2]) / r};
}

// Evaluates the equations of integrated_fall.h.  A trial step may come nearer to the centre than
// the singular radius, where r is held so that all rates stay finite.
void geodesic(const Numbers& y, Numbers& rate, double /*tau*/) {
  const double r = std::max(std::hypot(y[0], y[1]), kSingular), gamma = y[4];
  const double nx = y[0] / r, ny = y[1] / r, s = std::sqrt(2 / r);
  // Here w is c.n, and `pull` is the factor s gamma/r of c'.
  const double w = y[2] * nx + y[3] * ny, pull = s * gamma / r;
  rate[0] = y[2] - s * gamma * nx, rate[1] = y[3] - s * gamma * ny;
  rate[2] = pull * (y[2] - 1.5 * w * nx), rate[3] = pull * (y[3] - 1.5 * w * ny);
  rate[4] = s / r * (y[2] * y[2] + y[3] * y[3] - 1.5 * w * w);
}

// Returns the longest step (M).  A longer one could pass the centre, or lose count of a turn.  By
// x' = c - s gamma n the radius changes at the rate c.n - s gamma, and the azimuth at the rate of
// the tangential celerity over r.  If the radius alone changed, this step would be half of the way
// to the centre.  If the azimuth alone did, it would be 2 radians, which is below the pi up to
// which advance() sees an angle rightly.
double longest_step(const FallState& p) {
  const double speed = p.radial - std::sqrt(2 / p.r) * p.gamma;
  return 0.5 * p.r / (std::abs(speed) + std::abs(p.tangential) / 4);
}

template <class Pair>
class Fall {
 public:
  Fall(const FallState& start, double tolerance)
      : tolerance_(tolerance), pair_(checker()), azimuth_(start.azimuth) {
    const double c = std::cos(azimuth_), s = std::sin(azimuth_);
    y_[0] = start.r * c, y_[1] = start.r * s;
    y_[2] = start.radial * c - start.tangential * s;
    y_[3] = start.radial * s + start.tangential * c;
    y_[4] = start.gamma;
  }

  // Returns the state at tau, which may not be less than at the call before.
  FallState at(double tau) {
    while (tau_ + step_ <= tau && alive()) advance(step_);
    if (!alive()) return lost();
    Fall branch = *this;  // a copy, so that the wanted times do not choose the steps
    branch.pair_ = Controlled(checker());
    while (branch.tau_ < tau && branch.alive()) branch.advance(tau - branch.tau_);
    steps_ = branch.steps_;
    return branch.alive() ? polar(branch.y_, branch.azimuth_) : branch.lost();
  }

 private:
  using Controlled = odeint::controlled_runge_kutta<Pair>;

  typename Controlled::error_checker_type checker() const { return {tolerance_, tolerance_}; }
  bool alive() const { return std::hypot(y_[0], y_[1]) > kSingular; }
  // Returns the last state before the singularity, with r = 0 to mark it.
  FallState lost() const {
    FallState last = polar(y_, azimuth_);
    last.r = 0;
    return last;
  }

  // Tries one step of at most `most`.  If its error is too large, the state stays and the next step
  // is shorter.  The angle between the two places is added, so that whole turns are counted.
  void advance(double most) {
    if (++steps_ > kMostSteps)
      throw std::runtime_error(fmt::format("a fall takes more than {} steps", kMostSteps));
    const Numbers before = y_;
    double tried = std::min(step_, most);
    const double end = tau_ + tried;
    if (pair_.try_step(geodesic, y_, tau_, tried) == odeint::success) {
      tau_ = end;
      azimuth_ +=
          std::atan2(before[0] * y_[1] - before[1] * y_[0], before[0] * y_[0] + before[1] * y_[1]);
    }
    step_ = alive() ? std::min(tried, longest_step(polar(y_, azimuth_))) : tried;
  }

  double tolerance_;
  Controlled pair_;
  Numbers y_;
  double azimuth_, tau_ = 0, step_ = kFirstStep;
  int steps_ = 0;
};

template <class Pair>
std::vector<FallState> states_at(Fall<Pair> fall, const std::vector<double>& taus) {
  std::vector<FallState> states;
  states.reserve(taus.size());
  for (const double tau : taus) states.push_back(fall.at(tau));
  return states;
}

}  // namespace

std::vector<FallState> integrate_fall(const FallState& start, const std::vector<double>& taus,
                                      FallMethod method, double tolerance) {
  using odeint::array_algebra;
  using Dopri5 = odeint::runge_kutta_dopri5<Numbers, double, Numbers, double, array_algebra>;
  using Fehlberg78 =
      odeint::runge_kutta_fehlberg78<Numbers, double, Numbers, double, array_algebra>;
  if (method == FallMethod::kDopri5) return states_at(Fall<Dopri5>(start, tolerance), taus);
  return states_at(Fall<Fehlberg78>(start, tolerance), taus);
}

}  // namespace domefall
