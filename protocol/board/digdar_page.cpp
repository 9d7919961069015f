#include "protocol/board/digdar_page.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <list>
#include <string>
#include <vector>

namespace skerry::board {
namespace {

struct Row {
  Digdar offset = Digdar::command;
  std::string_view name;
  DigdarUse use = DigdarUse::zero;
  std::int64_t min = 0, max = 0, reset = 0;
  std::string_view unit, what;
  std::optional<Reg> reg = {};
  std::uint32_t step = 1;
};

constexpr std::array kControl = {
    Row{Digdar::command, "COMMAND", DigdarUse::converted, 0, 3, 0, "bits",
        "bit 0 arm, bit 1 reset, as in CONTROL; reads 0", Reg::control},
    Row{Digdar::trig_source, "TRIG_SOURCE", DigdarUse::converted, 0, 4, 2, "",
        "0: arming captures nothing; 1-4: the next trigger; reads 0 once it is captured",
        Reg::control},
    Row{Digdar::num_samp, "NUM_SAMP", DigdarUse::same, 2, 16'384, 2048, "samples", "SAMPLES_A",
        Reg::samples_a, 2},
    Row{Digdar::dec_rate, "DEC_RATE", DigdarUse::same, 1, 65'536, 1, "ticks", "DECIMATION_A",
        Reg::decimation_a},
    Row{Digdar::options, "OPTIONS", DigdarUse::converted, 0, 15, 0, "bits",
        "bit 0 mean, bit 1 sum (neither: peak), bit 2 POLARITY_A, bit 3 TEST_MODE_A ramp",
        Reg::decimation_mode_a},
    Row{Digdar::trig_thresh_excite, "TRIG_THRESH_EXCITE", DigdarUse::stored, -8192, 8191, 0,
        "steps", "without effect"},
    Row{Digdar::trig_thresh_relax, "TRIG_THRESH_RELAX", DigdarUse::stored, -8192, 8191, 0, "steps",
        "without effect"},
    Row{Digdar::trig_delay, "TRIG_DELAY", DigdarUse::same, 0, 1'000'000, 0, "ticks",
        "TRIGGER_DELAY", Reg::trigger_delay},
    Row{Digdar::trig_latency, "TRIG_LATENCY", DigdarUse::stored, 0, 65'535, 0, "ticks",
        "without effect"},
    Row{Digdar::acp_thresh_excite, "ACP_THRESH_EXCITE", DigdarUse::stored, -2048, 2047, 0, "steps",
        "without effect"},
    Row{Digdar::acp_thresh_relax, "ACP_THRESH_RELAX", DigdarUse::stored, -2048, 2047, 0, "steps",
        "without effect"},
    Row{Digdar::acp_latency, "ACP_LATENCY", DigdarUse::stored, 0, 1'000'000, 0, "ticks",
        "without effect"},
    Row{Digdar::arp_thresh_excite, "ARP_THRESH_EXCITE", DigdarUse::stored, -2048, 2047, 0, "steps",
        "without effect"},
    Row{Digdar::arp_thresh_relax, "ARP_THRESH_RELAX", DigdarUse::stored, -2048, 2047, 0, "steps",
        "without effect"},
    Row{Digdar::arp_latency, "ARP_LATENCY", DigdarUse::stored, 0, 1'000'000, 0, "ticks",
        "without effect"},
};

// Those that are counted, live and latched; `latched` is the register of the latter.
struct Counted {
  Digdar offset = Digdar::trig_clock;
  bool wide = false;
  std::string_view name, unit, what;
  DigdarUse live_use = DigdarUse::pulses, latched_use = DigdarUse::pulses;
  std::optional<Reg> live = {}, latched = {};
};

constexpr auto kUsePulses = DigdarUse::pulses;
constexpr auto kUseSame = DigdarUse::same;
constexpr auto kUseConverted = DigdarUse::converted;

constexpr std::array kMetadata = {
    Counted{Digdar::trig_clock,
            true,
            "TRIG_CLOCK",
            "ticks",
            "of the last trigger",
            kUsePulses,
            kUseSame,
            {},
            Reg::latched_clock_low},
    Counted{Digdar::trig_prev_clock, true, "TRIG_PREV_CLOCK", "ticks", "of the one before it"},
    Counted{Digdar::acp_clock, true, "ACP_CLOCK", "ticks", "of the last ACP"},
    Counted{Digdar::acp_prev_clock, true, "ACP_PREV_CLOCK", "ticks", "of the one before it"},
    Counted{Digdar::arp_clock, true, "ARP_CLOCK", "ticks", "of the last ARP"},
    Counted{Digdar::arp_prev_clock, true, "ARP_PREV_CLOCK", "ticks", "of the one before it"},
    Counted{Digdar::trig_count, false, "TRIG_COUNT", "", "triggers since the reset", kUseSame,
            kUseSame, Reg::trigger_count_low, Reg::latched_trigger_count_low},
    Counted{Digdar::acp_count, false, "ACP_COUNT", "", "ACPs since the reset"},
    Counted{Digdar::arp_count, false, "ARP_COUNT", "", "ARPs since the reset", kUseSame, kUseSame,
            Reg::arp_count, Reg::latched_arp_count},
    Counted{Digdar::acp_per_arp,
            false,
            "ACP_PER_ARP",
            "",
            "ACPs of the last whole turn",
            kUseSame,
            kUsePulses,
            Reg::acp_per_arp,
            {}},
    Counted{Digdar::adc_counter, false, "ADC_COUNTER", "ticks", "the clock's low 14 bits",
            kUseConverted, kUseConverted, Reg::clocks_low, Reg::latched_clock_low},
    Counted{Digdar::acp_at_arp, false, "ACP_AT_ARP", "", "ACPs since the reset, at the last ARP"},
    Counted{Digdar::clock_since_acp_at_arp, false, "CLOCK_SINCE_ACP_AT_ARP", "ticks",
            "from the ACP before the last ARP to that ARP"},
    Counted{Digdar::trig_at_arp, false, "TRIG_AT_ARP", "",
            "triggers since the reset, at the last ARP"},
};

struct Page {
  Page() {
    // The rows point to the infos, which must not move then.
    infos.reserve(kDigdarBytes / 4);
    for (const Row& row : kControl) {
      add({address_of(row.offset), named("DIGDAR_", row.name, ""), Access::read_write, row.min < 0,
           row.min, row.max, row.reset, row.unit, row.what, row.step},
          row.use, row.reg);
    }
    for (const Counted& each : kMetadata) counted(each, false);
    counted({Digdar::clocks,
             true,
             "CLOCKS",
             "ticks",
             "now, since scenario time 0",
             kUseSame,
             kUseSame,
             Reg::clocks_low,
             {}},
            false);
    read_only(address_of(Digdar::acp_raw), named("DIGDAR_", "ACP_RAW", ""), "steps", "reads 0",
              DigdarUse::zero, {}, 0);
    read_only(address_of(Digdar::arp_raw), named("DIGDAR_", "ARP_RAW", ""), "steps", "reads 0",
              DigdarUse::zero, {}, 0);
    for (const Counted& each : kMetadata) counted(each, true);
  }

