#include "echo/receiver/controls.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace skerry::echo {
namespace {

struct Named {
  const char* name;
  double value;
};

std::optional<std::string> fault(const Named& control) {
  if (control.value >= 0.0 && control.value <= 100.0) return std::nullopt;  // false for NaN
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "%s must lie within 0 and 100, is %g", control.name,
                control.value);
  return std::string(text.data());
}

}  // namespace

std::optional<std::string> fault_of(const RadarControls& controls) {
  return fault({"tune", controls.tune});
}

std::optional<std::string> fault_of(const ViewControls& controls) {
  const std::array<Named, 6> all = {Named{"gain", controls.gain},
                                    {"sea", controls.sea},
                                    {"rain", controls.rain},
                                    {"interference_rejection", controls.interference_rejection},
                                    {"echo_stretch", controls.echo_stretch},
                                    {"integration", controls.integration}};
  for (const Named& control : all) {
    if (auto found = fault(control)) return found;
  }
  return std::nullopt;
}

double tune_loss_db(const RadarControls& controls) {
  if (controls.tune_auto) return 0.0;
  const double bandwidths = kTuningSpan * (controls.tune - 50.0) / 50.0;
  return 12.0 * bandwidths * bandwidths;
}

}  // namespace skerry::echo
