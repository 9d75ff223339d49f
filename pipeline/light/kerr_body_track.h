// Where a body is, by v: its places at even steps of v, found when they are asked for.
#pragma once

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "pipeline/light/kerr_pass.h"

namespace domefall {

class KerrBodyTrack {
 public:
  // The rays must outlive this object.
  explicit KerrBodyTrack(const KerrBodyRays& rays)
      : rays_(rays), step_(std::clamp(rays.motion().least_r / 10, 0.1, 0.5)) {}

  struct Spot {
    double w, tau;  // 1/r
    V3d place;      // unit
  };
  // Returns that at a null time, to some part in a thousand, or nothing where it is not found.
  std::optional<Spot> at(double null_time);

 private:
  const std::optional<Spot>& node(long long k);
  std::optional<Spot> found(double null_time, double guess) const;

  const KerrBodyRays& rays_;
  double step_;  // M; what falls in is fast
  std::unordered_map<long long, std::optional<Spot>> nodes_;
};

}  // namespace domefall
