// sweep_bench: what an interface board's sweeps cost on one core, against real time and the floor.
//
//   sweep_bench                 sweeps alone, decimated, and with the making of their rows
//   sweep_bench --turns 4       longer
//
// Columns: us per sweep of one trigger (all its channels); ns per tick of the sample clock, the
// floor of the same run (ns/cell) and their ratio; how many times faster than triggers come
// ("margin").  Medians of CPU time of the thread; sweeps and floor take turns.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "echo/spoke_returns.hpp"
#include "echo/sweeps/sweep_receiver.hpp"
#include "tests/bench/bench_support.hpp"
#include "tests/scenes/full_scene.hpp"
#include "tests/scenes/moving_scene.hpp"

namespace skerry::bench {
namespace {

constexpr double kPrf = 3000.0;
constexpr std::uint32_t kRows = 4096, kCells = 4096, kSector = 16;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The full scene on 6 NM by the short pulse, in cells of 2.7 m.
struct Air {
  scenes::NamedScene named;
  echo::SpokeClock clock;
  echo::RadarModel model;

  explicit Air(const scenes::NamedScene& full)
      : named(full),
        clock(full.rpm, kRows),
        model(echo::radar_model(full.set, {kRows, kCells, 8}, full.controls.range_scale, clock, 0,
                                echo::PulseChoice::short_pulse)) {}

  echo::SweepEchoes::Grid grid() const {
    return {.rows_per_turn = kRows,
            .cells = kCells,
            .cell_m = model.cell_m,
            .pulse = model.pulse,
            .blind_m = model.blind_cells * model.cell_m,
            .seed = named.scene->seed,
            .radar = 0};
  }
  // At which so many ticks reach just to the end of the grid.
  double clock_for(std::uint32_t ticks) const {
    return 0.5 * echo::kLightSpeed * ticks / (kCells * model.cell_m);
  }
};

// The channels of a board, and where their codes go.
class Channels {
 public:
  Channels(const std::vector<echo::SweepChannel>& channels, const echo::SweepEchoes::Grid& grid) {
    for (const echo::SweepChannel& channel : channels) {
      receivers_.emplace_back(channel, grid);
      codes_.emplace_back(channel.samples);
    }
  }
  void receive(std::span<const float> before, std::span<const float> after, float share,
               std::uint64_t trigger) {
    for (std::size_t i = 0; i < receivers_.size(); ++i)
      receivers_[i].receive(before, after, share, trigger, codes_[i]);
    benchmark::DoNotOptimize(codes_);
  }
  double ticks() const {
    double sum = 0.0;
    for (const echo::SweepReceiver& one : receivers_)
      sum += double{1} * one.channel().samples * one.channel().decimation;
    return sum;
  }

