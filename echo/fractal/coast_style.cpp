#include "echo/fractal/coast_style.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include "echo/fractal/edge_refiner.hpp"

namespace skerry::echo {

namespace {

// A new method: its row here, its number in CoastMethod, its make function in edge_refiner.hpp, and
// its name in scenario.proto and skerry_echo.h.
constexpr std::array kMethods = {
    CoastMethodRow{CoastMethod::straight, "straight", "straight", "", 1.0, false,
                   make_straight_method},
    CoastMethodRow{CoastMethod::regular_koch, "koch", "regular Koch", "", 1.25, false,
                   make_koch_method},
    CoastMethodRow{CoastMethod::random_koch, "random_koch", "random Koch", "random Koch", 1.175,
                   true, make_koch_method},
    CoastMethodRow{CoastMethod::midpoint, "midpoint", "midpoint", "fBm", 1.5, true,
                   make_midpoint_method},
    CoastMethodRow{CoastMethod::weierstrass, "weierstrass", "Weierstrass", "WMF", 1.5, true,
                   make_weierstrass_method}};

constexpr bool rows_stand_at_their_numbers() {
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    if (static_cast<std::size_t>(kMethods[i].method) != i) return false;
  }
  return true;
}
static_assert(rows_stand_at_their_numbers());

}  // namespace

std::span<const CoastMethodRow> coast_methods() { return kMethods; }

const CoastMethodRow& row_of(CoastMethod method) {
  return kMethods[static_cast<std::size_t>(method)];
}

std::optional<CoastMethod> find_method(std::string_view name) {
  for (const CoastMethodRow& row : kMethods) {
    if (row.name == name) return row.method;
  }
  return std::nullopt;
}

bool depends_on_seed(const CoastStyle& style) {
  if (style.method == CoastMethod::weierstrass) return style.phases == SeriesPhases::random;
  return row_of(style.method).by_chance;
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
