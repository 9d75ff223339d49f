// Options that are numbers within bounds.  NaN does not pass either.
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

// Adds an option for a number from `low` to `high`, whose help names the default.
template <class Number>
CLI::Option* add_number(CLI::App& verb, const char* name, Number& value, const std::string& help,
                        double low, double high) {
  return verb.add_option(name, value, help)->check(number_in(low, high))->capture_default_str();
}

}  // namespace domefall
