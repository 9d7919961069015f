#include "server/world/waters/tide.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

using scenario::TideConstituent;

// Degrees an hour, by TideConstituent::Name.
constexpr std::array kSpeeds = {28.9841042, 30.0,       28.4397295, 30.0821373, 15.0410686,
                                13.9430356, 14.9589314, 13.3986609, 57.9682084, 58.9841042};
static_assert(kSpeeds.size() == TideConstituent::Name_ARRAYSIZE);

double hours_of(Duration time) {
  return std::chrono::duration<double, std::ratio<3600>>(time).count();
}

double cosine_of(double degrees) { return echo::sin_cos_degrees(std::fmod(degrees, 360.0)).cos; }

}  // namespace

Tide::Tide(const scenario::Sea& sea)
    : range_m_(sea.tide_range_m()), high_water_h_(sea.high_water_h()) {
  for (const TideConstituent& given : sea.tide()) {
    constituents_.push_back({kSpeeds.at(static_cast<std::size_t>(given.name())),
                             given.amplitude_m(), given.phase_deg()});
    names_.push_back(given.name());
  }
}

const Tide::Constituent* Tide::find(TideConstituent::Name name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? nullptr
                               : &constituents_[static_cast<std::size_t>(found - names_.begin())];
}

double Tide::height_m(Duration time) const {
  if (!has_constituents()) return over_coastline_m(time) + 0.5 * range_m_;
  double height = 0.0;
  for (const Constituent& each : constituents_) {
    height += each.amplitude_m * cosine_of(each.speed_deg_h * hours_of(time) + each.phase_deg);
  }
  return height;
}

double Tide::over_coastline_m(Duration time) const {
  if (!has_constituents()) {
    const double phase = kRadiansPerTurn * (hours_of(time) - high_water_h_) / kTideHours;
    return -0.5 * range_m_ * (1.0 - std::cos(phase));
  }
  double coastline = 0.0;
  for (const auto name : {TideConstituent::m2, TideConstituent::s2}) {
    if (const Constituent* each = find(name)) coastline += each->amplitude_m;
  }
  return height_m(time) - coastline;
}

double Tide::hours_from_high_water(Duration time) const {
  double hours = hours_of(time) - high_water_h_, period = kTideHours;
  if (const Constituent* m2 = find(TideConstituent::m2)) {
    hours = hours_of(time) + m2->phase_deg / m2->speed_deg_h;
    period = 360.0 / m2->speed_deg_h;
  }
  return hours - period * std::round(hours / period);
}

double Tide::springs(Duration time) const {
  const Constituent* const m2 = find(TideConstituent::m2);
  const Constituent* const s2 = find(TideConstituent::s2);
  if (m2 == nullptr || s2 == nullptr || m2->amplitude_m * s2->amplitude_m == 0.0) return 1.0;
  const double apart =
      (s2->speed_deg_h - m2->speed_deg_h) * hours_of(time) + s2->phase_deg - m2->phase_deg;
  const double a = m2->amplitude_m, b = s2->amplitude_m;
  const double both = std::sqrt(std::max(0.0, a * a + b * b + 2.0 * a * b * cosine_of(apart)));
  return std::clamp((both - std::abs(a - b)) / (2.0 * std::min(a, b)), 0.0, 1.0);
}

}  // namespace skerry::server
