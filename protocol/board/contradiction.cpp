#include "protocol/board/contradiction.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::board {
namespace {

using Kind = Contradiction::Kind;

std::optional<Contradiction> contradiction_of(const JudgedSettings& settings, std::size_t channel) {
  const JudgedChannel& c = settings.channels[channel];
  const std::uint64_t period = shortest_trigger_period(settings.clock_hz, settings.prf_millihertz,
                                                       settings.jitter_ppm, settings.stagger_ppm);
  const std::uint64_t needed = c.length() + settings.delay_ticks;
  if (needed > period) return Contradiction{Kind::sweep_length, channel, needed, period};
  if (c.mode == DecimationMode::sum) {
    const std::uint64_t strongest = (std::uint64_t{1} << c.bits) - 1;
    const std::uint64_t sum = c.decimation * strongest;
    if (sum > 0xFFFF) return Contradiction{Kind::sum_width, channel, sum, 0xFFFF / strongest};
  }
  if (c.test_mode == TestMode::target && c.test_value >= c.samples) {
    return Contradiction{Kind::target, channel, c.test_value, c.samples - 1};
  }
  return std::nullopt;
}

}  // namespace

std::uint64_t shortest_trigger_period(std::uint32_t clock_hz, std::uint32_t prf_millihertz,
                                      std::uint32_t jitter_ppm, std::uint32_t stagger_ppm) {
  constexpr std::uint64_t kParts = 1'000'000;
  const std::uint64_t period = std::uint64_t{clock_hz} * 1000 / prf_millihertz;
  const std::uint64_t off = period * jitter_ppm / kParts + period * stagger_ppm / kParts;
  return period - std::min(period, 2 * off);
}

std::optional<Contradiction> contradiction_in(const JudgedSettings& settings) {
  if (settings.pulse_code > settings.pulse_codes) {
    return Contradiction{Kind::pulse_code, 0, settings.pulse_code, settings.pulse_codes};
  }
  const double duty = settings.pulse_s * settings.prf_millihertz / 1000.0;
  if (duty > kMostDutyCycle) {
    const auto most = static_cast<std::uint64_t>(std::floor(kMostDutyCycle / settings.pulse_s));
    return Contradiction{Kind::duty_cycle, 0, 0, most, duty};
  }
  std::uint64_t samples = 0;
  for (std::size_t channel = 0; channel < settings.channels.size(); ++channel) {
    if (!settings.channels[channel].is_on) continue;
    samples += settings.channels[channel].samples;
    if (const auto found = contradiction_of(settings, channel)) return found;
  }
  if (samples > settings.fifo_depth) {
    return Contradiction{Kind::fifo_depth, 0, samples, settings.fifo_depth};
  }
  return std::nullopt;
}

}  // namespace skerry::board
