// The board section of a scenario: registers from keys, and contradictions by name and line.
#include "server/world/board_registers.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "protocol/board/registers.hpp"
#include "server/config/config_error.hpp"
#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

using board::Reg;

std::string text_with(const std::string& board) {
  return "name: s\nown_ships:\n  - name: Frida\n    position: {lat: 60.4, lon: 5}\n    radars:\n"
         "      - {name: X}\n      - name: S\n        board: " +
         board + "\n  - {name: Ymer, position: {lat: 60, lon: 5}, radars: [{name: Far}]}\n";
}

std::map<std::uint32_t, std::uint32_t> registers(const std::string& board) {
  const scenario::Scenario scenario = parse_scenario(text_with(board), "test.yaml");
  std::map<std::uint32_t, std::uint32_t> values;
  const auto index_of = [](const std::string& name) { return name == "X" ? 0u : 1u; };
  for (const auto& [address, value] : board_registers(scenario.own_ships(0).radars(1), index_of)) {
    EXPECT_EQ(board::check_write(address, value), board::RegisterError::ok) << address;
    EXPECT_TRUE(values.emplace(address, value).second) << "written twice: " << address;
  }
  return values;
}

std::string board_refusal(const std::string& board) {
  try {
    parse_scenario(text_with(board), "test.yaml");
  } catch (const ConfigError& error) {
    // Without file and column.
    std::string text = std::string(error.what()).substr(std::string("test.yaml:").size());
    const std::size_t colon = text.find(':');
    return text.erase(colon, text.find(':', colon + 1) - colon);
  }
  return "";
}

TEST(BoardRegisters, OfAScenarioThatSaysNothingAreLeftAsTheyAre) {
  EXPECT_TRUE(registers("{}").empty());
}

