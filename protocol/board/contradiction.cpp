#include "protocol/board/contradiction.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::board {
namespace {

using Kind = Contradiction::Kind;

void add_contradictions(const JudgedSettings& settings, std::size_t channel,
                        std::vector<Contradiction>& found) {
  const JudgedChannel& c = settings.channels[channel];
  const std::uint64_t period = shortest_trigger_period(settings.clock_hz, settings.prf_millihertz,
                                                       settings.jitter_ppm, settings.stagger_ppm);
  const std::uint64_t needed = c.length() + settings.delay_ticks;
  if (needed > period) found.push_back({Kind::sweep_length, channel, needed, period});
  if (c.mode == DecimationMode::sum) {
    const std::uint64_t strongest = (std::uint64_t{1} << c.bits) - 1;
    const std::uint64_t sum = c.decimation * strongest;
    if (sum > 0xFFFF) found.push_back({Kind::sum_width, channel, sum, 0xFFFF / strongest});
  }
  if (c.test_mode == TestMode::target && c.test_value >= c.samples) {
    found.push_back({Kind::target, channel, c.test_value, c.samples - 1});
  }
}

}  // namespace

std::uint64_t shortest_trigger_period(std::uint32_t clock_hz, std::uint32_t prf_millihertz,
                                      std::uint32_t jitter_ppm, std::uint32_t stagger_ppm) {
  constexpr std::uint64_t kParts = 1'000'000;
  const std::uint64_t period = std::uint64_t{clock_hz} * 1000 / prf_millihertz;
  const std::uint64_t off = period * jitter_ppm / kParts + period * stagger_ppm / kParts;
  return period - std::min(period, 2 * off);
}

std::vector<Contradiction> contradictions_in(const JudgedSettings& settings) {
  if (settings.pulse_code > settings.pulse_codes) {
    return {{Kind::pulse_code, 0, settings.pulse_code, settings.pulse_codes}};
  }
  std::vector<Contradiction> found;
  const double duty = settings.pulse_s * settings.prf_millihertz / 1000.0;
  if (duty > kMostDutyCycle) {
    const auto most = static_cast<std::uint64_t>(std::floor(kMostDutyCycle / settings.pulse_s));
    found.push_back({Kind::duty_cycle, 0, 0, most, duty});
  }
  std::uint64_t samples = 0;
  for (std::size_t channel = 0; channel < settings.channels.size(); ++channel) {
    if (!settings.channels[channel].is_on) continue;
    samples += settings.channels[channel].samples;
    add_contradictions(settings, channel, found);
  }
  if (samples > settings.fifo_depth) {
    found.push_back({Kind::fifo_depth, 0, samples, settings.fifo_depth});
  }
  return found;
}

}  // namespace skerry::board
