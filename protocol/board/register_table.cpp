#include "protocol/board/register_table.hpp"

#include <algorithm>
#include <array>
#include <list>
#include <vector>

namespace skerry::board {
namespace {

constexpr std::int64_t kMost32 = 0xFFFF'FFFF;
constexpr std::int64_t kAllFaults = 0x7F, kAllEvents = 0x7F;

constexpr RegisterInfo reads(Reg reg, std::string_view name, std::int64_t max,
                             std::string_view unit, std::string_view what) {
  return {address_of(reg), name, Access::read_only, false, 0, max, 0, unit, what};
}

// Reads the same for as long as the board lives.
constexpr RegisterInfo constant(Reg reg, std::string_view name, std::int64_t value,
                                std::string_view what) {
  return {address_of(reg), name, Access::read_only, false, value, value, value, "", what};
}

constexpr RegisterInfo sets(Reg reg, std::string_view name, std::int64_t min, std::int64_t max,
                            std::int64_t reset, std::string_view unit, std::string_view what) {
  return {address_of(reg), name, Access::read_write, min < 0, min, max, reset, unit, what};
}

// 0, which has a meaning of its own, or a value in [min, max].
constexpr RegisterInfo sets_or_zero(Reg reg, std::string_view name, std::int64_t min,
                                    std::int64_t max, std::string_view unit,
                                    std::string_view what) {
  RegisterInfo info = sets(reg, name, min, max, 0, unit, what);
  info.or_zero = true;
  return info;
}

constexpr RegisterInfo every(std::uint32_t step, RegisterInfo info) {
  info.step = step;
  return info;
}

constexpr RegisterInfo clears(Reg reg, std::string_view name, std::int64_t bits,
                              std::string_view what) {
  return {address_of(reg), name, Access::write_ones_to_clear, false, 0, bits, 0, "bits", what};
}

constexpr std::array kBoard = {
    constant(Reg::identity, "IDENTITY", kIdentity, "\"SKRB\" in ASCII, first letter lowest"),
    constant(Reg::version, "VERSION", kMapVersion, "version of this map"),
    reads(Reg::radar, "RADAR", 65'535, "", "index of the radar in the server"),
    reads(Reg::pulse_codes, "PULSE_CODES", 16, "", "pulses of the radar's set"),
    sets(Reg::control, "CONTROL", 0, 15, 1, "bits", "run, reset, arm, FIFO"),
    reads(Reg::status, "STATUS", 31, "bits", "running, armed, captured, radiating, fault"),
    reads(Reg::faults, "FAULTS", kAllFaults, "bits", "faults as they are now"),
    clears(Reg::faults_latched, "FAULTS_LATCHED", kAllFaults,
           "faults since they were last cleared"),
    clears(Reg::events, "EVENTS", kAllEvents, "events since they were last cleared"),
    sets(Reg::event_enable, "EVENT_ENABLE", 0, kAllEvents, kAllEvents, "bits",
         "events that are also sent as records"),

    sets(Reg::sample_clock_hz, "SAMPLE_CLOCK_HZ", 1'000'000, 125'000'000, 20'000'000, "Hz",
         "sample clock; all ticks are its"),
    reads(Reg::clocks_low, "CLOCKS_LOW", kMost32, "ticks", "now, since scenario time 0"),
    reads(Reg::clocks_high, "CLOCKS_HIGH", kMost32, "2^32 ticks", "high half of it"),
    reads(Reg::utc_ns_low, "UTC_NS_LOW", kMost32, "ns", "now, since 1970-01-01 UTC"),
    reads(Reg::utc_ns_high, "UTC_NS_HIGH", kMost32, "2^32 ns", "high half of it"),

    sets(Reg::pulse_code, "PULSE_CODE", 0, 16, 0, "",
         "0: as the radar has it on the air; n: the set's n-th pulse"),
    sets_or_zero(Reg::prf_millihertz, "PRF_MILLIHERTZ", 10'000, 20'000'000, "mHz",
                 "pulse repetition frequency; 0: the pulse's own"),
    sets(Reg::jitter_ppm, "JITTER_PPM", 0, 200'000, 0, "ppm",
         "of the trigger period, uniform to either side"),
    sets(Reg::stagger_ppm, "STAGGER_PPM", 0, 200'000, 0, "ppm",
         "of the trigger period, longer and shorter by turns"),
    sets(Reg::trigger_delay, "TRIGGER_DELAY", 0, 1'000'000, 0, "ticks",
         "from the trigger, which is range zero, to the first sample"),
    sets(Reg::blanking, "BLANKING", 0, 2, 0, "",
         "0 off; in its sectors 1: no triggers, 2: no video"),
    sets(Reg::blank_1_from, "BLANK_1_FROM", 0, 3599, 0, "0.1 deg",
         "first sector: from the bow, clockwise"),
    sets(Reg::blank_1_to, "BLANK_1_TO", 0, 3599, 0, "0.1 deg",
         "to, clockwise; equal to the first: no sector"),
    sets(Reg::blank_2_from, "BLANK_2_FROM", 0, 3599, 0, "0.1 deg", "second sector: from"),
    sets(Reg::blank_2_to, "BLANK_2_TO", 0, 3599, 0, "0.1 deg", "second sector: to"),

    sets(Reg::acp_per_turn, "ACP_PER_TURN", 360, 16'384, 4096, "", "azimuth count pulses a turn"),
    sets_or_zero(Reg::rotation_millirpm, "ROTATION_MILLIRPM", 1000, 60'000, "0.001 rpm",
                 "antenna's speed; 0: the radar's own"),
    sets(Reg::arp_error, "ARP_ERROR", -32'768, 32'767, 0, "1/65536 turn",
         "where the ARP comes, clockwise from the bow"),
    sets(Reg::wow_ppm, "WOW_PPM", 0, 100'000, 0, "ppm",
         "of the speed: largest deviation, as a wave"),
    sets(Reg::wow_per_turn, "WOW_PER_TURN", 1, 64, 1, "", "waves in a turn"),
    sets(Reg::gust_ppm, "GUST_PPM", 0, 300'000, 0, "ppm",
         "of the speed: largest deviation by wind, once a turn"),

    sets(Reg::inject_missing_acp, "INJECT_MISSING_ACP", 0, 65'535, 0, "pulses",
         "ACPs to be left out, one in 16"),
    sets(Reg::inject_extra_acp, "INJECT_EXTRA_ACP", 0, 65'535, 0, "pulses",
         "ACPs too many to come, one after every 16th"),
    sets(Reg::inject_missing_arp, "INJECT_MISSING_ARP", 0, 1000, 0, "turns",
         "turns to come without an ARP"),
    sets(Reg::inject_stall_ms, "INJECT_STALL_MS", 0, 60'000, 0, "ms",
         "the antenna is to stand still, from the next ACP on"),

    sets(Reg::fifo_depth, "FIFO_DEPTH", 2, 4'194'304, 131'072, "samples",
         "room in the FIFO, for both channels together"),
    reads(Reg::fifo_level, "FIFO_LEVEL", kMost32, "sweeps", "in the FIFO"),
    sets_or_zero(Reg::spokes_per_turn, "SPOKES_PER_TURN", 256, 16'384, "",
                 "0: every trigger is a record; else pulses are integrated by azimuth"),
    reads(Reg::overruns_a, "OVERRUNS_A", kMost32, "sweeps", "the FIFO had no room for, channel A"),
    reads(Reg::underruns_a, "UNDERRUNS_A", kMost32, "sweeps", "asked of an empty FIFO, channel A"),
    reads(Reg::overruns_b, "OVERRUNS_B", kMost32, "sweeps", "the FIFO had no room for, channel B"),
    reads(Reg::underruns_b, "UNDERRUNS_B", kMost32, "sweeps", "asked of an empty FIFO, channel B"),
    reads(Reg::sweeps_late, "SWEEPS_LATE", kMost32, "sweeps",
          "left out: the board was too far behind"),
};

// Their names get the letter of the channel.
constexpr std::array kOfChannel = {
    sets(Reg::source_a, "SOURCE", 0, 64, 1, "",
         "0: off; n: radar n - 1, of the same own ship; at start the board's own in A"),
    sets(Reg::detector_a, "DETECTOR", 0, 1, 0, "", "0 logarithmic, 1 linear"),
    every(2, sets(Reg::bits_a, "BITS", 8, 14, 12, "bits", "of the converter")),
    sets(Reg::polarity_a, "POLARITY", 0, 1, 0, "", "1: the strongest echo reads 0"),
    sets(Reg::gain_a, "GAIN", -6000, 6000, 0, "0.01 dB", "before the converter"),
    sets(Reg::offset_a, "OFFSET", -16'383, 16'383, 0, "steps", "added to what the converter gives"),
    sets(Reg::stc_a, "STC", 0, 100, 0, "%", "sea control"),
    every(2, sets(Reg::samples_a, "SAMPLES", 2, 16'384, 2048, "samples",
                  "of a sweep, after decimation")),
    sets(Reg::decimation_a, "DECIMATION", 1, 65'536, 1, "ticks", "to one sample"),
    sets(Reg::decimation_mode_a, "DECIMATION_MODE", 0, 2, 0, "", "0 peak, 1 mean, 2 sum"),
    sets(Reg::test_mode_a, "TEST_MODE", 0, 5, 0, "",
         "0 off, 1 ramp, 2 rings, 3 wedge, 4 target, 5 checkerboard"),
    sets(Reg::test_value_a, "TEST_VALUE", 1, 16'384, 256, "samples",
         "between rings, side of tiles, range of the target; 0.1 deg: width of the wedge"),
};

constexpr std::array kCounted = {
    reads(Reg::trigger_count_low, "TRIGGER_COUNT_LOW", kMost32, "", "triggers since the reset"),
    reads(Reg::trigger_count_high, "TRIGGER_COUNT_HIGH", kMost32, "2^32", "high half of it"),
    reads(Reg::acp_count, "ACP_COUNT", kMost32, "", "ACPs since the last ARP"),
    reads(Reg::arp_count, "ARP_COUNT", kMost32, "", "ARPs since the reset"),
    reads(Reg::acp_per_arp, "ACP_PER_ARP", kMost32, "", "ACPs of the last whole turn"),

    reads(Reg::latched_trigger_count_low, "LATCHED_TRIGGER_COUNT_LOW", kMost32, "",
          "TRIGGER_COUNT at the trigger of the last sweep captured"),
    reads(Reg::latched_trigger_count_high, "LATCHED_TRIGGER_COUNT_HIGH", kMost32, "2^32",
          "high half of it"),
    reads(Reg::latched_clock_low, "LATCHED_CLOCK_LOW", kMost32, "ticks", "tick of that trigger"),
    reads(Reg::latched_clock_high, "LATCHED_CLOCK_HIGH", kMost32, "2^32 ticks", "high half of it"),
    reads(Reg::latched_acp_count, "LATCHED_ACP_COUNT", kMost32, "", "ACP_COUNT at it"),
    reads(Reg::latched_ticks_since_acp, "LATCHED_TICKS_SINCE_ACP", kMost32, "ticks",
          "from the last ACP to it"),
    reads(Reg::latched_acp_period, "LATCHED_ACP_PERIOD", kMost32, "ticks",
          "between the last two ACPs before it"),
    reads(Reg::latched_arp_count, "LATCHED_ARP_COUNT", kMost32, "", "ARP_COUNT at it"),
    reads(Reg::latched_utc_ns_low, "LATCHED_UTC_NS_LOW", kMost32, "ns",
          "its time, since 1970-01-01 UTC"),
    reads(Reg::latched_utc_ns_high, "LATCHED_UTC_NS_HIGH", kMost32, "2^32 ns", "high half of it"),
};

struct Table {
  Table() {
    rows.assign(kBoard.begin(), kBoard.end());
    for (std::uint32_t channel = 0; channel < 2; ++channel) {
      for (RegisterInfo info : kOfChannel) {
        names.push_back(std::string(info.name) + (channel == 0 ? "_A" : "_B"));
        info.name = names.back();
        if (channel == 1 && info.address == address_of(Reg::source_a)) info.reset = 0;
        if (channel == 1 && info.address == address_of(Reg::detector_a)) info.reset = 1;
        info.address += channel * kChannelStride;
        rows.push_back(info);
      }
    }
    rows.insert(rows.end(), kCounted.begin(), kCounted.end());
    for (std::uint32_t n = 0; n < kFaultReasonBytes / 4; ++n) {
      names.push_back("FAULT_REASON_" + std::to_string(n));
      RegisterInfo info = reads(Reg::fault_reason, names.back(), kMost32, "ASCII",
                                "why the fault `config` is set, 4 characters");
      info.address += 4 * n;
      reasons.push_back(info);
    }
  }
  std::list<std::string> names;  // whose places stay
  std::vector<RegisterInfo> rows, reasons;
};

const Table& table() {
  static const Table made;
  return made;
}

}  // namespace

std::span<const RegisterInfo> register_table() { return table().rows; }
std::span<const RegisterInfo> fault_reason_table() { return table().reasons; }

}  // namespace skerry::board
