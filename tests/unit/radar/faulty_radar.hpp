// A radar on an open sea that sees one boat, with faults.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "server/radar/sector_maker.hpp"
#include "server/world/scenario.hpp"
#include "server/world/world.hpp"
#include "tests/unit/radar/open_sea.hpp"

namespace skerry::server {

// Own ship at 60 N 5 E lies on north; a boat 2 NM off on 045; range 3 NM.
class FaultyRadar {
 public:
  static constexpr std::uint32_t kTurn = 2048, kCells = 1024;

  FaultyRadar()
      : scenario_(parse_scenario(
            "name: s\nseed: 3\nown_ships:\n"
            "  - {name: F, position: {lat: 60, lon: 5}, length_m: 90, beam_m: 15, radars: [{}]}\n"
            "targets:\n"
            "  - {name: boat, position: {lat: 60.0235427, lon: 5.0470735}, length_m: 8, beam_m: "
            "3,\n"
            "     height_m: 2, cross_section_m2: 25}\n",
            "f")),
        state_(World(scenario_).state()) {
    config_.name = "r";
    config_.geometry = {kTurn, kCells, 8};
    config_.seed = 3;
    config_.controls.range_scale = *RangeScale::find(3.0);
    config_.controls.gain = 50.0;
    config_.controls.sea = 0.0;
  }

  void set(const wire::Faults& faults) {
    FaultState state{faults};
    state.held_heading_deg = held_heading_deg;
    state.held_position = held_position;
    ship().faults = std::make_shared<FaultState>(state);
  }
  void clear() { ship().faults = nullptr; }
  ShipState& ship() { return state_.own_ships.front(); }
  RadarConfig& config() { return config_; }
  WorldState& state() { return state_; }
  std::optional<double> held_heading_deg;
  std::optional<GeoPoint> held_position;

  // Spokes first .. of so many sectors, by a radar that has made none before.
  std::vector<SpokePtr> spokes(std::uint64_t first, std::uint32_t sectors) const {
    SectorMaker maker(config_, 0);
    CoastService coasts(std::make_unique<OpenSea>(), 1, {});
    SectorInputs inputs;
    inputs.views = {{0, config_.controls}};
    inputs.on_air = config_.controls.range_scale;
    inputs.state = std::make_shared<const WorldState>(state_);
    coasts.prepare_now(0, maker.wish(inputs.state->own_ships.front(), inputs.views, 0));
    inputs.coast = coasts.latest(0);
    inputs.emissions = Airwaves(1).get();
    std::vector<SpokePtr> all;
    std::vector<ViewSector> made;
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const std::uint64_t at = first + std::uint64_t{s} * SectorMaker::kSectorSpokes;
      maker.turn(at, inputs.radar);
      maker.make(at, inputs, made);
      for (const SpokePtr& spoke : made.front().sector.spokes) all.push_back(spoke);
    }
    return all;
  }

  // The boat's echo, of cells that stand out, between bearings and ranges: weights are video.
  struct Echo {
    int cells = 0, brightest = 0;
    double spoke = 0.0, cell = 0.0;  // centroid
  };
  Echo boat(std::uint32_t first_spoke = 128, std::uint32_t sectors = 16) const {
    const std::vector<SpokePtr> all = spokes(first_spoke, sectors);
    Echo echo;
    double sum = 0.0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      for (std::uint32_t i = 100; i < kCells; ++i) {
        const int video = all[k]->cells[i];
        echo.brightest = std::max(echo.brightest, video);
        if (video < 60) continue;
        ++echo.cells;
        sum += video;
        echo.spoke += video * (first_spoke + static_cast<double>(k));
        echo.cell += video * (i + 0.5);
      }
    }
    echo.spoke /= sum;
    echo.cell /= sum;
    return echo;
  }
  double cell_m() const {
    return config_.geometry.cell_size(config_.controls.range_scale).in_metres();
  }

 private:
  scenario::Scenario scenario_;
  WorldState state_;
  RadarConfig config_;
};

}  // namespace skerry::server
