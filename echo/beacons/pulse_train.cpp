#include "echo/beacons/pulse_train.hpp"

#include <algorithm>

#include "echo/kernel/hash.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

// a mod m in [0, m).
constexpr std::int64_t modulo(std::int64_t a, std::int64_t m) {
  const std::int64_t r = a % m;
  return r < 0 ? r + m : r;
}

}  // namespace

PulseTrain::PulseTrain(double prf_hz, std::uint64_t identity)
    : period_ps_(static_cast<std::int64_t>(
          static_cast<double>(kSecond) / std::clamp(prf_hz, 100.0, 20000.0) + 0.5)),
      phase_ps_(static_cast<std::int64_t>(mixed(0x9125E, identity) %
                                          static_cast<std::uint64_t>(period_ps_))) {}

std::int64_t PulseTrain::wait_ps(ScenarioTime time) const {
  // Nanoseconds modulo the period first: the product stays below 1e13.
  const std::int64_t into =
      modulo(modulo(time.time_since_epoch().count(), period_ps_) * 1000, period_ps_);
  return modulo(phase_ps_ - into, period_ps_);
}

std::uint32_t beam_units(double bearing_deg, double rpm, ScenarioTime time) {
  // A turn is 6e13 / (rpm in thousandths) nanoseconds: counted in that many parts, it is whole.
  constexpr std::int64_t kTurn = 60'000'000'000'000;
  const auto milli_rpm = static_cast<std::uint64_t>(std::clamp(rpm, 1.0, 240.0) * 1000.0 + 0.5);
  const auto at = static_cast<std::uint64_t>(modulo(time.time_since_epoch().count(), kTurn));
  const std::uint64_t part = at * milli_rpm % kTurn;  // < 1.5e19 before
  const auto turned = static_cast<std::uint64_t>(static_cast<double>(part) *
                                                 (kUnitsPerTurn / static_cast<double>(kTurn)));
  return TrueBearing::from(degrees(bearing_deg)).units() + static_cast<std::uint32_t>(turned);
}

}  // namespace skerry::echo
