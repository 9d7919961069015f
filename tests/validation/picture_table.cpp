// Not a test: real pictures and ours at like places, as the table of README.md, and side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "echo/kernel/hash.hpp"
#include "echo/measure/picture_turns.hpp"
#include "echo/picture_tool/patch_forest.hpp"
#include "echo/picture_tool/picture_source.hpp"
#include "echo/picture_tool/picture_statistics.hpp"
#include "echo/radar/shipped_sets.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::validation {
namespace {

struct Row {
  const char* capture;
  const char* set;
  double reach_m;  // 0: the one with most turns
  double nominal;  // reach over range scale
};
const Row kRows[] = {
    {"halo20-ranges", "HALO20", 3183.0, 1.72},
    {"3g-trueheading", "3G", 1633.0, 1.77},
    {"br24-ranges-nm", "BR24", 1633.0, 1.77},
    {"br24-ranges-nm", "BR24", 2454.0, 1.77},
    {"4g-ranges-nm", "4G", 1809.0, 1.95},
    {"4g-ranges-nm", "4G", 2713.0, 1.95},
    {"garminxhd_txon_txoff", "xHD", 0.0, 1.125},
    {"halo-velocitytrack-notarget", "HALO24", 0.0, 1.72},
    {"halo3-5-connect-transmit", "HALO3", 0.0, 1.72},
};

echo::RadarSet set_named(const std::string& name) {
  for (const auto& set : echo::shipped_sets())
    if (set.name == name) return set;
  return echo::find_set("HALO20");
}

struct Sim {
  std::vector<std::vector<std::uint8_t>> turns;
};

const GeoPoint kCoasts[] = {{60.27, 5.15},  {48.65, -3.9}, {42.4, -8.9}, {59.4, 18.7},
                            {47.6, -122.5}, {50.2, -5.05}, {43.2, 16.4}, {56.2, -5.6},
                            {44.1, -68.7},  {58.9, 9.5},   {36.9, 27.2}, {-41.2, 174.1}};

Sim simulate(const Row& row, const echo::TurnsOfPicture& real, GeoPoint at, std::uint32_t turns,
             std::uint64_t seed) {
  scenes::NamedScene named;
  named.geometry = {real.spokes, real.cells, real.full_scale == 15 ? 4u : 8u};
  named.set = set_named(row.set);
  named.set.antenna_height_m = 10.0;
  named.rpm = named.set.rpm;
  RangeScale scale;
  double best = 1e9;
  for (std::size_t i = 0; i < RangeScale::kCount; ++i) {
    const RangeScale each = *RangeScale::from_index(i);
    const double off = std::fabs(std::log(each.length().in_metres() * row.nominal / real.reach_m));
    if (each.length().in_metres() * 2.0 >= real.reach_m && off < best) best = off, scale = each;
  }
  named.controls.range_scale = scale;
  named.controls.instrumented_range_m = real.reach_m;
  if (const char* g = std::getenv("GAIN")) named.controls.gain = std::atof(g);
  if (const char* g = std::getenv("SEA")) named.controls.sea = std::atof(g);
  if (const char* g = std::getenv("INTEGRATION")) named.controls.integration = std::atof(g);
  if (const char* g = std::getenv("PULSE"))
    for (auto& p : named.set.pulses)
      p.length_s = std::atof(g) * 1e-6, p.bandwidth_hz = 1.0 / p.length_s;
  if (const char* g = std::getenv("RANGE_DB")) named.set.video_range_db = std::atof(g);
  auto chart = scenes::world_chart(at, metres(real.reach_m * 1.3));
  if (!chart) return {};
  auto scene = std::make_shared<echo::Scene>(
      *scenes::scene_at(std::move(*chart), at, *RangeScale::find(3.0), named.geometry));
  if (scene->ashore) return {};
  scene->own_velocity = {};
  scene->seed = seed;
  named.scene = scene;
  const auto all = scenes::render_scans(named, turns);
  Sim sim;
  const std::size_t turn = std::size_t{real.spokes} * real.cells;
  for (std::uint32_t t = 0; t < turns; ++t)
    sim.turns.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(t * turn),
                           all.begin() + static_cast<std::ptrdiff_t>((t + 1) * turn));
  return sim;
}

void print(const std::string& name, const echo::PictureStatistics& s) {
  fmt::print(
      "{:34} {:.2f}/{:.2f}  {:4.0f}/{:4.0f}/{:4.0f}  {:.3f}/{:.2f}  {:.3f}/{:.2f}  {:.2f}  seam "
      "{:.2f} occ {:.3f}\n",
      name, s.outline_below, s.outline_above, s.ribbon_p10_m, s.ribbon_p50_m, s.ribbon_p90_m,
      s.spoke_lag1, s.spoke_lag4, s.range_lag1, s.range_lag4, s.turn_lag1, s.bow_seam, s.occupancy);
  std::fflush(stdout);
}

// Grey PGM of a turn, north up, 700 px, out to `share` of the reach.
void save(const std::string& file, const echo::PictureTurn& turn) {
  constexpr int kSide = 700;
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << kSide << " " << kSide << "\n255\n";
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double dx = x - kSide / 2 + 0.5, dy = kSide / 2 - y - 0.5;
      const double r = std::hypot(dx, dy) / (kSide / 2) * turn.cells;
      const double a = std::atan2(dx, dy) / (2 * M_PI);
      const auto s = static_cast<std::uint32_t>((a < 0 ? a + 1 : a) * turn.spokes) % turn.spokes;
      std::uint8_t v = 0;
      if (r < turn.cells)
        v = static_cast<std::uint8_t>(turn.at(s, static_cast<std::uint32_t>(r)) * 255 /
                                      turn.full_scale);
      out.put(static_cast<char>(v));
    }
  }
}

}  // namespace

