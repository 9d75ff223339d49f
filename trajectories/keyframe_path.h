// A KeyframePath is the way of an observer with engines, who follows keyframes: r, the azimuth and the
// angle from the axis are cubics of proper time between them, once continuously differentiable.  A
// rate that a key does not give is chosen so that the path does not overshoot the keys (Fritsch and
// Butland's harmonic mean; 0 at a key that is an extreme).  What the path is in a spacetime is said by
// AcceleratedPath, WormholeFlight and KerrFlight.
#pragma once

#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trajectories/flight_table.h"
#include "trajectories/infinity.h"
#include "trajectories/monotone_cubic.h"
#include "trajectories/orbit_point.h"

namespace domefall {

// Rates are by proper time.
struct PathKey {
  double tau = 0;      // units of M, growing from key to key
  double r = 0;        // in a wormhole l
  double azimuth = 0;  // radians; may go back
  std::optional<double> radial_rate = std::nullopt, azimuth_rate = std::nullopt;
  double theta = std::numbers::pi / 2;  // away from the equator about a hole that spins alone
  std::optional<double> theta_rate = std::nullopt;
};

struct PathPiece {
  double begin, end;  // proper time
  HermiteCubic r, azimuth, theta;

  double span() const { return end - begin; }
  double time(double t) const { return begin + t * span(); }
  double part(double tau) const;  // 0 to 1
};

// Throws the std::domain_error of a path that cannot be flown at, or after, a key (counted from 1).
[[noreturn]] void refuse_key(std::size_t key, double tau, const std::string& why,
                             const char* unit = "units of M");

class KeyframePath {
 public:
  double begin() const {
    return pieces_->front().begin;
  }  // proper times of the first and the last key
  double end() const { return pieces_->back().end; }
  double birth() const;  // the neighbours of begin() and end(), which still belong to the path
  double death() const;
  // Returns the first proper time >= after at which r is passed on that leg, or nothing if it never is.
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  // Returns the least and the largest r, exactly.
  std::pair<double, double> reach() const;

 protected:
  // Throws std::domain_error where there are fewer than two keys, or those are not finite, not in the
  // order of their times, or too close.
  explicit KeyframePath(const std::vector<PathKey>& keys, const char* unit = "units of M");

  const std::vector<PathPiece>& pieces() const { return *pieces_; }
  std::size_t piece_at(double tau) const;
  // Returns a proper time that may miss the ends by rounding, and throws std::domain_error for others.
  double on_path(const ProperTime& tau) const;
  // Returns the table of null time, to_go() from the first key, by the rate at a part of a piece.
  FlightTable null_times(const std::function<double(std::size_t piece, double t)>& rate,
                         double tolerance) const;
  double null_time(const FlightTable& times, double tau) const;

 private:
  const char* unit_;
  std::shared_ptr<const std::vector<PathPiece>> pieces_;
};

}  // namespace domefall
