// A board under test: made-up echoes, time by the step, and what came out of it, decoded.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/board/board.hpp"
#include "server/board/tick_clock.hpp"

namespace skerry::server {

using board::Reg;
using board::RegisterError;

// A register of channel A, of channel B.
constexpr Reg as_b(Reg reg) { return static_cast<Reg>(board::channel_address(reg, 1)); }

// Rows of one power each; keeps what it was asked.
class FakeEchoes final : public echo::SweepEchoes {
 public:
  explicit FakeEchoes(std::uint32_t radar, float power = 0.0f) : power_(power) {
    grid_.radar = radar;
    grid_.rows_per_turn = 4096;
    grid_.cells = 64;
    grid_.cell_m = 200.0;
    grid_.pulse = {0.08e-6, 20e6, 3000.0, 1.5};
    cells_.assign(grid_.cells, power);
  }

  void set(const Wish& wish) override { wishes.push_back(wish); }
  Grid grid() const override { return grid_; }
  bool radiates() const override { return true; }
  std::span<const float> row(std::uint64_t n, ScenarioTime when) override {
    EXPECT_GE(n + 16, last_row_) << "rows went back too far";
    last_row_ = n;
    asked.push_back({n, when});
    if (on_row) on_row();
    return cells_;
  }

  struct Asked {
    std::uint64_t row = 0;
    ScenarioTime when;
  };
  std::vector<Wish> wishes;
  std::vector<Asked> asked;
  std::function<void()> on_row;  // in the middle of a step

 private:
  Grid grid_;
  float power_;
  std::uint64_t last_row_ = 0;
  std::vector<float> cells_;
};

struct Output {
  std::vector<board::Sweep> sweeps;
  std::vector<board::Edge> edges;  // of the stream of signals
  std::vector<board::Event> events;
  std::uint64_t next_record = 0, next_signal = 0;
  std::uint64_t edges_until = 0;  // tick

  std::vector<Tick> of(board::Line line) const {
    std::vector<Tick> ticks;
    for (const board::Edge& edge : edges) {
      if (edge.line == line) ticks.push_back(edge.tick);
    }
    return ticks;
  }
  std::vector<board::Event> of(std::uint32_t event) const {
    std::vector<board::Event> found;
    for (const board::Event& each : events) {
      if (each.event == event) found.push_back(each);
    }
    return found;
  }
  // The events (kFault_raised or _cleared) with that fault.
  std::vector<board::Event> of(std::uint32_t event, std::uint32_t fault) const {
    std::vector<board::Event> found;
    for (const board::Event& each : of(event)) {
      if ((each.faults & fault) != 0) found.push_back(each);
    }
    return found;
  }
};

class Harness {
 public:
  static constexpr std::uint32_t kRadar = 1;  // of three; 0 and 1 are on the same ship
  static UtcTime utc_zero() { return UtcTime(Duration(1'700'000'000'000'000'000)); }

  using Initial = std::vector<std::pair<Reg, std::uint32_t>>;

  explicit Harness(const Initial& initial = {}) : board(setup(initial)) {}

  // Small sweeps, so that whole turns are quickly made.
  static Initial small(Initial more = {}) {
    more.insert(more.begin(), {{Reg::samples_a, 8}, {Reg::bits_a, 8}});
    return more;
  }

  Output& run_to(Duration to, Duration step = std::chrono::milliseconds(50)) {
    while (now < to) {
      now = std::min(now + step, to);
      for (bool is_complete = false; !is_complete;) {
        board.advance(ScenarioTime(now), utc_zero(), wanted, batch);
        decode();
        biggest_batch = std::max(biggest_batch, batch.records.size());
        is_complete = batch.is_complete;
        if (!is_complete && between_batches) between_batches();
      }
    }
    return output;
  }
  Output& run_for(Duration time, Duration step = std::chrono::milliseconds(50)) {
    return run_to(now + time, step);
  }
  Output run_fresh(Duration time, Duration step = std::chrono::milliseconds(50)) {
    forget();
    return run_for(time, step);
  }
  void forget() {
    output.sweeps.clear();
    output.edges.clear();
    output.events.clear();
  }

  std::uint32_t read(Reg reg) const { return read(board::address_of(reg)); }
  std::uint32_t read(std::uint32_t address) const {
    const Board::Value value = board.read(address);
    EXPECT_EQ(value.error, RegisterError::ok) << std::hex << address;
    return value.value;
  }
  std::uint64_t read_wide(Reg low) const { return read_wide(board::address_of(low)); }
  std::uint64_t read_wide(std::uint32_t low) const {
    return read(low) | std::uint64_t{read(low + 4)} << 32;
  }
  RegisterError write(Reg reg, std::uint32_t value) {
    return board.write(board::address_of(reg), value);
  }
  std::string fault_reason() const {
    std::vector<std::uint32_t> words;
    for (std::uint32_t n = 0; n < board::kFaultReasonBytes / 4; ++n) {
      words.push_back(read(board::address_of(Reg::fault_reason) + 4 * n));
    }
    return board::fault_reason_text(words);
  }

  std::map<std::uint32_t, std::shared_ptr<FakeEchoes>> echoes;
  std::uint32_t echoes_found = 0;
  BoardSetup::OnAir on_air{{0.08e-6, 20e6, 3000.0, 1.5}, true};
  Duration now{0};
  bool wanted = true;
  BoardBatch batch;
  std::size_t biggest_batch = 0;          // bytes
  std::function<void()> between_batches;  // of one step
  Output output;
  Board board;

 private:
  BoardSetup setup(const Initial& initial) {
    BoardSetup setup;
    setup.radar = kRadar;
    for (const auto& [reg, value] : initial) {
      setup.initial.emplace_back(board::address_of(reg), value);
    }
    setup.echoes = [this](std::uint32_t radar) {
      ++echoes_found;
      return echoes[radar] = std::make_shared<FakeEchoes>(radar);
    };
    setup.has_radar = [](std::uint32_t radar) { return radar <= 1; };
    setup.on_air = [this] { return on_air; };
    return setup;
  }

  void decode() {
    EXPECT_EQ(batch.first_record, output.next_record);
    EXPECT_EQ(batch.first_signal, output.next_signal);
    std::size_t at = 0;
    for (const std::uint32_t end : batch.record_ends) {
      const auto bytes = std::span(batch.records).subspan(at, end - at);
      const auto decoded = board::decode_record(bytes);
      ASSERT_TRUE(decoded.ok()) << decoded.error().text;
      EXPECT_EQ(decoded->sequence, output.next_record++);
      EXPECT_EQ(decoded->size, end - at);
      if (const auto* sweep = std::get_if<board::Sweep>(&decoded->record)) {
        output.sweeps.push_back(*sweep);
      }
      at = end;
    }
    EXPECT_EQ(at, batch.records.size());
    at = 0;
    for (const std::uint32_t end : batch.signal_ends) {
      const auto decoded = board::decode_record(std::span(batch.signals).subspan(at, end - at));
      ASSERT_TRUE(decoded.ok()) << decoded.error().text;
      EXPECT_EQ(decoded->sequence, output.next_signal++);
      if (const auto* edges = std::get_if<board::Edges>(&decoded->record)) {
        EXPECT_GE(edges->from_tick, output.edges_until);
        output.edges_until = edges->to_tick;
        output.edges.insert(output.edges.end(), edges->edges.begin(), edges->edges.end());
      } else {
        output.events.push_back(std::get<board::Event>(decoded->record));
      }
      at = end;
    }
    EXPECT_EQ(at, batch.signals.size());
  }
};

}  // namespace skerry::server
