#include "echo/returns/static_returns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <thread>
#include <tuple>

#include "echo/kernel/isa.hpp"
#include "echo/returns/static_frame.hpp"
#include "tests/scenes/scenes.hpp"
#include "tests/unit/returns/voyage.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kSector = 16;
constexpr ScanGeometry kGeometry{1024, 512, 8};

RadarModel model_at(double nm) {
  const SpokeClock clock(24.0, kGeometry.spokes_per_turn);
  return radar_model(RadarSet{}, kGeometry, *RangeScale::find(nm), clock, 0);
}

CoastChart islands(double nm, int count = 60) {
  return scenes::made_up_chart(scenes::kBergen, nautical_miles(1.3 * nm + 1.0), count, 7);
}

Voyage voyage(double nm, double speed_mps, double turn_rate = 0.0, int count = 60) {
  return {islands(nm, count), scenes::kBergen, model_at(nm), speed_mps, 31.0, turn_rate};
}

// Bounds of moved rows against fresh ones, as below; echo/returns/README.md has what is measured
// off Bergen.
constexpr double kMovedP50Db = 0.6, kMovedBeyondP90Db = 3.0;

std::uint64_t mixed_up(std::uint64_t hash, std::uint64_t value) {
  return (hash ^ value) * 0x100000001B3ull;
}

std::uint64_t hash_of_turns(Voyage&& sailing, const RadarModel& model, int turns,
                            const ParallelFor& parallel) {
  StaticReturns returns(model, parallel);
  std::uint64_t hash = 0xCBF29CE484222325ull;
  std::vector<float> power(kGeometry.cells);
  std::vector<CellRun> dry;
  const auto spokes = static_cast<std::uint64_t>(turns) * kGeometry.spokes_per_turn;
  for (std::uint64_t first = 0; first < spokes; first += kSector) {
    const Scene& scene = sailing.at(first);
    returns.prepare(scene, first, kSector);
    for (std::uint32_t k = 0; k < kSector; ++k) {
      const SpokeAim aim = aim_of(scene, model.clock, first + k);
      std::fill(power.begin(), power.end(), 0.0f);
      returns.add(aim, power, dry);
      for (const float p : power) hash = mixed_up(hash, std::bit_cast<std::uint32_t>(p));
      for (const CellRun run : dry) hash = mixed_up(hash, run.first * 65536u + run.last);
      hash = mixed_up(hash,
                      std::bit_cast<std::uint32_t>(returns.hidden_height(aim.plane_units, 4000.0)));
    }
  }
  return hash;
}

ParallelFor threads(std::size_t workers) {
  return [workers](std::size_t count, const std::function<void(std::size_t)>& body) {
    std::vector<std::thread> pool;
    for (std::size_t w = 0; w < workers; ++w) {
      pool.emplace_back([&, w] {
        for (std::size_t i = count; i-- > 0;) {
          if (i % workers == w) body(i);
        }
      });
    }
    for (std::thread& thread : pool) thread.join();
  };
}

TEST(StaticReturns, AreTheSameForAnyNumberOfWorkersAndOnEveryInstructionSet) {
  const RadarModel model = model_at(3.0);
  const auto hash = [&](const ParallelFor& parallel) {
    return hash_of_turns(voyage(3.0, 30.0, 2.0), model, 2, parallel);
  };
  const std::uint64_t expected = hash(serial_for);
  for (const std::size_t workers : {2u, 3u, 8u})
    EXPECT_EQ(hash(threads(workers)), expected) << workers;
  for (const Isa isa : {Isa::baseline, Isa::avx2}) {
    force_isa(isa);
    EXPECT_EQ(hash(serial_for), expected) << name_of(isa);
  }
  force_isa(best_isa());
}

struct Error {
  std::vector<double> db;         // of cells over the noise, against fresh rows
  std::vector<double> beyond_db;  // beyond what the fresh row holds in the cell and its neighbours
  std::vector<double> edge_cells;
  double bias_db = 0.0;  // summed, of each cell at most 10