  std::string_view named(std::string_view before, std::string_view name, std::string_view after) {
    return names.emplace_back(std::string(before) + std::string(name) + std::string(after));
  }
  void add(const RegisterInfo& info, DigdarUse use, std::optional<Reg> reg) {
    infos.push_back(info);
    rows.push_back({&infos.back(), use, reg});
  }
  void read_only(std::uint32_t address, std::string_view name, std::string_view unit,
                 std::string_view what, DigdarUse use, std::optional<Reg> reg,
                 std::int64_t max = std::numeric_limits<std::uint32_t>::max()) {
    add({address, name, Access::read_only, false, 0, max, 0, unit, what}, use, reg);
  }
  void counted(const Counted& each, bool latched) {
    const std::uint32_t address =
        address_of(each.offset) + (latched ? kDigdarAtTrigger - kDigdarMetadata : 0);
    const std::string_view before = latched ? "DIGDAR_AT_TRIG_" : "DIGDAR_";
    const DigdarUse use = latched ? each.latched_use : each.live_use;
    const std::optional<Reg> reg = latched ? each.latched : each.live;
    if (!each.wide) {
      read_only(address, named(before, each.name, ""), each.unit, each.what, use, reg);
      return;
    }
    read_only(address, named(before, each.name, "_LOW"), each.unit, each.what, use, reg);
    const auto high = [](Reg low) { return static_cast<Reg>(board::address_of(low) + 4); };
    read_only(address + 4, named(before, each.name, "_HIGH"), "2^32 ticks", "high half of it", use,
              reg ? std::optional(high(*reg)) : std::nullopt);
  }

  std::list<std::string> names;  // whose places stay
  std::vector<RegisterInfo> infos;
  std::vector<DigdarRegister> rows;
};

const Page& page() {
  static const Page made;
  return made;
}

}  // namespace

std::span<const DigdarRegister> digdar_page() { return page().rows; }
std::span<const RegisterInfo> digdar_infos() { return page().infos; }

const DigdarRegister* find_digdar(std::uint32_t address) {
  for (const DigdarRegister& row : digdar_page()) {
    if (row.info->address == address) return &row;
  }
  return nullptr;
}

}  // namespace skerry::board
