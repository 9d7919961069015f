#include "server/world/board_registers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/board/contradiction.hpp"
#include "protocol/board/registers.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::server {
namespace {

using board::Reg;

std::uint32_t nearest(double x) { return static_cast<std::uint32_t>(std::floor(x + 0.5)); }
std::uint32_t as_register(std::int64_t x) { return static_cast<std::uint32_t>(x); }

// The board's value where the scenario gives none.
std::uint32_t reset_value(Reg reg, std::uint32_t channel = 0) {
  return as_register(board::find_register(board::channel_address(reg, channel))->reset);
}

double clock_hz(const scenario::Board& said) {
  return said.has_sample_clock_mhz() ? said.sample_clock_mhz() * 1e6
                                     : double{1} * reset_value(Reg::sample_clock_hz);
}

class Registers {
 public:
  explicit Registers(const std::function<std::uint32_t(const std::string&)>& index_of)
      : index_of_(index_of) {}

  RegisterValues of(const scenario::Radar& radar) {
    const scenario::Board& said = radar.board();
    if (said.has_sample_clock_mhz()) set(Reg::sample_clock_hz, nearest(clock_hz(said)));
    if (said.has_pulse()) set(Reg::pulse_code, said.pulse());
    if (said.has_prf_hz()) set(Reg::prf_millihertz, nearest(said.prf_hz() * 1e3));
    if (said.has_jitter_percent()) set(Reg::jitter_ppm, nearest(said.jitter_percent() * 1e4));
    if (said.has_stagger_percent()) set(Reg::stagger_ppm, nearest(said.stagger_percent() * 1e4));
    if (said.has_delay_us()) {
      set(Reg::trigger_delay, nearest(said.delay_us() * 1e-6 * clock_hz(said)));
    }
    if (said.has_blanking()) set(Reg::blanking, as_register(said.blanking()));
    static constexpr std::array<std::pair<Reg, Reg>, kMaxBoardSectors> kSectors = {
        {{Reg::blank_1_from, Reg::blank_1_to}, {Reg::blank_2_from, Reg::blank_2_to}}};
    for (int i = 0; i < said.blanked_sectors_size(); ++i) {
      const auto& [from, to] = kSectors[static_cast<std::size_t>(i)];
      set(from, nearest(said.blanked_sectors(i).from_deg() * 10.0) % 3600);
      set(to, nearest(said.blanked_sectors(i).to_deg() * 10.0) % 3600);
    }
    if (said.has_acp_per_turn()) set(Reg::acp_per_turn, said.acp_per_turn());
    if (said.has_rotation_rpm()) set(Reg::rotation_millirpm, nearest(said.rotation_rpm() * 1e3));
    if (said.has_arp_error_deg()) {
      const auto turns =
          static_cast<std::int64_t>(std::floor(said.arp_error_deg() / 360.0 * 65536.0 + 0.5));
      set(Reg::arp_error, as_register(std::clamp<std::int64_t>(turns, -32'768, 32'767)));
    }
    if (said.has_wow_percent()) set(Reg::wow_ppm, nearest(said.wow_percent() * 1e4));
    if (said.has_wow_per_turn()) set(Reg::wow_per_turn, said.wow_per_turn());
    if (said.has_gust_percent()) set(Reg::gust_ppm, nearest(said.gust_percent() * 1e4));
    if (said.has_spokes()) set(Reg::spokes_per_turn, said.spokes());
    if (said.has_fifo()) set(Reg::fifo_depth, said.fifo());
    add_channel(0, said.channel_a());
    add_channel(1, said.channel_b());
    return std::move(values_);
  }

 private:
  void set(Reg reg, std::uint32_t value, std::uint32_t channel = 0) {
    values_.emplace_back(board::channel_address(reg, channel), value);
  }

  void add_channel(std::uint32_t channel, const scenario::BoardChannel& said) {
    if (said.has_source()) set(Reg::source_a, index_of_(said.source()) + 1, channel);
    if (said.has_detector()) set(Reg::detector_a, as_register(said.detector()), channel);
    if (said.has_bits()) set(Reg::bits_a, said.bits(), channel);
    if (said.has_inverted()) set(Reg::polarity_a, said.inverted() ? 1 : 0, channel);
    if (said.has_gain_db()) {
      set(Reg::gain_a, as_register(static_cast<std::int64_t>(std::lround(said.gain_db() * 100.0))),
          channel);
    }
    if (said.has_offset()) set(Reg::offset_a, as_register(said.offset()), channel);
    if (said.has_stc()) set(Reg::stc_a, said.stc(), channel);
    if (said.has_samples()) set(Reg::samples_a, said.samples(), channel);
    if (said.has_decimation()) set(Reg::decimation_a, said.decimation(), channel);
    if (said.has_decimation_mode()) {
      set(Reg::decimation_mode_a, as_register(said.decimation_mode()), channel);
    }
    if (said.has_test()) set(Reg::test_mode_a, as_register(said.test()), channel);
    if (said.has_test_value()) set(Reg::test_value_a, said.test_value(), channel);
  }