  void compare(std::span<const float> a, std::span<const float> b, std::uint32_t blind) {
    const auto level = [](float p) { return 10.0 * std::log10(1.0 + static_cast<double>(p)); };
    std::size_t edge_a = 0, edge_b = 0;
    for (std::size_t i = blind; i + 1 < a.size(); ++i) {
      if (edge_a == 0 && a[i] > 10.0f) edge_a = i;
      if (edge_b == 0 && b[i] > 10.0f) edge_b = i;
      if (a[i] < 1.0f && b[i] < 1.0f) continue;
      const auto [least, most] = std::minmax({b[i - 1], b[i], b[i + 1]});
      db.push_back(std::fabs(level(a[i]) - level(b[i])));
      bias_db += std::clamp(level(a[i]) - level(b[i]), -10.0, 10.0);
      beyond_db.push_back(std::max({0.0, level(a[i]) - level(most), level(least) - level(a[i])}));
    }
    if (edge_a > 0 && edge_b > 0)
      edge_cells.push_back(std::fabs(static_cast<double>(edge_a) - static_cast<double>(edge_b)));
  }
  static double quantile(std::vector<double>& v, double share) {
    if (v.empty()) return 0.0;
    const auto at = static_cast<std::size_t>(share * static_cast<double>(v.size() - 1));
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(at), v.end());
    return v[at];
  }
};

// Ten turns and more under way, straight on and turning; every few sectors one spoke is compared
// with the same one of rows made on the spot.
TEST(StaticReturns, MovedRowsAreNearFreshOnes) {
  for (const auto& [nm, speed, rate] :
       {std::tuple{3.0, 10.0, 0.0}, {3.0, 10.0, 3.0}, {0.75, 5.0, 0.0}}) {
    const RadarModel model = model_at(nm);
    Voyage sailing = voyage(nm, speed, rate);
    StaticReturns returns(model, serial_for);
    Error error;
    double farthest = 0.0;
    std::vector<float> moved(kGeometry.cells), fresh(kGeometry.cells);
    std::vector<CellRun> dry;
    for (std::uint64_t first = 0; first < 12 * kGeometry.spokes_per_turn; first += kSector) {
      const Scene& scene = sailing.at(first);
      returns.prepare(scene, first, kSector);
      farthest = std::max(farthest, returns.effort().moved_m);
      if (first / kSector % 13 != 5) continue;
      const SpokeAim aim = aim_of(scene, model.clock, first + 8);
      StaticReturns on_the_spot(model, serial_for);
      on_the_spot.prepare(scene, first + 8, 1);
      std::fill(moved.begin(), moved.end(), 0.0f);
      std::fill(fresh.begin(), fresh.end(), 0.0f);
      returns.add(aim, moved, dry);
      on_the_spot.add(aim, fresh, dry);
      error.compare(moved, fresh, std::max(1u, model.blind_cells));
    }
    const auto frames = returns.effort().frames;
    std::printf(
        "%g NM, %g m/s, %g deg/s: %zu cells, %llu frames, moved up to %.0f m (%.1f cells): dB p50 "
        "%.2f p90 %.2f p99 %.1f max %.1f; beyond the neighbouring cells p50 %.2f p90 %.2f p99 "
        "%.1f; "
        "edge p90 %.0f cells; bias %.2f dB\n",
        nm, speed, rate, error.db.size(), static_cast<unsigned long long>(frames), farthest,
        farthest / model.cell_m, Error::quantile(error.db, 0.5), Error::quantile(error.db, 0.9),
        Error::quantile(error.db, 0.99), Error::quantile(error.db, 1.0),
        Error::quantile(error.beyond_db, 0.5), Error::quantile(error.beyond_db, 0.9),
        Error::quantile(error.beyond_db, 0.99), Error::quantile(error.edge_cells, 0.9),
        error.bias_db / static_cast<double>(error.db.size()));
    EXPECT_GE(frames, 3u);
    EXPECT_GT(error.db.size(), 1000u);
    EXPECT_LE(Error::quantile(error.db, 0.5), kMovedP50Db);
    EXPECT_LE(Error::quantile(error.beyond_db, 0.9), kMovedBeyondP90Db);
    EXPECT_LE(Error::quantile(error.edge_cells, 0.9), 1.0);
    // An edge between two cells shows in both: up to a cell more of each echo.
    EXPECT_NEAR(error.bias_db / static_cast<double>(error.db.size()), 0.0, 1.5);
  }
}

