// Named scenes, ready to render.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "echo/spoke_renderer.hpp"
#include "tests/scenes/charts.hpp"

namespace skerry::scenes {

// A scene, the radar that looks at it and how its video is set.
struct NamedScene {
  std::string name;
  echo::ScenePtr scene;
  echo::RadarSet set;
  ScanGeometry geometry;
  double rpm = 24.0;
  echo::ViewControls controls;
};

// An own ship at `own_ship` with that coast around her.
echo::ScenePtr scene_at(echo::CoastChart chart, GeoPoint own_ship, RangeScale scale,
                        const ScanGeometry& geometry, std::vector<echo::Hull> hulls = {},
                        double heading_deg = 0.0, const echo::CoastRules& rules = {.seed = 1});

// Hulls of a dozen ships and boats on all bearings out to `reach_m`.
std::vector<echo::Hull> a_dozen_ships(double reach_m);

// Made up, so that they are the same everywhere: "open sea", "islands", "traffic", "coarse" (256
// spokes), "fine" (8192 spokes of 4096 cells), "four bits", "rain control", "rain" (of
// every kind).
std::vector<NamedScene> made_up_scenes();

// Bergen as the server's default shows it; empty where no chart is installed.
std::optional<NamedScene> bergen();

// Video of `scans` turns, spoke after spoke, rendered in sectors of 16.
std::vector<std::uint8_t> render_scans(const NamedScene& named, std::uint32_t scans,
                                       const echo::ParallelFor& parallel = echo::serial_for);

// 64-bit FNV-1a.
std::uint64_t hash_of(const std::vector<std::uint8_t>& bytes);

}  // namespace skerry::scenes