  const std::function<std::uint32_t(const std::string&)>& index_of_;
  RegisterValues values_;
};

echo::Pulse pulse_of(const scenario::Radar& radar) {
  const echo::RadarSet set = radar_set(radar);
  const std::uint32_t code = radar.board().pulse();
  if (code >= 1 && code <= set.pulses.size()) return set.pulses[code - 1];
  return set.pulse_for(*RangeScale::find(radar.controls().range_nm()),
                       static_cast<echo::PulseChoice>(static_cast<int>(radar.controls().pulse())));
}

std::string channel_key(std::size_t channel) {
  return channel == 0 ? "board.channel_a." : "board.channel_b.";
}

// The settings that the board will check: the map's values, overridden by the scenario's.
board::JudgedSettings judged(const scenario::Radar& radar, const echo::Pulse& pulse) {
  const std::function<std::uint32_t(const std::string&)> any = [](const std::string&) {
    return 0u;
  };
  const RegisterValues given = Registers(any).of(radar);
  const auto value = [&](Reg reg, std::uint32_t channel = 0) {
    const std::uint32_t address = board::channel_address(reg, channel);
    for (const auto& [each, said] : given) {
      if (each == address) return said;
    }
    return reset_value(reg, channel);
  };
  board::JudgedSettings judged;
  judged.clock_hz = value(Reg::sample_clock_hz);
  judged.pulse_code = value(Reg::pulse_code);
  judged.pulse_codes = static_cast<std::uint32_t>(radar_set(radar).pulses.size());
  judged.pulse_s = pulse.length_s;
  judged.prf_millihertz = value(Reg::prf_millihertz);
  if (judged.prf_millihertz == 0) {
    judged.prf_millihertz = std::max(nearest(pulse.prf_hz * 1e3), 1u);
  }
  judged.jitter_ppm = value(Reg::jitter_ppm);
  judged.stagger_ppm = value(Reg::stagger_ppm);
  judged.delay_ticks = value(Reg::trigger_delay);
  judged.fifo_depth = value(Reg::fifo_depth);
  for (std::uint32_t c = 0; c < 2; ++c) {
    judged.channels[c] = {
        value(Reg::source_a, c) != 0,
        value(Reg::samples_a, c),
        value(Reg::decimation_a, c),
        value(Reg::bits_a, c),
        static_cast<board::DecimationMode>(value(Reg::decimation_mode_a, c)),
        static_cast<board::TestMode>(value(Reg::test_mode_a, c)),
        value(Reg::test_value_a, c),
    };
  }
  return judged;
}

SetComplaint complaint_of_contradiction(const board::Contradiction& found,
                                        const board::JudgedSettings& settings,
                                        const scenario::Board& board) {
  const std::string key = channel_key(found.channel);
  const board::JudgedChannel& c = settings.channels[found.channel];
  const double prf_hz = settings.prf_millihertz / 1e3;
  switch (found.kind) {
    case board::Contradiction::Kind::pulse_code:
      return {"board.pulse", fmt::format("{}, but the set has {} pulses; allowed: 0 to {}",
                                         found.is, found.most, found.most)};
    case board::Contradiction::Kind::duty_cycle:
      return {"board.prf_hz",
              fmt::format("a pulse of {:g} us at {:g} Hz is a duty cycle of {:.4f}; allowed: {:g}, "
                          "at most {} Hz",
                          settings.pulse_s * 1e6, prf_hz, found.duty, board::kMostDutyCycle,
                          found.most)};
    case board::Contradiction::Kind::sweep_length: {
      const auto& said = found.channel == 0 ? board.channel_a() : board.channel_b();
      return {said.has_samples() || !board.has_prf_hz() ? key + "samples" : "board.prf_hz",
              fmt::format("a sweep of {} samples * decimation {} + delay {} takes {} ticks of "
                          "{:g} MHz, but at {:g} Hz triggers come after {}; allowed: fewer or a "
                          "lower PRF",
                          c.samples, c.decimation, settings.delay_ticks, found.is,
                          settings.clock_hz * 1e-6, prf_hz, found.most)};
    }
    case board::Contradiction::Kind::sum_width:
      return {key + "decimation",
              fmt::format("sums of {} values of {} bits are wider than 16 bits; allowed: at most "
                          "{}, or the mean",
                          c.decimation, c.bits, found.most)};
    case board::Contradiction::Kind::target:
      return {
          key + "test_value",
          fmt::format("a target at sample {} of {}; allowed: less than that", found.is, c.samples)};
    case board::Contradiction::Kind::fifo_depth:
      break;
  }
  return {"board.fifo",
          fmt::format("{} samples, but one sweep of all channels has {}; allowed: at least that",
                      found.most, found.is)};
}

}  // namespace

RegisterValues board_registers(const scenario::Radar& radar,
                               const std::function<std::uint32_t(const std::string&)>& index_of) {
  return Registers(index_of).of(radar);
}

std::vector<SetComplaint> complaints_of_board(const scenario::Radar& radar) {
  const scenario::Board& board = radar.board();
  std::vector<SetComplaint> complaints;
  for (std::size_t channel = 0; channel < 2; ++channel) {
    const auto& said = channel == 0 ? board.channel_a() : board.channel_b();
    if (said.samples() % 2 == 0) continue;
    complaints.push_back({channel_key(channel) + "samples",
                          fmt::format("{} is odd; allowed: even numbers", said.samples())});
  }
  if (board.blanked_sectors_size() > kMaxBoardSectors) {
    complaints.push_back(
        {"board.blanked_sectors", fmt::format("{} entries; allowed: at most {}",
                                              board.blanked_sectors_size(), kMaxBoardSectors)});
    return complaints;  // there are no registers for them to judge
  }
  const board::JudgedSettings settings = judged(radar, pulse_of(radar));
  for (const board::Contradiction& found : board::contradictions_in(settings)) {
    complaints.push_back(complaint_of_contradiction(found, settings, board));
  }
  return complaints;
}

}  // namespace skerry::server