// What two spokes share lies half a spoke off either, which is half a row at most.
TEST(StaticReturns, TwoSpokesShareARowNoNarrowerThanOne) {
  for (const double beam_deg : {0.5, 1.2, 2.0, 5.0}) {
    for (const std::uint32_t spokes : {1024u, 2048u, 4096u, 8192u}) {
      RadarModel model = model_at(6.0);
      model.set.beam_width_deg = beam_deg;
      model.geometry.spokes_per_turn = spokes;
      const StaticReturns returns(model, serial_for);
      const double row_spokes = double{1} * spokes / frame_detail(model).rows;
      EXPECT_EQ(returns.spokes_to_a_row(), row_spokes >= 1.0 ? 2u : 1u);
    }
  }
}

// The rise before the nearest land is laid too, and her way does not cut it off.
TEST(StaticReturns, EchoesBeginBeforeTheNearestLandWhereTheFilterHasThemBegin) {
  const auto first_cell = [](RangeFilter filter) {
    Voyage sailing = voyage(1.5, 0.0);
    RadarModel model = model_at(1.5);
    model.set.range_filter = filter;
    model.bandwidth_cells = 0.1;
    StaticReturns returns(model, serial_for);
    std::vector<float> power(kGeometry.cells);
    std::vector<CellRun> dry;
    std::size_t nearest = kGeometry.cells;
    for (std::uint64_t first = 0; first < kGeometry.spokes_per_turn; first += kSector) {
      const Scene& scene = sailing.at(first);
      returns.prepare(scene, first, kSector);
      for (std::uint32_t k = 0; k < kSector; ++k) {
        std::fill(power.begin(), power.end(), 0.0f);
        returns.add(aim_of(scene, model.clock, first + k), power, dry);
        const auto echo = std::find_if(power.begin(), power.end(), [](float p) { return p > 0; });
        nearest = std::min(nearest, static_cast<std::size_t>(echo - power.begin()));
      }
    }
    return nearest;
  };
  const std::size_t sharp = first_cell(RangeFilter::none);
  ASSERT_GT(sharp, 20u);
  // A Gaussian of a tenth of a cell's bandwidth leads by 10 cells; packing by blocks adds some.
  EXPECT_LE(first_cell(RangeFilter::gaussian), sharp - 9);
}

// She turns on the spot: one frame, and its rows are those of one made at any moment of it.
TEST(StaticReturns, TurningOnTheSpotMakesNoOtherFrameAndMovesNothing) {
  const RadarModel model = model_at(3.0);
  Voyage turning = voyage(3.0, 0.0, 6.0);
  StaticReturns returns(model, serial_for);
  std::vector<float> kept(kGeometry.cells), fresh(kGeometry.cells);
  std::vector<CellRun> dry;
  int echoing = 0;
  for (std::uint64_t first = 0; first < 4 * kGeometry.spokes_per_turn; first += kSector) {
    const Scene& scene = turning.at(first);
    returns.prepare(scene, first, kSector);
    if (first < 2 * kGeometry.spokes_per_turn || first % 64 != 0) continue;
    StaticReturns of_now(model, serial_for);
    of_now.prepare(scene, first, kSector);
    const SpokeAim aim = aim_of(scene, model.clock, first + 7);
    std::fill(kept.begin(), kept.end(), 0.0f);
    std::fill(fresh.begin(), fresh.end(), 0.0f);
    returns.add(aim, kept, dry);
    of_now.add(aim, fresh, dry);
    EXPECT_EQ(kept, fresh);
    echoing += std::any_of(kept.begin(), kept.end(), [](float p) { return p > 1.0f; });
  }
  EXPECT_GT(echoing, 5);
  EXPECT_EQ(returns.effort().frames, 1u);
}

