#include "server/board/board_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/board/contradiction.hpp"

namespace skerry::server {
namespace {

using board::Reg;

std::uint32_t nearest(double x) { return static_cast<std::uint32_t>(std::floor(x + 0.5)); }

char letter_of(std::size_t channel) { return channel == 0 ? 'A' : 'B'; }

board::JudgedSettings judged(const BoardSettings& settings, const echo::RadarSet& set) {
  board::JudgedSettings judged;
  judged.clock_hz = settings.clock_hz;
  judged.pulse_code = settings.pulse_code;
  judged.pulse_codes = static_cast<std::uint32_t>(set.pulses.size());
  judged.pulse_s = settings.pulse.length_s;
  judged.prf_millihertz = settings.prf_millihertz;
  judged.jitter_ppm = settings.jitter_ppm;
  judged.stagger_ppm = settings.stagger_ppm;
  judged.delay_ticks = settings.delay_ticks;
  judged.fifo_depth = settings.fifo_depth;
  for (std::size_t channel = 0; channel < 2; ++channel) {
    const ChannelSettings& c = settings.channels[channel];
    judged.channels[channel] = {c.is_on(),     c.format.samples, c.format.decimation, c.format.bits,
                                c.format.mode, c.test_mode,      c.test_value};
  }
  return judged;
}

std::string reason_of(const board::Contradiction& found, const BoardSettings& settings) {
  const ChannelSettings& c = settings.channels[found.channel];
  const char letter = letter_of(found.channel);
  const double prf_hz = settings.prf_millihertz / 1000.0;
  switch (found.kind) {
    case board::Contradiction::Kind::pulse_code:
      return fmt::format("PULSE_CODE {} is beyond PULSE_CODES {}", found.is, found.most);
    case board::Contradiction::Kind::duty_cycle:
      return fmt::format(
          "PULSE_CODE {} of {:.0f} ns at PRF {:.3f} Hz is a duty cycle of {:.4f}, over {:.3f}; the "
          "most is {} Hz",
          settings.pulse_code, settings.pulse.length_s * 1e9, prf_hz, found.duty,
          board::kMostDutyCycle, found.most);
    case board::Contradiction::Kind::sweep_length:
      return fmt::format(
          "SAMPLES_{0} {1} * DECIMATION_{0} {2} + TRIGGER_DELAY {3} is {4} ticks; at PRF {5:.3f} "
          "Hz triggers come after {6}",
          letter, c.format.samples, c.format.decimation, settings.delay_ticks, found.is, prf_hz,
          found.most);
    case board::Contradiction::Kind::sum_width:
      return fmt::format(
          "DECIMATION_{0} {1} sums of BITS_{0} {2} reach {3}, over 65535; the most is {4}, or use "
          "the mean",
          letter, c.format.decimation, c.format.bits, found.is, found.most);
    case board::Contradiction::Kind::target:
      return fmt::format("TEST_VALUE_{0} {1} puts the test target beyond SAMPLES_{0} {2}", letter,
                         found.is, c.format.samples);
    case board::Contradiction::Kind::fifo_depth:
      break;
  }
  const auto samples_of = [&](std::size_t channel) {
    const ChannelSettings& each = settings.channels[channel];
    return each.is_on() ? each.format.samples : 0;
  };
  return fmt::format("FIFO_DEPTH {} is below one sweep of {}: SAMPLES_A {} + SAMPLES_B {}",
                     found.most, found.is, samples_of(0), samples_of(1));
}

}  // namespace

BoardSettings settings_of(const std::function<std::uint32_t(std::uint32_t)>& value,
                          const echo::RadarSet& set, const echo::Pulse& on_air) {
  const auto get = [&](Reg reg) { return value(board::address_of(reg)); };
  BoardSettings s;
  s.clock_hz = get(Reg::sample_clock_hz);
  s.pulse_code = get(Reg::pulse_code);
  s.pulse = s.pulse_code >= 1 && s.pulse_code <= set.pulses.size() ? set.pulses[s.pulse_code - 1]
                                                                   : on_air;
  s.prf_millihertz = get(Reg::prf_millihertz);
  if (s.prf_millihertz == 0) s.prf_millihertz = std::max(nearest(s.pulse.prf_hz * 1000.0), 1u);
  s.jitter_ppm = get(Reg::jitter_ppm);
  s.stagger_ppm = get(Reg::stagger_ppm);
  s.delay_ticks = get(Reg::trigger_delay);
  s.blanking = static_cast<board::BlankingMode>(get(Reg::blanking));
  s.blank = {BlankSector{get(Reg::blank_1_from), get(Reg::blank_1_to)},
             BlankSector{get(Reg::blank_2_from), get(Reg::blank_2_to)}};
  s.acp_per_turn = get(Reg::acp_per_turn);
  s.milli_rpm = get(Reg::rotation_millirpm);
  if (s.milli_rpm == 0) s.milli_rpm = std::max(nearest(set.rpm * 1000.0), 1u);
  s.arp_error = static_cast<std::int32_t>(get(Reg::arp_error));
  s.wow_ppm = get(Reg::wow_ppm);
  s.wow_per_turn = get(Reg::wow_per_turn);
  s.gust_ppm = get(Reg::gust_ppm);
  s.fifo_depth = get(Reg::fifo_depth);
  s.spokes_per_turn = get(Reg::spokes_per_turn);
  for (std::uint32_t channel = 0; channel < 2; ++channel) {
    const auto of = [&](Reg reg) { return value(board::channel_address(reg, channel)); };
    ChannelSettings& c = s.channels[channel];
    c.source = of(Reg::source_a);
    c.format.detector = static_cast<board::Detector>(of(Reg::detector_a));
    c.format.bits = static_cast<std::uint8_t>(of(Reg::bits_a));
    c.format.inverted = of(Reg::polarity_a) != 0;
    c.format.samples = of(Reg::samples_a);
    c.format.decimation = of(Reg::decimation_a);
    c.format.mode = static_cast<board::DecimationMode>(of(Reg::decimation_mode_a));
    c.gain_centibel = static_cast<std::int32_t>(of(Reg::gain_a));
    c.offset = static_cast<std::int32_t>(of(Reg::offset_a));
    c.stc = of(Reg::stc_a);
    c.test_mode = static_cast<board::TestMode>(of(Reg::test_mode_a));
    c.test_value = of(Reg::test_value_a);
  }
  return s;
}

std::string contradiction_in(const BoardSettings& settings, const echo::RadarSet& set) {
  const auto found = board::contradictions_in(judged(settings, set));
  return found.empty() ? std::string() : reason_of(found.front(), settings);
}

}  // namespace skerry::server
