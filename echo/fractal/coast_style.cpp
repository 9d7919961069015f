#include "echo/fractal/coast_style.hpp"

#include <stdexcept>
#include <string>

namespace skerry::echo {

double greatest_dimension(CoastMethod method) {
  switch (method) {
    case CoastMethod::straight:
      return 1.0;
    case CoastMethod::regular_koch:
      return 1.25;
    case CoastMethod::random_koch:
      return 1.175;
    case CoastMethod::midpoint:
    case CoastMethod::weierstrass:
      return 1.5;
  }
  return 1.0;
}

std::string_view name_of(CoastMethod method) {
  switch (method) {
    case CoastMethod::straight:
      return "straight";
    case CoastMethod::regular_koch:
      return "koch";
    case CoastMethod::random_koch:
      return "random_koch";
    case CoastMethod::midpoint:
      return "midpoint";
    case CoastMethod::weierstrass:
      return "weierstrass";
  }
  return "";
}

namespace {

void require_allowed(const char* what, double value, double min, double max) {
  if (value >= min && value <= max) return;  // false for NaN
  throw std::invalid_argument(std::string("coast style: ") + what + " is " + std::to_string(value) +
                              "; allowed: " + std::to_string(min) + " to " + std::to_string(max));
}

}  // namespace

void require_valid(const CoastStyle& style) {
  require_allowed("dimension", style.dimension, 1.0, greatest_dimension(style.method));
  require_allowed("amplitude", style.amplitude, 0.0, 4.0);
  require_allowed("gamma", style.gamma, 1.05, 8.0);
}

}  // namespace skerry::echo