// Rows made sector by sector while she sails: a few, evenly, through new pictures of the coast.
TEST(StaticReturns, TheMakingIsSpreadAlsoWhenAPictureOfTheCoastIsHandedOver) {
  const RadarModel model = model_at(3.0);
  Voyage sailing = voyage(3.0, 10.0);
  StaticReturns returns(model, serial_for);
  std::uint64_t before = 0;
  std::vector<std::uint64_t> rows;
  for (std::uint64_t first = 0; first < 20 * kGeometry.spokes_per_turn; first += kSector) {
    returns.prepare(sailing.at(first), first, kSector);
    const std::uint64_t now = returns.effort().rows;
    if (first >= kGeometry.spokes_per_turn) rows.push_back(now - before);
    before = now;
  }
  const double mean = static_cast<double>(before) / (20.0 * kGeometry.spokes_per_turn / kSector);
  const std::uint64_t most = *std::max_element(rows.begin(), rows.end());
  std::printf("%d pictures, %llu frames; rows a sector: mean %.1f, most %llu\n", sailing.pictures(),
              static_cast<unsigned long long>(returns.effort().frames), mean,
              static_cast<unsigned long long>(most));
  EXPECT_GE(sailing.pictures(), 3);
  EXPECT_LE(static_cast<double>(most), 4.0 * mean);
}

TEST(StaticReturns, AShipThatLiesStillMakesOneFrameUnlessTheWaterMoves) {
  const RadarModel model = model_at(3.0);
  const auto frames_after = [&](double level, double waves, bool sand) {
    CoastChart chart = islands(3.0);
    if (sand) {
      chart.shores = {{CoastType::sandy, 0.0f}};
      for (CoastRing& ring : chart.rings) ring.shores.assign(ring.edges.size(), 0);
    }
    Voyage still(std::move(chart), scenes::kBergen, model, 0.0, 0.0);
    StaticReturns returns(model, serial_for);
    for (std::uint64_t first = 0; first < 12 * kGeometry.spokes_per_turn; first += kSector) {
      if (first == 2 * kGeometry.spokes_per_turn) {
        still.scene().water_level_m = level;
        still.scene().wave_height_m = waves;
      }
      returns.prepare(still.at(first), first, kSector);
    }
    return returns.effort().frames;
  };
  EXPECT_EQ(frames_after(0.0, 0.0, false), 1u);
  EXPECT_EQ(frames_after(-1.0, 0.0, true), 2u);
  EXPECT_GE(frames_after(0.0, 5.0, true), 3u);
  // A swash that does not reach half a cell, of which the first frame behind the change has one.
  EXPECT_EQ(frames_after(0.0, 0.4, true), 2u);
  EXPECT_EQ(frames_after(0.0, 5.0, false), 2u);
}

TEST(StaticReturns, OpenSeaIsEmptyAndLeavesTheRowAlone) {
  const RadarModel model = model_at(3.0);
  Voyage sea = voyage(3.0, 10.0, 0.0, 0);
  StaticReturns returns(model, serial_for);
  const Scene& scene = sea.at(0);
  returns.prepare(scene, 0, kSector);
  EXPECT_TRUE(returns.empty());
  std::vector<float> power(kGeometry.cells, 3.0f);
  const SpokeAim aim = aim_of(scene, model.clock, 3);
  std::vector<CellRun> dry(2);
  EXPECT_FALSE(returns.add(aim, power, dry));
  EXPECT_EQ(power, std::vector<float>(kGeometry.cells, 3.0f));
  EXPECT_EQ(returns.hidden_height(aim.plane_units, 3000.0), 0.0f);
  EXPECT_TRUE(dry.empty());
  EXPECT_EQ(returns.effort().rows, 0u);
}

// A jump of the own ship: what each sector needs is made at once, and is what a new one makes.
TEST(StaticReturns, AfterAJumpRowsAreMadeWhereSheIsNow) {
  const RadarModel model = model_at(3.0);
  Voyage one = voyage(3.0, 5.0), other = voyage(3.0, 5.0);
  StaticReturns returns(model, serial_for);
  for (std::uint64_t first = 0; first < kGeometry.spokes_per_turn; first += kSector)
    returns.prepare(one.at(first), first, kSector);
  for (std::uint64_t first = 0; first < 400 * kSector; first += kSector) other.at(first * 40);
  const Scene& far = other.at(400 * kSector * 40);
  StaticReturns fresh(model, serial_for);
  returns.prepare(far, 400 * kSector * 40, kSector);
  fresh.prepare(far, 400 * kSector * 40, kSector);
  const SpokeAim aim = aim_of(far, model.clock, 400 * kSector * 40 + 5);
  std::vector<float> a(kGeometry.cells, 0.0f), b(kGeometry.cells, 0.0f);
  std::vector<CellRun> dry;
  returns.add(aim, a, dry);
  fresh.add(aim, b, dry);
  EXPECT_EQ(a, b);
}

