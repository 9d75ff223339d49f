// This file checks that the number of an option lies within its bounds.  NaN does not pass either.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "trajectories/short_number.h"

namespace domefall {

inline CLI::Validator number_in(double low, double high) {
  const std::string bounds = "from " + short_number(low) + " to " + short_number(high);
  return CLI::Validator(
      [low, high, bounds](std::string& text) -> std::string {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value)) return "'" + text + "' is not a number";
        if (!(value >= low && value <= high)) return text + " is not " + bounds;
        return {};
      },
      bounds);
}

}  // namespace domefall
