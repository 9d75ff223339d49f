#include "trajectories/short_number.h"

#include <fmt/format.h>

namespace domefall {

std::string short_number(double value) { return fmt::format("{:.10g}", value); }

}  // namespace domefall
