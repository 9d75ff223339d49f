// The words by which show files and the preview name the effects of a show.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "pipeline/show/show.h"

namespace domefall {

// The effects that are on or off.
inline constexpr std::array<std::pair<std::string_view, bool Effects::*>, 4> kEffectSwitches{
    {{"aberration", &Effects::aberration},
     {"doppler_colour", &Effects::doppler_colour},
     {"intensity", &Effects::intensity},
     {"lensing", &Effects::lensing}}};

inline constexpr std::pair<std::string_view, Amplification> kAmplifications[] = {
    {"stars", Amplification::kStars},
    {"none", Amplification::kNone},
    {"everything", Amplification::kEverything}};

}  // namespace domefall