int table(int argc, char** argv) {
  const std::string folder = SKERRY_SOURCE_DIR "/../shared/data/radar/";
  const std::string only = argc > 1 ? argv[1] : "";
  const std::string pictures = std::getenv("PICTURES") ? std::getenv("PICTURES") : "";
  std::map<std::string, std::vector<echo::PicturePatch>> real_patches, sim_patches, sim_b;
  for (const Row& row : kRows) {
    const std::string key = fmt::format("{} {:.0f}", row.capture, row.reach_m);
    if (!only.empty() && key.find(only) == std::string::npos) continue;
    echo::PictureChoice choice;
    choice.reach_m = row.reach_m;
    choice.most_turns = 8;
    echo::TurnsOfPicture real;
    try {
      real = echo::read_picture(folder + row.capture + ".pcap.gz", choice);
    } catch (const std::exception& error) {
      fmt::print("{}\n", error.what());
      continue;
    }
    const double beam = set_named(row.set).beam_width_deg;
    std::vector<echo::PictureTurn> turns;
    for (std::size_t t = 0; t < real.turns.size(); ++t) turns.push_back(real.turn(t, beam));
    print(fmt::format("{} {:.0f} m x{}", row.capture, real.reach_m, turns.size()).substr(0, 34),
          echo::picture_statistics(turns));
    for (std::size_t t = 0; t < std::min<std::size_t>(4, turns.size()); ++t)
      for (auto& p : echo::patches_of(turns[t], 0, 100.0)) real_patches[key].push_back(p);
    if (!pictures.empty()) save(pictures + "/" + row.capture + "-real.pgm", turns[0]);
    int made = 0, tried = 0;
    std::vector<echo::PictureStatistics> all;
    while (made < 6 && tried < 60) {
      const std::uint64_t k = echo::mixed(77, static_cast<std::uint64_t>(tried));
      GeoPoint at = kCoasts[tried % 12];
      ++tried;
      at.latitude_deg += (static_cast<double>(k & 0xFFFF) / 65536.0 - 0.5) * 0.12;
      at.longitude_deg += (static_cast<double>(k >> 16 & 0xFFFF) / 65536.0 - 0.5) * 0.2;
      const Sim sim = simulate(row, real, at, 2, 20261121);
      if (sim.turns.empty()) continue;
      std::vector<echo::PictureTurn> ours;
      for (auto& v : sim.turns)
        ours.push_back(
            {real.spokes, real.cells, real.reach_m / real.cells, beam, real.full_scale, v});
      const auto stats = echo::picture_statistics({ours.data(), 1});
      if (stats.occupancy < 0.03 || stats.occupancy > 0.5) continue;
      all.push_back(echo::picture_statistics(ours));
      for (auto& p : echo::patches_of(ours[0], static_cast<std::uint32_t>(1 + made), 100.0))
        (made % 2 ? sim_b : sim_patches)[key].push_back(p), sim_patches[key + " all"].push_back(p);
      if (!pictures.empty() && made < 2)
        save(fmt::format("{}/{}-ours{}.pgm", pictures, row.capture, made), ours[0]);
      ++made;
    }
    echo::PictureStatistics mean;
    double* m = reinterpret_cast<double*>(&mean);
    for (std::size_t i = 0; i < sizeof mean / sizeof(double); ++i) {
      double n = 0;
      for (auto& s : all) {
        const double v = reinterpret_cast<const double*>(&s)[i];
        if (std::isfinite(v)) m[i] += v, n += 1;
      }
      m[i] /= n;
    }
    print(fmt::format("   ours, {} places", made), mean);
    auto tell = [&](const char* name, auto& a, auto& b, bool shuffled) {
      try {
        const auto mask = echo::tell_apart(a, b, echo::PatchView::mask, 1, shuffled);
        const auto every = echo::tell_apart(a, b, echo::PatchView::all, 1, shuffled);
        fmt::print("   {:12} mask {:.2f} all {:.2f} ({} patches)  ", name, mask.auc, every.auc,
                   mask.patches);
        if (!shuffled)
          for (auto& f : {mask, every}) {
            for (auto& n : f.strongest) fmt::print("{}; ", n);
            fmt::print("| ");
          }
        fmt::print("\n");
      } catch (const echo::TooFewPatches& few) {
        fmt::print("   {:12} too few patches: {} {} matched {}\n", name, few.first, few.second,
                   few.matched);
      }
      std::fflush(stdout);
    };
    tell("real|ours", real_patches[key], sim_patches[key + " all"], false);
    tell("ours|ours", sim_patches[key], sim_b[key], false);
    tell("null", real_patches[key], sim_patches[key + " all"], true);
  }
  if (!std::getenv("PAIRS")) return 0;
  for (auto a = real_patches.begin(); a != real_patches.end(); ++a)
    for (auto b = std::next(a); b != real_patches.end(); ++b) {
      try {
        const auto mask = echo::tell_apart(a->second, b->second, echo::PatchView::mask, 1);
        const auto every = echo::tell_apart(a->second, b->second, echo::PatchView::all, 1);
        fmt::print("{} | {}: mask {:.2f} all {:.2f} ({})\n", a->first, b->first, mask.auc,
                   every.auc, mask.patches);
      } catch (const echo::TooFewPatches&) {
      }
    }
  return 0;
}

}  // namespace skerry::validation

int main(int argc, char** argv) { return skerry::validation::table(argc, argv); }
