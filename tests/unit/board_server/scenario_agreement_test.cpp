// A scenario is refused exactly where the board it describes would set the fault `config`.
#include <gtest/gtest.h>

#include <random>

#include "server/board/board.hpp"
#include "server/world/board_registers.hpp"

namespace skerry::server {
namespace {

using Random = std::mt19937;

// Standard distributions differ from library to library.
std::uint32_t up_to(Random& random, std::uint32_t most) {
  return static_cast<std::uint32_t>(random() % (std::uint64_t{most} + 1));
}
bool one_in(Random& random, std::uint32_t n) { return up_to(random, n - 1) == 0; }

void fill(scenario::BoardChannel& channel, Random& random) {
  channel.set_samples(2 + 2 * up_to(random, 3000));
  channel.set_bits(8 + 2 * up_to(random, 3));
  if (one_in(random, 3)) channel.set_decimation(1 + up_to(random, 300));
  if (one_in(random, 3)) channel.set_decimation_mode(scenario::BoardChannel::sum);
  if (one_in(random, 3)) {
    channel.set_test(scenario::BoardChannel::target);
    channel.set_test_value(1 + up_to(random, 8000));
  }
}

scenario::Radar random_radar(Random& random) {
  scenario::Radar radar;
  const double ranges[] = {0.75, 3.0, 12.0, 48.0};
  radar.mutable_controls()->set_range_nm(ranges[up_to(random, 3)]);
  scenario::Board& board = *radar.mutable_board();
  if (one_in(random, 2)) board.set_sample_clock_mhz(1.0 + up_to(random, 124'000) / 1000.0);
  if (one_in(random, 2)) board.set_pulse(up_to(random, 5));
  if (one_in(random, 2)) board.set_prf_hz(300.0 + up_to(random, 3'000'000) / 999.0);
  if (one_in(random, 2)) board.set_jitter_percent(up_to(random, 2000) / 100.0);
  if (one_in(random, 2)) board.set_stagger_percent(up_to(random, 2000) / 100.0);
  if (one_in(random, 3)) board.set_delay_us(up_to(random, 100'000) / 1000.0);
  if (one_in(random, 3)) board.set_fifo(2 + up_to(random, 9000));
  fill(*board.mutable_channel_a(), random);
  fill(*board.mutable_channel_b(), random);
  if (one_in(random, 3)) board.mutable_channel_b()->set_source("X");
  return radar;
}

bool board_has_fault(const scenario::Radar& radar) {
  BoardSetup setup;
  setup.set = radar_set(radar);
  setup.initial = board_registers(radar, [](const std::string&) { return 0u; });
  setup.on_air = [&] {
    return BoardSetup::OnAir{setup.set.pulse_for(*RangeScale::find(radar.controls().range_nm())),
                             true};
  };
  Board board(setup);
  BoardBatch batch;
  board.advance(ScenarioTime{}, UtcTime{}, false, batch);
  return (board.counters().faults & board::fault::config) != 0;
}

TEST(ScenarioAgreement, OfCheckAndBoardOverRandomSettings) {
  Random random(5);
  int refused = 0, taken = 0;
  for (int i = 0; i < 20'000; ++i) {
    const scenario::Radar radar = random_radar(random);
    const auto complaints = complaints_of_board(radar);
    ASSERT_EQ(!complaints.empty(), board_has_fault(radar))
        << (complaints.empty() ? "" : complaints.front().text) << "\n"
        << radar.ShortDebugString();
    ++(complaints.empty() ? taken : refused);
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(taken, 2000);
}

}  // namespace
}  // namespace skerry::server
