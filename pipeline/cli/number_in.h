// A check of an option's number like CLI::Range, which lets NaN pass.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace domefall {

inline CLI::Validator number_in(double low, double high) {
  const CLI::Range range(low, high);
  return CLI::Validator(
      [low, high, range](std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && !(value >= low && value <= high))
          return "the value " + text + " is not from " + CLI::detail::to_string(low) + " to " +
                 CLI::detail::to_string(high);
        return range(text);
      },
      range.get_description());
}

}  // namespace domefall
