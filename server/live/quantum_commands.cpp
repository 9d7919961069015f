#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "server/live/live_commands.hpp"

namespace skerry::server {
namespace {

using raymarine::QuantumControl;
using raymarine::QuantumMode;

constexpr std::string_view kQuantum = "Raymarine Quantum";
constexpr double kRejectionStep = 20.0;  // positions 0 .. 5
// The radar says 63 for 62.5 thousandths of a mile.
constexpr double kSameQuantumRange = 0.02;

std::int32_t whole(double percent) {
  return static_cast<std::int32_t>(std::lround(std::clamp(percent, 0.0, 100.0)));
}

std::optional<QuantumMode> mode_of(wire::PictureMode mode) {
  switch (mode) {
    case wire::HARBOUR:
      return QuantumMode::harbour;
    case wire::OFFSHORE:
      return QuantumMode::offshore;
    case wire::WEATHER:
      return QuantumMode::weather;
    default:
      return std::nullopt;
  }
}

}  // namespace

Commands quantum_commands(const wire::Set& set, const wire::Settings&) {
  wire::Set rest = changes_of(set);
  std::vector<Bytes> out;
  const auto send = [&out](QuantumControl control, std::int32_t value) {
    out.push_back(raymarine::encode_quantum_command(control, value));
  };
  if (rest.has_mode()) {
    const auto mode = mode_of(rest.mode());
    if (!mode) return Failure{fmt::format("a {} has no such mode", kQuantum)};
    send(QuantumControl::mode, static_cast<std::int32_t>(*mode));
    rest.clear_mode();
  }
  if (rest.has_range_nm()) {
    const auto& ranges = raymarine::kQuantumRanges;
    const double wanted = rest.range_nm() * 1000.0;
    const auto nearest = std::min_element(ranges.begin(), ranges.end(), [&](double a, double b) {
      return std::fabs(a - wanted) < std::fabs(b - wanted);
    });
    if (!(std::fabs(*nearest - wanted) <= kSameQuantumRange * wanted)) {
      return Failure{fmt::format("range: a {} has no range of {:g} NM; allowed: 1/32 to 64 NM",
                                 kQuantum, rest.range_nm())};
    }
    send(QuantumControl::range_index, static_cast<std::int32_t>(nearest - ranges.begin()));
    rest.clear_range_nm();
  }
  if (rest.has_gain_auto()) send(QuantumControl::gain_auto, rest.gain_auto());
  rest.clear_gain_auto();
  if (rest.has_gain()) send(QuantumControl::gain, whole(rest.gain()));
  rest.clear_gain();
  if (rest.has_sea_auto()) send(QuantumControl::sea_auto, rest.sea_auto());
  rest.clear_sea_auto();
  if (rest.has_sea()) send(QuantumControl::sea, whole(rest.sea()));
  rest.clear_sea();
  if (rest.has_rain()) {
    send(QuantumControl::rain_on, rest.rain() > 0.0);
    if (rest.rain() > 0.0) send(QuantumControl::rain, whole(rest.rain()));
  }
  rest.clear_rain();
  if (rest.has_echo_stretch()) send(QuantumControl::expansion, rest.echo_stretch() > 0.0);
  rest.clear_echo_stretch();
  if (rest.has_interference_rejection()) {
    send(QuantumControl::rejection,
         static_cast<std::int32_t>(std::lround(rest.interference_rejection() / kRejectionStep)));
  }
  rest.clear_interference_rejection();
  if (rest.has_bearing_alignment_deg()) {
    send(QuantumControl::bearing_offset,
         static_cast<std::int32_t>(std::lround(rest.bearing_alignment_deg() * 10.0)));
  }
  rest.clear_bearing_alignment_deg();
  if (rest.has_transmit()) send(QuantumControl::transmit, rest.transmit());
  rest.clear_transmit();
  if (const auto lacking = lacking_in(rest, kQuantum)) return Failure{*lacking};
  return out;
}

}  // namespace skerry::server
