// One hash over all tracks of two minutes among ships and islands.  A change of video, plots or
// tracks changes it: then look at the scenes of plotter_scenes, say in the commit why, and write
// the printed value here.
#include <gtest/gtest.h>

#include <bit>
#include <cstdio>

#include "echo/kernel/isa.hpp"
#include "server/core/worker_pool.hpp"
#include "server/plotter/plotter.hpp"
#include "tests/scenes/moving_scene.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::server {
namespace {

constexpr std::uint64_t kHash = 0x3F61809B63767538ull;
constexpr std::uint32_t kTurns = 48, kSector = 16;
constexpr ScanGeometry kGeometry{1024, 512, 8};
constexpr GeoPoint kPlace{56.3, 4.2};

// FNV-1a over words.
class TracksHash {
 public:
  void add(const PlottedTrack& track) {
    for (const std::uint64_t word :
         {std::uint64_t{track.number}, static_cast<std::uint64_t>(track.status),
          static_cast<std::uint64_t>(track.time.time_since_epoch().count()),
          std::uint64_t{track.hits}, std::uint64_t{track.looks}}) {
      add(word);
    }
    for (const double value :
         {track.place.latitude_deg, track.place.longitude_deg, track.velocity_mps.east_m,
          track.velocity_mps.north_m, track.range_m, track.bearing.in_degrees(),
          track.relative_velocity_mps.east_m, track.relative_velocity_mps.north_m,
          track.place_sigma_m, track.velocity_sigma_mps, track.length_m, track.width_m}) {
      add(std::bit_cast<std::uint64_t>(value));
    }
    ++tracks_;
  }
  std::uint64_t value() const { return hash_; }
  int tracks() const { return tracks_; }

 private:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) {
      hash_ = (hash_ ^ (word >> 8 * i & 0xff)) * 0x100000001B3ull;
    }
  }
  std::uint64_t hash_ = 0xCBF29CE484222325ull;
  int tracks_ = 0;
};

TracksHash tracks_with(std::size_t helpers) {
  const RangeScale scale = *RangeScale::find(6.0);
  auto start = std::make_shared<echo::Scene>(
      *scenes::scene_at(scenes::made_up_chart(kPlace, scale.length() * 1.3, 6, 7), kPlace, scale,
                        kGeometry, scenes::a_dozen_ships(8000.0)));
  start->own_velocity = {2.0, 5.0};
  scenes::MovingScene scene(start);
  WorkerPool pool(helpers);
  const echo::SpokeClock clock{24.0, kGeometry.spokes_per_turn};
  echo::SpokeRenderer renderer({}, kGeometry, clock, 0,
                               [&](std::size_t n, const auto& body) { pool.run(n, body); });
  echo::ViewControls controls;
  controls.range_scale = scale;
  renderer.set_controls(controls);
  Plotter::Rule rule;
  rule.tracks.acquire = Tracker::Acquire::all;
  Plotter plotter(rule);
  TracksHash hash;
  std::vector<std::uint8_t> cells(std::size_t{kSector} * kGeometry.cells);
  Spoke spoke;
  spoke.header.geometry = kGeometry;
  spoke.header.range_scale = scale;
  for (std::uint32_t first = 0; first < kTurns * kGeometry.spokes_per_turn; first += kSector) {
    const echo::ScenePtr now = scene.at(clock.time_of(first));
    renderer.render(*now, first, kSector, cells);
    for (std::uint32_t i = 0; i < kSector; ++i) {
      const std::uint32_t n = first + i;
      spoke.header.scan = n / kGeometry.spokes_per_turn;
      spoke.header.index = n % kGeometry.spokes_per_turn;
      spoke.header.sequence = n;
      spoke.header.scenario_time = clock.time_of(n);
      spoke.header.own_ship = now->own_ship_geo;
      const auto begin = cells.begin() + static_cast<std::ptrdiff_t>(i * kGeometry.cells);
      spoke.cells.assign(begin, begin + kGeometry.cells);
      plotter.add(spoke);
    }
    if ((first + kSector) % kGeometry.spokes_per_turn != 0) continue;
    for (const PlottedTrack& track : plotter.tracks()) hash.add(track);
    for (const PlottedTrack& track : plotter.take_lost()) hash.add(track);
  }
  return hash;
}

TEST(TracksGolden, AreTheSameBitsOnEveryInstructionSetAndWithAnyWorkers) {
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    if (isa > echo::best_isa()) continue;
    echo::force_isa(isa);
    const TracksHash hash = tracks_with(0);
    std::printf("constexpr std::uint64_t kHash = 0x%016llXull;  // %s, %d tracks told\n",
                static_cast<unsigned long long>(hash.value()),
                std::string(echo::name_of(isa)).c_str(), hash.tracks());
    EXPECT_EQ(hash.value(), kHash) << echo::name_of(isa);
    EXPECT_GT(hash.tracks(), 200);
  }
  echo::force_isa(echo::best_isa());
  EXPECT_EQ(tracks_with(2).value(), kHash) << "three workers";
}

}  // namespace
}  // namespace skerry::server