 private:
  std::vector<echo::SweepReceiver> receivers_;
  std::vector<std::vector<std::uint16_t>> codes_;
};

void heading() {
  fmt::print("{:<58}{:>10}{:>9}{:>8}{:>8}{:>9}\n", "", "us/sweep", "ns/tick", "floor", "ratio",
             "margin");
}

void report(const std::string& name, double sweep_s, double ticks, double floor_ns, double prf) {
  const double tick_ns = 1e9 * sweep_s / ticks;
  fmt::print("{:<58}{:>10.2f}{:>9.2f}{:>8.2f}{:>8.2f}{:>9.1f}\n", name, 1e6 * sweep_s, tick_ns,
             floor_ns, tick_ns / floor_ns, 1.0 / (prf * sweep_s));
}

// From rows at hand: 16 of them by turns, as a board finds them after one was made.
void sweeps_alone(const std::string& name, const Air& air,
                  const std::vector<echo::SweepChannel>& channels, int turns) {
  echo::SpokeReturns returns(air.model, echo::serial_for);
  const echo::PowerRows rows = returns.make(*air.named.scene, 0, kSector);
  const auto row = [&](std::uint32_t k) { return rows.cells.subspan(k * rows.pitch, kCells); };
  Channels board(channels, air.grid());
  Floor floor(1024);
  std::vector<double> sweep_s, floor_ns;
  std::uint64_t trigger = 0;
  for (int round = 0; round < 20 * turns; ++round) {
    constexpr std::uint32_t kSweeps = 100;
    const double begun = thread_seconds();
    for (std::uint32_t i = 0; i < kSweeps; ++i, ++trigger) {
      const auto k = static_cast<std::uint32_t>(trigger % (kSector - 1));
      board.receive(row(k), row(k + 1), 0.3f, trigger);
    }
    const double made = thread_seconds();
    for (std::uint32_t i = 0; i < 64; ++i) floor.run();
    sweep_s.push_back((made - begun) / kSweeps);
    floor_ns.push_back(1e9 * (thread_seconds() - made) / (64.0 * floor.cells()));
  }
  report(name, median(sweep_s), board.ticks(), median(floor_ns), kPrf);
}

// The rows of turns of a moving scene in sectors, and the sweeps between them: what a board costs.
void with_rows(const std::string& name, const Air& air,
               const std::vector<echo::SweepChannel>& channels, int turns) {
  echo::SpokeReturns returns(air.model, echo::serial_for);
  scenes::MovingScene scenes(air.named.scene);
  Channels board(channels, air.grid());
  Floor floor(1024);
  echo::AlignedFloats last(kCells);  // of the sector before
  const double sweeps_per_row = kPrf * air.clock.seconds_per_spoke();
  const double sweeps_per_turn = sweeps_per_row * kRows;
  std::vector<double> turn_s, rows_s, floor_ns;
  std::uint64_t trigger = 0;
  for (int turn = 0; turn <= turns; ++turn) {  // the first fills what is kept
    double all = 0.0, rows_alone = 0.0, bare = 0.0;
    for (std::uint32_t k = 0; k < kRows; k += kSector) {
      const std::uint64_t first = static_cast<std::uint64_t>(turn) * kRows + k;
      const echo::ScenePtr scene = scenes.at(air.clock.time_of(first));
      const double begun = thread_seconds();
      const echo::PowerRows rows = returns.make(*scene, first, kSector);
      const double laid = thread_seconds();
      const auto row = [&](std::uint64_t n) {
        return n + 1 == first ? std::span<const float>(last)
                              : rows.cells.subspan((n - first) * rows.pitch, kCells);
      };
      for (;; ++trigger) {
        const double azimuth = static_cast<double>(trigger) / sweeps_per_row;
        const auto n = static_cast<std::uint64_t>(azimuth);
        if (n + 1 >= first + kSector) break;
        board.receive(row(n), row(n + 1), static_cast<float>(azimuth - static_cast<double>(n)),
                      trigger);
      }
      std::copy_n(row(first + kSector - 1).begin(), kCells, last.begin());
      const double made = thread_seconds();
      for (std::uint32_t i = 0; i < kSector; ++i) floor.run();
      all += made - begun;
      rows_alone += laid - begun;
      bare += thread_seconds() - made;
    }
    if (turn == 0) continue;
    turn_s.push_back(all);
    rows_s.push_back(rows_alone);
    floor_ns.push_back(1e9 * bare / (double{1} * kRows * floor.cells()));
  }
  report(name, median(turn_s) / sweeps_per_turn, board.ticks(), median(floor_ns), kPrf);
  fmt::print("{:<58}{:>10.2f}\n", "  of that the rows", 1e6 * median(rows_s) / sweeps_per_turn);
}

int run(int turns) {
  const auto full = scenes::full_scene();
  if (!full) {
    fmt::print("no chart installed: apt install gmt-gshhg-full\n");
    return 0;
  }
  const Air air(*full);
  echo::SweepChannel log;
  log.sample_clock_hz = air.clock_for(log.samples);
  echo::SweepChannel linear = log;
  linear.detector = echo::VideoDetector::linear;
  // 125 MHz without a pause: 41 664 of the 41 667 ticks between two triggers.
  echo::SweepChannel fast;
  fast.sample_clock_hz = 125e6;
  fast.bits = 14;
  fast.samples = 10416;
  fast.decimation = 4;
  fast.mode = echo::CodeDecimation::mean;
  echo::SweepChannel fast_linear = fast;
  fast_linear.detector = echo::VideoDetector::linear;
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    if (isa > echo::best_isa()) continue;
    echo::force_isa(isa);
    fmt::print("\n{}: full scene on 6 NM, 24 rpm, {} triggers a second\n", echo::name_of(isa),
               kPrf);
    heading();
    sweeps_alone("log, 2048 samples, 12 bits, rows at hand", air, {log}, turns);
    sweeps_alone("linear", air, {linear}, turns);
    sweeps_alone("two channels", air, {log, linear}, turns);
    sweeps_alone("125 MHz, 41 664 ticks by 4, 14 bits", air, {fast}, turns);
    sweeps_alone("two such channels", air, {fast, fast_linear}, turns);
    with_rows("log, 2048 samples, 12 bits, 4096 rows of 4096 cells", air, {log}, turns);
    with_rows("two channels, and rows", air, {log, linear}, turns);
    with_rows("two of 125 MHz, and rows", air, {fast, fast_linear}, turns);
  }
  echo::force_isa(echo::best_isa());
  return 0;
}

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  int turns = 3;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--turns" && i + 1 < argc) {
      turns = std::max(1, std::atoi(argv[++i]));
    } else if (word.starts_with("--benchmark")) {
      turns = 1;  // run with the others, shortly
    } else {
      fmt::print(stderr, "sweep_bench: unknown argument '{}'; usage: sweep_bench [--turns N]\n",
                 word);
      return 2;
    }
  }
  return skerry::bench::run(turns);
}
