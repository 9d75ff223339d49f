// trace_spin_ray() gives one ray near a hole that spins, is charged, both or neither, by numbers, for an
// observer who moves as the tetrad T (kerr_start.h).  `domefall trace` prints this.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pipeline/light/kerr_start.h"
#include "trajectories/directions.h"

namespace domefall {

// A SpinRay gives delta, or an edge and perhaps an offset from it.  With both, delta must be the edge's
// plus the offset, to 1e-9.
struct SpinRay {
  KerrHole hole;
  long double r = 0, theta = 0, eta = 0;
  std::optional<long double> delta{};
  std::string edge;  // silhouette, region3, inner where nothing spins, or empty
  std::optional<long double> offset{};
};

struct TracedSpinRay {
  // I, III, H (the past horizon) or B (nowhere, without horizons), and what lies beyond it: E, S or B.
  // Both are empty inside the inner horizon of a hole that spins.
  std::string_view origin, beyond;
  double one_plus_z = 0;
  // Where on that sky, if any.
  std::optional<V3d> sky{};
  double amplification = 0, mino = 0;
  int turns = 0;
};
// Throws InputError for what is no ray.
TracedSpinRay trace_spin_ray(const SpinRay& asked);

struct KerrQuestion {
  KerrPlace at;
  KerrDirection direction;
};
// Returns a ray's place and direction, or nothing inside the inner horizon of a hole that spins.  Throws
// InputError for what is no ray.
std::optional<KerrQuestion> kerr_question(const SpinRay& ray);

}  // namespace domefall
