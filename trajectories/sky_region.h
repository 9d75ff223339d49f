// An observer can see light from these skies.  They are those of the two asymptotically flat
// regions, and the past singularity of region IV, which counts as a sky wherever a show lights it.
#pragma once

#include <array>
#include <cstddef>

#include "trajectories/observer_state.h"

namespace domefall {

// A SkyRegion is the region in which light started that reaches the observer.
enum class SkyRegion : char { kI, kIII, kIV };
inline constexpr std::array kEverySky{SkyRegion::kI, SkyRegion::kIII, SkyRegion::kIV};
// These are the skies of the two exteriors.  Only they have stars.
inline constexpr std::array kExteriorSkies{SkyRegion::kI, SkyRegion::kIII};

inline const char* name_of(SkyRegion sky) {
  constexpr std::array kNames{"I", "III", "IV"};
  return kNames[static_cast<std::size_t>(sky)];
}

// Returns the sky of the region, I or III, that a tetrad belongs to.
constexpr SkyRegion own_sky(Tetrad t) { return is_mirrored(t) ? SkyRegion::kIII : SkyRegion::kI; }

// A PerSky has one value for each sky.
template <class T>
struct PerSky {
  std::array<T, kEverySky.size()> values{};  // in the order of kEverySky

  constexpr T& operator[](SkyRegion sky) { return values[static_cast<std::size_t>(sky)]; }
  constexpr const T& operator[](SkyRegion sky) const {
    return values[static_cast<std::size_t>(sky)];
  }
  constexpr auto begin() const { return values.begin(); }
  constexpr auto end() const { return values.end(); }
};

// Says which of the skies I and III an observer sees, where light is bent.  No light of either
// enters region IV.  The sky that is not the tetrad's own is seen inside the future horizon only.
constexpr PerSky<bool> seen_skies(const ObserverState& observer) {
  const bool own = observer.region != Region::kIV;
  const bool other = observer.region == Region::kII && observer.r < 2;
  PerSky<bool> seen;
  for (const SkyRegion sky : kExteriorSkies)
    seen[sky] = sky == own_sky(observer.tetrad) ? own : other;
  return seen;
}

}  // namespace domefall