// Heights that land hides, and cells without sea, against the land along each ray.
TEST(StaticReturns, KnowWhatLandHidesAndWhereNoSeaIsSeen) {
  const RadarModel model = model_at(3.0);
  Voyage sailing = voyage(3.0, 10.0);
  StaticReturns returns(model, serial_for);
  std::uint64_t first = 0;
  for (; first < 5 * kGeometry.spokes_per_turn; first += kSector)
    returns.prepare(sailing.at(first), first, kSector);
  const Scene& scene = sailing.at(first);
  std::vector<Crossing> crossings;
  std::vector<LandInterval> land;
  std::vector<CellRun> dry;
  std::vector<float> power(kGeometry.cells);
  int shore = 0, behind = 0, before = 0;
  double worst = 0.0;
  for (std::uint32_t k = 0; k < kGeometry.spokes_per_turn; k += 3) {
    returns.prepare(scene, first, 1);
    const SpokeAim aim = aim_of(scene, model.clock, first + k);
    find_crossings(*scene.coast, *scene.index, {aim.own_ship, aim.plane_units}, crossings);
    land_along(crossings, false, model.cell_m * kGeometry.cells, land);
    returns.add(aim, power, dry);
    for (std::size_t i = 1; i < dry.size(); ++i) EXPECT_GT(dry[i].first, dry[i - 1].last);
    if (land.empty() || land[0].begin_m > 5000.0 || land[0].end_m - land[0].begin_m < 300.0)
      continue;
    ASSERT_FALSE(dry.empty());
    worst = std::max(worst, std::fabs(dry[0].first - land[0].begin_m / model.cell_m) *
                                (dry[0].first * model.cell_m > 0.9 * land[0].begin_m ? 1.0 : 0.0));
    ++shore;
    before += returns.hidden_height(aim.plane_units, 0.8 * land[0].begin_m) > 0.0f;
    behind += returns.hidden_height(aim.plane_units, land[0].end_m + 200.0) > 0.5f;
  }
  std::printf("%d shores, the first dry cell off by %.1f at most; hidden before %d, behind %d\n",
              shore, worst, before, behind);
  EXPECT_GT(shore, 50);
  EXPECT_EQ(before, 0);
  EXPECT_GT(behind, shore * 9 / 10);
}

TEST(StaticReturns, MemoryIsBoundedAndCellsAreSoundAtEveryRange) {
  for (const double nm : {0.25, 0.75, 6.0, 24.0, 96.0}) {
    const RadarModel model = model_at(nm);
    Voyage sailing = voyage(nm, 15.0, 1.0);
    StaticReturns returns(model, serial_for);
    std::vector<float> power(kGeometry.cells);
    std::vector<CellRun> dry;
    for (std::uint64_t first = 0; first < 3 * kGeometry.spokes_per_turn; first += kSector) {
      const Scene& scene = sailing.at(first);
      returns.prepare(scene, first, kSector);
      std::fill(power.begin(), power.end(), 0.0f);
      returns.add(aim_of(scene, model.clock, first), power, dry);
      for (const float p : power)
        ASSERT_TRUE(p == 0.0f || (p > 1e-12f && p < 1e30f)) << p << " at " << nm;
    }
    // Two frames of 4096 rows of two bytes a cell, and a megabyte and a half each beside.
    const double most = 2.0 * (4096.0 * 2.0 * (kGeometry.cells + 100.0) + 2.5e6);
    EXPECT_LE(static_cast<double>(returns.bytes()), most) << nm;
  }
}

}  // namespace
}  // namespace skerry::echo
