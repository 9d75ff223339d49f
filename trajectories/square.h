// square() gives x^2 of an expression that is written once.
#pragma once

namespace domefall {

constexpr double square(double x) { return x * x; }

}  // namespace domefall
