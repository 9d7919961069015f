#include "server/world/board_registers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/board/registers.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::server {
namespace {

using board::Reg;

// Most that transmitters on ships stand: pulse length times PRF.
constexpr double kMostDutyCycle = 0.002;

std::uint32_t nearest(double x) { return static_cast<std::uint32_t>(std::floor(x + 0.5)); }
std::uint32_t as_register(std::int64_t x) { return static_cast<std::uint32_t>(x); }

// What the board has where the scenario gives nothing.
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
  return set.pulse_for(*RangeScale::find(radar.range_nm()),
                       static_cast<echo::PulseChoice>(static_cast<int>(radar.pulse())));
}

std::uint32_t samples_of(const scenario::BoardChannel& said, std::uint32_t channel) {
  return said.has_samples() ? said.samples() : reset_value(Reg::samples_a, channel);
}

std::optional<SetComplaint> complaint_of_channel(const scenario::Board& board,
                                                 const scenario::BoardChannel& said,
                                                 std::uint32_t channel, double prf_hz) {
  const std::string key = channel == 0 ? "board.channel_a." : "board.channel_b.";
  const std::uint32_t samples = samples_of(said, channel);
  const std::uint32_t decimation = said.has_decimation() ? said.decimation() : 1;
  if (samples % 2 != 0) {
    return SetComplaint{key + "samples", fmt::format("{} is odd; allowed: even numbers", samples)};
  }
  const double irregular = 1e-2 * (board.jitter_percent() + board.stagger_percent());
  const double apart = std::floor(clock_hz(board) / prf_hz * (1.0 - irregular));
  const double delay = std::floor(board.delay_us() * 1e-6 * clock_hz(board) + 0.5);
  const double needed = double{1} * samples * decimation + delay;
  if (needed > apart) {
    const char* const at = said.has_samples() || !board.has_prf_hz() ? "samples" : nullptr;
    return SetComplaint{
        at ? key + at : "board.prf_hz",
        fmt::format("a sweep of {} samples * decimation {} + delay {:.0f} takes {:.0f} ticks of "
                    "{:g} MHz, but at {:g} Hz triggers come after {:.0f}; allowed: fewer or a "
                    "lower PRF",
                    samples, decimation, delay, needed, clock_hz(board) * 1e-6, prf_hz, apart)};
  }
  const std::uint32_t bits = said.has_bits() ? said.bits() : reset_value(Reg::bits_a, channel);
  const std::uint32_t strongest = (1u << bits) - 1;
  if (said.decimation_mode() == scenario::BoardChannel::sum && decimation > 0xFFFF / strongest) {
    return SetComplaint{key + "decimation",
                        fmt::format("sums of {} values of {} bits are wider than 16 bits; allowed: "
                                    "at most {}, or the mean",
                                    decimation, bits, 0xFFFF / strongest)};
  }
  const bool target = said.test() == scenario::BoardChannel::target;
  if (target && said.has_test_value() && said.test_value() >= samples) {
    return SetComplaint{key + "test_value",
                        fmt::format("a target at sample {} of {}; allowed: less than that",
                                    said.test_value(), samples)};
  }
  return std::nullopt;
}

}  // namespace

RegisterValues board_registers(const scenario::Radar& radar,
                               const std::function<std::uint32_t(const std::string&)>& index_of) {
  return Registers(index_of).of(radar);
}

std::optional<SetComplaint> complaint_of_board(const scenario::Radar& radar) {
  const scenario::Board& board = radar.board();
  const std::size_t pulses = radar_set(radar).pulses.size();
  if (board.pulse() > pulses) {
    return SetComplaint{
        "board.pulse", fmt::format("{}, but the set has {} pulses; allowed: 0 to {}", board.pulse(),
                                   pulses, pulses)};
  }
  if (board.blanked_sectors_size() > kMaxBoardSectors) {
    return SetComplaint{"board.blanked_sectors",
                        fmt::format("{} entries; allowed: at most {}", board.blanked_sectors_size(),
                                    kMaxBoardSectors)};
  }
  const echo::Pulse pulse = pulse_of(radar);
  const double prf_hz = board.has_prf_hz() ? board.prf_hz() : pulse.prf_hz;
  if (pulse.length_s * prf_hz > kMostDutyCycle) {
    return SetComplaint{
        "board.prf_hz",
        fmt::format("a pulse of {:g} us at {:g} Hz is a duty cycle of {:.4f}; allowed: {:g}, at "
                    "most {:.0f} Hz",
                    pulse.length_s * 1e6, prf_hz, pulse.length_s * prf_hz, kMostDutyCycle,
                    std::floor(kMostDutyCycle / pulse.length_s))};
  }
  if (auto wrong = complaint_of_channel(board, board.channel_a(), 0, prf_hz)) return wrong;
  std::uint64_t samples = samples_of(board.channel_a(), 0);
  if (board.channel_b().has_source()) {
    if (auto wrong = complaint_of_channel(board, board.channel_b(), 1, prf_hz)) return wrong;
    samples += samples_of(board.channel_b(), 1);
  }
  if (board.has_fifo() && board.fifo() < samples) {
    return SetComplaint{"board.fifo",
                        fmt::format("{} samples, but one sweep of all channels has {}; allowed: at "
                                    "least that",
                                    board.fifo(), samples)};
  }
  return std::nullopt;
}

}  // namespace skerry::server
