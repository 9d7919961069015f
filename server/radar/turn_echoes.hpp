// TurnEchoes: the echo of a radar round the turn, for interface boards.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/spoke_returns.hpp"
#include "echo/sweeps/sweep_echoes.hpp"
#include "server/radar/coast_keeper.hpp"
#include "server/radar/radar_unit.hpp"
#include "server/radar/scene_builder.hpp"
#include "server/world/timeline.hpp"

namespace skerry::server {

// Makes rows of a radar's power besides its own spokes, for the same world and at the same times:
// 4096 in a turn, 8192 where the beam is narrower than 0.7 deg, of 4096 cells of whole ticks that
// cover the reach (sweep_cell_m; 96 NM at most), in blocks of kBlockRows.  What the radar has on
// the air (its pulse, its tuning, whether it transmits) is looked up for every block.
//
// Of the radar's faults all act on rows but lost spokes; a blackout leaves no echo.
//
// The coast is asked for in a slot of its own, and only for rows; until it has come, that of the
// radar's spokes serves, as far as it goes.  A radar never waits for this.
//
// An antenna that stood still points elsewhere than its clock says: the scene of the true time is
// then told to be as old as makes the two agree.  What counts from the beginning of the scenario (a
// racon's periods) lags by as much; what moves is where it is, to kSameTime.
// Thread: one at a time, the board's.
class TurnEchoes final : public echo::SweepEchoes {
 public:
  static constexpr std::uint32_t kCells = 4096;
  static constexpr std::uint32_t kBlockRows = 16;
  // The clock of the rows and the true time may differ by this: 0.03 m at 30 m/s.
  static constexpr Duration kSameTime = std::chrono::milliseconds(1);
  // A row older than this is made anew when it is asked for again: of an antenna that stands still.
  static constexpr Duration kStale = std::chrono::milliseconds(50);

  // All must outlive it.
  TurnEchoes(const RadarUnit& radar, Timeline& timeline, CoastService& coast,
             const Airwaves& airwaves);

  void set(const Wish& wish) override;
  Grid grid() const override { return grid_; }
  bool radiates() const override { return radar_.radar_controls().transmit; }
  std::span<const float> row(std::uint64_t n, ScenarioTime when) override;

 private:
  struct Block {
    std::optional<std::uint64_t> number;
    Duration behind{};  // of the true time, by the clock of the rows
    echo::AlignedFloats rows;
  };
  echo::Pulse pulse() const;
  void lay_grid();
  void make(Block& block, std::uint64_t n, ScenarioTime when);
  echo::ScenePtr scene_at(ScenarioTime when);

  const RadarUnit& radar_;
  Timeline& timeline_;
  CoastService& coast_;
  CoastKeeper keeper_;
  const Airwaves& airwaves_;
  SceneBuilder scenes_;
  echo::RadarFaults faults_;  // at the scene's time
  Wish wish_;
  RangeScale scale_;
  Grid grid_;
  echo::SpokeClock clock_{24.0, 4096};
  std::optional<echo::SpokeReturns> returns_;  // of grid_, or made at the next row
  std::array<Block, 2> blocks_;
  std::size_t used_last_ = 0;
  echo::AlignedFloats empty_;
};

}  // namespace skerry::server