TEST(BoardRegisters, HaveTheUnitsOfTheBoard) {
  const auto values = registers(
      "{sample_clock_mhz: 62.5, pulse: 2, prf_hz: 1234.567, jitter_percent: 1.5, "
      "stagger_percent: 20, delay_us: 1.6, blanking: trigger, "
      "blanked_sectors: [{from_deg: 350.1, to_deg: 10}, {from_deg: 90, to_deg: 360}], "
      "acp_per_turn: 450, rotation_rpm: 24.5, arp_error_deg: -90, wow_percent: 10, "
      "wow_per_turn: 3, gust_percent: 30, spokes: 2048, fifo: 65536, "
      "channel_a: {inverted: true, gain_db: -12.34, offset: -5, bits: 14}, "
      "channel_b: {source: X, detector: linear, stc: 40, samples: 512, decimation: 16, "
      "decimation_mode: sum, bits: 8, test: wedge, test_value: 300}}");
  const auto at = [&](Reg reg, std::uint32_t channel = 0) {
    return values.at(board::channel_address(reg, channel));
  };
  EXPECT_EQ(at(Reg::sample_clock_hz), 62'500'000u);
  EXPECT_EQ(at(Reg::pulse_code), 2u);
  EXPECT_EQ(at(Reg::prf_millihertz), 1'234'567u);
  EXPECT_EQ(at(Reg::jitter_ppm), 15'000u);
  EXPECT_EQ(at(Reg::stagger_ppm), 200'000u);
  EXPECT_EQ(at(Reg::trigger_delay), 100u);
  EXPECT_EQ(at(Reg::blanking), 1u);
  EXPECT_EQ(at(Reg::blank_1_from), 3501u);
  EXPECT_EQ(at(Reg::blank_1_to), 100u);
  EXPECT_EQ(at(Reg::blank_2_to), 0u);
  EXPECT_EQ(at(Reg::acp_per_turn), 450u);
  EXPECT_EQ(at(Reg::rotation_millirpm), 24'500u);
  EXPECT_EQ(at(Reg::arp_error), static_cast<std::uint32_t>(-16384));
  EXPECT_EQ(at(Reg::wow_ppm), 100'000u);
  EXPECT_EQ(at(Reg::wow_per_turn), 3u);
  EXPECT_EQ(at(Reg::gust_ppm), 300'000u);
  EXPECT_EQ(at(Reg::spokes_per_turn), 2048u);
  EXPECT_EQ(at(Reg::fifo_depth), 65'536u);
  EXPECT_EQ(at(Reg::polarity_a), 1u);
  EXPECT_EQ(at(Reg::gain_a), static_cast<std::uint32_t>(-1234));
  EXPECT_EQ(at(Reg::offset_a), static_cast<std::uint32_t>(-5));
  EXPECT_EQ(at(Reg::bits_a), 14u);
  EXPECT_EQ(at(Reg::source_a, 1), 1u);
  EXPECT_EQ(at(Reg::detector_a, 1), 1u);
  EXPECT_EQ(at(Reg::stc_a, 1), 40u);
  EXPECT_EQ(at(Reg::samples_a, 1), 512u);
  EXPECT_EQ(at(Reg::decimation_a, 1), 16u);
  EXPECT_EQ(at(Reg::decimation_mode_a, 1), 2u);
  EXPECT_EQ(at(Reg::test_mode_a, 1), 3u);
  EXPECT_EQ(at(Reg::test_value_a, 1), 300u);
}

TEST(BoardRegisters, ThatContradictEachOtherAreRefusedByNameAndLine) {
  const std::string at = "own_ships[0].radars[1].board.";
  EXPECT_EQ(board_refusal("{acp_per_turn: 359}"),
            "8: " + at + "acp_per_turn: 359 is out of range; allowed: 360 to 16384");
  EXPECT_EQ(board_refusal("{channel_a: {source: Far}}"),
            "8: " + at + "channel_a.source: \"Far\" is no radar of Frida; allowed: X, S");
  EXPECT_EQ(board_refusal("{channel_a: {samples: 511}}"),
            "8: " + at + "channel_a.samples: 511 is odd; allowed: even numbers");
  EXPECT_EQ(
      board_refusal("{prf_hz: 1000, delay_us: 100, channel_a: {samples: 16384, decimation: 2}}"),
      "8: " + at +
          "channel_a.samples: a sweep of 16384 samples * decimation 2 + delay 2000 takes "
          "34768 ticks of 20 MHz, but at 1000 Hz triggers come after 20000; allowed: fewer "
          "or a lower PRF");
  // Jitter and stagger count twice: one trigger late, the next one early.
  EXPECT_EQ(board_refusal("{prf_hz: 1000, jitter_percent: 5, stagger_percent: 10, "
                          "channel_a: {samples: 14002}}"),
            "8: " + at +
                "channel_a.samples: a sweep of 14002 samples * decimation 1 + delay 0 takes 14002 "
                "ticks of 20 MHz, but at 1000 Hz triggers come after 14000; allowed: fewer or a "
                "lower PRF");
  EXPECT_EQ(board_refusal("{prf_hz: 1000, jitter_percent: 5, stagger_percent: 10, "
                          "channel_a: {samples: 14000}}"),
            "");
  EXPECT_EQ(board_refusal("{channel_b: {samples: 513}}"),
            "8: " + at + "channel_b.samples: 513 is odd; allowed: even numbers");
  EXPECT_EQ(board_refusal("{fifo: 4000, channel_b: {source: S}}"),
            "8: " + at +
                "fifo: 4000 samples, but one sweep of all channels has 4096; allowed: at least "
                "that");
  EXPECT_EQ(
      board_refusal("{channel_a: {bits: 14, samples: 16, decimation: 5, decimation_mode: sum}}"),
      "8: " + at +
          "channel_a.decimation: sums of 5 values of 14 bits are wider than 16 bits; "
          "allowed: at most 4, or the mean");
  EXPECT_EQ(board_refusal("{pulse: 7}"),
            "8: " + at + "pulse: 7, but the set has 4 pulses; allowed: 0 to 4");
  EXPECT_EQ(board_refusal("{pulse: 4, prf_hz: 2500}"),
            "8: " + at +
                "prf_hz: a pulse of 1 us at 2500 Hz is a duty cycle of 0.0025; allowed: 0.002, at "
                "most 2000 Hz");
  EXPECT_NE(board_refusal("{blanked_sectors: [{from_deg: 1, to_deg: 2}, {from_deg: 3, to_deg: 4}, "
                          "{from_deg: 5, to_deg: 6}]}")
                .find("board.blanked_sectors: 3 entries; allowed: at most 2"),
            std::string::npos);
  EXPECT_EQ(board_refusal("{channel_a: {test: target, test_value: 2048}}"),
            "8: " + at +
                "channel_a.test_value: a target at sample 2048 of 2048; allowed: less "
                "than that");
}

}  // namespace
}  // namespace skerry::server
