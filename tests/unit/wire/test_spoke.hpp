// Spokes for tests: every field set, cells full of noise, the same on every machine.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include "protocol/video/spoke.hpp"

namespace skerry {

inline Spoke test_spoke(const ScanGeometry& geometry, std::size_t scale_index, std::uint32_t index,
                        std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  Spoke spoke;
  spoke.header.radar = 1;
  spoke.header.view = 2;
  spoke.header.sequence = 0x1'0000'0000ull + index;
  spoke.header.scan = 77;
  spoke.header.index = index;
  spoke.header.geometry = geometry;
  spoke.header.range_scale = *RangeScale::from_index(scale_index);
  spoke.header.heading = TrueBearing::from_units(static_cast<std::uint32_t>(random()));
  spoke.header.own_ship = {60.4 + static_cast<double>(random()) * 1e-12, 5.3};
  spoke.header.scenario_time =
      ScenarioTime(Duration(123456789012 + static_cast<std::int64_t>(random())));
  spoke.header.utc = UtcTime(Duration(1795000000123456789 + static_cast<std::int64_t>(random())));
  spoke.cells.resize(geometry.cells);
  for (std::uint8_t& cell : spoke.cells) {
    cell = static_cast<std::uint8_t>(random() & (geometry.bits == 4 ? 0x0F : 0xFF));
  }
  return spoke;
}

// The same as a view with an instrumented range and Doppler classes makes it.
inline Spoke far_doppler_spoke(const ScanGeometry& geometry, std::size_t scale_index, double share,
                               std::uint32_t seed = 1) {
  Spoke spoke = test_spoke(geometry, scale_index, 3, seed);
  spoke.header.instrumented_range = spoke.header.range_scale.length() * share;
  std::mt19937 random(seed);
  for (std::uint32_t i = 0; i < geometry.cells; ++i) {
    spoke.doppler.push_back(static_cast<DopplerClass>(random() % 3));
  }
  return spoke;
}

// Names the parts in which the two differ; empty if they are equal.
inline std::string difference(const Spoke& a, const Spoke& b) {
  std::string names;
  const auto compare = [&](const auto& x, const auto& y, const char* name) {
    if (!(x == y)) names += std::string(names.empty() ? "" : ", ") + name;
  };
  compare(a.header.radar, b.header.radar, "radar");
  compare(a.header.view, b.header.view, "view");
  compare(a.header.sequence, b.header.sequence, "sequence");
  compare(a.header.scan, b.header.scan, "scan");
  compare(a.header.index, b.header.index, "index");
  compare(a.header.geometry, b.header.geometry, "geometry");
  compare(a.header.range_scale, b.header.range_scale, "range scale");
  compare(a.header.heading, b.header.heading, "heading");
  compare(a.header.own_ship, b.header.own_ship, "own ship");
  compare(a.header.scenario_time, b.header.scenario_time, "scenario time");
  compare(a.header.utc, b.header.utc, "utc");
  // The cell size is what travels: its product with the number of cells may differ by a rounding.
  const double reach_m = a.header.reach().in_metres();
  compare(std::abs(b.header.reach().in_metres() - reach_m) <= 1e-12 * reach_m, true, "reach");
  compare(a.header.instrumented_range.in_metres() > 0.0,
          b.header.instrumented_range.in_metres() > 0.0, "instrumented range");
  compare(a.cells, b.cells, "cells");
  compare(a.doppler, b.doppler, "doppler");
  return names;
}

}  // namespace skerry
