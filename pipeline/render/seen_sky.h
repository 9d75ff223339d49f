// Where light that is seen started: the skies of regions I and III, and the past singularity, which is
// a sky too if the show lights it.
#pragma once

#include "pipeline/show/frame_state.h"

namespace domefall {

enum class SeenSky : char { kOne, kThree, kFour };
inline constexpr int kSkies = 3;
inline constexpr SeenSky kEverySky[] = {SeenSky::kOne, SeenSky::kThree, SeenSky::kFour};

inline const char* name_of(SeenSky sky) {
  constexpr const char* kNames[] = {"I", "III", "IV"};
  return kNames[static_cast<int>(sky)];
}

inline const Picture::Sky& sky_of(const Picture& picture, SeenSky sky) {
  if (sky == SeenSky::kOne) return picture.sky_one;
  return sky == SeenSky::kThree ? picture.sky_three : picture.sky_four;
}

}  // namespace domefall
