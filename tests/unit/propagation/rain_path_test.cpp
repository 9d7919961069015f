#include "echo/propagation/rain_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "echo/kernel/isa.hpp"
#include "tests/unit/rain/rain_reference.hpp"

namespace skerry::echo {
namespace {

RadarModel model_of(double nm, std::uint32_t cells = 1024) {
  ScanGeometry geometry;
  geometry.cells = cells;
  return radar_model(RadarSet{}, geometry, *RangeScale::find(nm), SpokeClock(24.0, 4096), 0);
}

SpokeAim aim_at(double degrees) {
  SpokeAim aim;
  aim.plane_units =
      static_cast<std::uint32_t>(static_cast<std::int64_t>(degrees / 360.0 * 4294967296.0));
  return aim;
}

RainCell cloud(double east, double north, double radius, double rate) {
  RainCell cell;
  cell.centre = {east, north};
  cell.radius_m = radius;
  cell.rate_mm_h = rate;
  cell.kind = RainKind::even;
  return cell;
}

// Two-way loss in dB up to a range, summed in steps of a metre with libm.
class Integral {
 public:
  Integral(const Scene& scene, const SpokeAim& aim, const RainLaw& law)
      : scene_(scene), aim_(aim), law_(law) {
    const double angle = aim.plane_units * (2.0 * std::numbers::pi / 4294967296.0);
    east_ = std::sin(angle);
    north_ = std::cos(angle);
  }
  double rate(double range) const {
    const PlanePoint place = aim_.own_ship + PlanePoint{east_, north_} * range;
    double sum = 0.0;
    for (const RainCell& cell : scene_.rain) {
      const PlanePoint off = place - (cell.centre + cell.velocity * aim_.dt);
      sum += cell.rate_mm_h * rain_profile(dot(off, off), cell.radius_m);
    }
    return sum;
  }
  double loss_db(double range) {
    for (; at_ + 1.0 <= range; at_ += 1.0)
      sum_ += 2e-3 * law_.k * std::pow(rate(at_ + 0.5), law_.alpha);
    return sum_;
  }

 private:
  const Scene& scene_;
  const SpokeAim& aim_;
  RainLaw law_;
  double east_ = 0.0, north_ = 0.0, at_ = 0.0, sum_ = 0.0;
};

TEST(RainPath, StaysWithinItsBoundOfTheIntegral) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double rate_error = 0.0, share_error = 0.0, worst_db = 0.0;
  RainPath path;
  for (double nm : {0.75, 3.0, 12.0, 24.0}) {
    const RadarModel model = model_of(nm);
    const RainLaw law = rain_law(model.set.frequency_hz, model.set.polarisation);
    const double reach = nm * 1852.0;
    for (int trial = 0; trial < 12; ++trial) {
      Scene scene;
      double greatest = 0.0;
      for (int i = 0; i < 3; ++i) {
        scene.rain.push_back(
            cloud((unit(random) - 0.5) * reach, (unit(random) - 0.5) * reach,
                  std::max(4.0 * model.cell_m, reach * (0.05 + 0.4 * unit(random))),
                  std::pow(200.0, unit(random))));
        scene.rain.back().velocity = {12.0 * unit(random), -7.0};
        greatest = std::max(greatest, scene.rain.back().rate_mm_h);
      }
      SpokeAim aim = aim_at(360.0 * unit(random));
      aim.dt = 0.7;
      aim.own_ship = {300.0, -200.0};
      path.lay(scene, model, aim);
      Integral integral(scene, aim, law);
      if (!path.any()) {
        EXPECT_EQ(integral.loss_db(reach), 0.0);
        continue;
      }
      for (std::size_t i = 0; i < 1024; ++i) {
        const double range = (static_cast<double>(i) + 0.5) * model.cell_m;
        rate_error = std::max(
            rate_error,
            std::fabs(static_cast<double>(path.rate_mm_h()[i]) - integral.rate(range)) / greatest);
        const double truth = std::min(integral.loss_db(range), 190.0);
        const double made = -10.0 * std::log10(static_cast<double>(path.transmission()[i]));
        if (truth > 180.0) continue;
        worst_db = std::max(worst_db, std::fabs(made - truth) - 0.02 * truth);
        if (truth > 1.0) share_error = std::max(share_error, std::fabs(made / truth - 1.0));
      }
    }
  }
  std::printf("rain path: rate %.4f of the greatest, loss %.4f of itself and %.4f dB\n", rate_error,
              share_error, worst_db);
  EXPECT_LT(rate_error, 0.02);
  EXPECT_LT(worst_db, 0.02);
}

TEST(RainPath, AUniformCloudIsThePowerLaw) {
  // 16 mm/h over 4 km each way: within half the radius the rate is whole.
  Scene scene;
  scene.rain = {cloud(0.0, 0.0, 8000.0, 16.0)};
  const RadarModel model = model_of(3.0);
  RainPath path;
  path.lay(scene, model, aim_at(77.0));
  ASSERT_TRUE(path.any());
  EXPECT_EQ(path.rate_mm_h()[500], 16.0f);
  // SOURCES.md "Propagation": 1.230 dB two-way per mile.
  for (const auto& [mile, error_db] : {std::pair{1.0, 0.002}, {2.0, 0.003}}) {
    const auto cell = static_cast<std::size_t>(mile * 1852.0 / model.cell_m);
    const double miles = (static_cast<double>(cell) + 0.5) * model.cell_m / 1852.0;
    const double loss_db = -10.0 * std::log10(static_cast<double>(path.transmission()[cell]));
    EXPECT_NEAR(loss_db, 1.230 * miles, error_db);
  }
}

TEST(RainPath, WithoutRainUnderTheSpokeNothingIsThere) {
  Scene scene;
  const RadarModel model = model_of(6.0);
  RainPath path;
  path.lay(scene, model, aim_at(0.0));
  EXPECT_FALSE(path.any());
  scene.rain = {cloud(5000.0, 0.0, 2000.0, 16.0)};
  path.lay(scene, model, aim_at(90.0));
  EXPECT_TRUE(path.any());
  for (double off : {0.0, 180.0, 270.0, 113.6, 66.4}) {  // asin(2/5) = 23.58 deg
    path.lay(scene, model, aim_at(off));
    EXPECT_FALSE(path.any()) << off;
  }
  path.lay(scene, model, aim_at(113.5));
  EXPECT_TRUE(path.any());
  scene.rain[0].centre.east_m = 20000.0;  // beyond the range scale
  path.lay(scene, model, aim_at(90.0));
  EXPECT_FALSE(path.any());
  scene.rain[0] = cloud(5000.0, 0.0, 2000.0, 0.0);
  path.lay(scene, model, aim_at(90.0));
  EXPECT_FALSE(path.any());
}

TEST(RainPath, OnlyCellsInTheCloudAreWetAndAllBehindAreDimmed) {
  Scene scene;
  scene.rain = {cloud(0.0, 6000.0, 2000.0, 40.0)};
  const RadarModel model = model_of(6.0);
  RainPath path;
  // A spoke that was wet elsewhere before leaves nothing behind.
  Scene other;
  other.rain = {cloud(0.0, 1000.0, 900.0, 100.0), cloud(0.0, 10000.0, 900.0, 100.0)};
  path.lay(other, model, aim_at(0.0));
  path.lay(scene, model, aim_at(0.0));
  const auto first = static_cast<std::size_t>(4000.0 / model.cell_m);
  const auto last = static_cast<std::size_t>(8000.0 / model.cell_m);
  EXPECT_EQ(path.first_wet(), first);
  EXPECT_EQ(path.end_wet(), last + 1);
  for (std::size_t i = 0; i < 1024; ++i) {
    if (i < first) {
      EXPECT_EQ(path.transmission()[i], 1.0f);
    }
    if (i < first || i > last) {
      EXPECT_EQ(path.rate_mm_h()[i], 0.0f) << i;
    }
    if (i > last) {
      EXPECT_EQ(path.transmission()[i], path.transmission()[1023]);
    }
    if (i > 0) {
      EXPECT_LE(path.transmission()[i], path.transmission()[i - 1]);
    }
    EXPECT_GT(path.transmission()[i], 0.0f);
  }
  EXPECT_LT(path.transmission()[1023], 0.5f);
}

TEST(RainPath, CloudsDriftWithTime) {
  Scene scene;
  scene.rain = {cloud(0.0, 6000.0, 1000.0, 10.0)};
  scene.rain[0].velocity = {10.0, 0.0};
  const RadarModel model = model_of(6.0);
  RainPath path;
  SpokeAim aim = aim_at(0.0);
  path.lay(scene, model, aim);
  EXPECT_TRUE(path.any());
  aim.dt = 101.0;
  path.lay(scene, model, aim);
  EXPECT_FALSE(path.any());
  aim.own_ship = {1010.0, 0.0};
  path.lay(scene, model, aim);
  EXPECT_TRUE(path.any());
}

TEST(RainPath, ADelugeEndsInNoDenormals) {
  Scene scene;
  for (int i = 0; i < 8; ++i) scene.rain.push_back(cloud(0.0, 10000.0 * i, 30000.0, 200.0));
  for (double nm : {0.125, 96.0}) {
    const RadarModel model = model_of(nm, 4096);
    RainPath path;
    path.lay(scene, model, aim_at(0.0));
    for (float t : path.transmission()) {
      ASSERT_TRUE(std::isnormal(t));
      ASSERT_LE(t, 1.0f);
    }
  }
}

RainCell field(RainKind kind, double east, double north, double radius, double rate) {
  RainCell cell = cloud(east, north, radius, rate);
  cell.kind = kind;
  cell.velocity = {8.0, -4.0};
  cell.identity = static_cast<std::uint64_t>(radius);
  return cell;
}

// What dims the spoke is the integral of what echoes, and both are the reference's field: its rates
// summed in steps of a metre with libm.
TEST(RainPath, TakesAndEchoesOneField) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double rate_error = 0.0, worst_db = 0.0, own_db = 0.0, greatest_loss = 0.0;
  RainPath path;
  for (double nm : {3.0, 6.0, 24.0}) {
    const RadarModel model = model_of(nm);
    const RainLaw law = rain_law(model.set.frequency_hz, model.set.polarisation);
    const double reach = nm * 1852.0, beam = model.set.beam_width_deg * std::numbers::pi / 180.0;
    for (int trial = 0; trial < 12; ++trial) {
      Scene scene;
      scene.time += std::chrono::seconds(1000 * trial);
      for (int i = 0; i < 3; ++i) {
        scene.rain.push_back(field(kFractalRain[(trial + i) % 3], (unit(random) - 0.5) * reach,
                                   (unit(random) - 0.5) * reach,
                                   std::max(500.0, reach * (0.05 + 0.4 * unit(random))),
                                   std::pow(40.0, unit(random))));
      }
      SpokeAim aim = aim_at(360.0 * unit(random));
      aim.dt = 0.7;
      path.lay(scene, model, aim);
      if (!path.any()) continue;
      const double bearing = aim.plane_units * (2.0 * std::numbers::pi / 4294967296.0);
      double greatest = 0.0;
      std::vector<RainMapPtr> maps;
      for (RainCell& cell : scene.rain) {
        maps.push_back(
            rain_map_for(rain_map_key(cell, in_seconds(scene.time.time_since_epoch()) + aim.dt)));
        greatest += cell.rate_mm_h * maps.back()->greatest();
        cell.centre = cell.centre + cell.velocity * aim.dt;
      }
      const auto rate_at = [&](double range) {
        double sum = 0.0;
        for (std::size_t i = 0; i < maps.size(); ++i)
          sum += rain_rate_at(scene.rain[i], *maps[i], {}, bearing, beam, range);
        return sum;
      };
      double at = 0.0, truth = 0.0, own = 0.0;
      for (std::size_t i = 0; i < 1024; ++i) {
        const double range = (static_cast<double>(i) + 0.5) * model.cell_m;
        const auto echoes = static_cast<double>(path.rate_mm_h()[i]);
        rate_error = std::max(rate_error, std::fabs(echoes - rate_at(range)) / greatest);
        for (; at + 1.0 <= range; at += 1.0)
          truth += 2e-3 * law.k * std::pow(rate_at(at + 0.5), law.alpha);
        const double cell_db = 2e-3 * law.k * std::pow(echoes, law.alpha) * model.cell_m;
        const double made = -10.0 * std::log10(static_cast<double>(path.transmission()[i]));
        if (truth > 180.0) break;
        worst_db = std::max(worst_db, std::fabs(made - truth) - 0.03 * truth);
        own_db = std::max(own_db, std::fabs(made - own - 0.5 * cell_db) - 0.02 * made);
        own += cell_db;
        greatest_loss = std::max(greatest_loss, truth);
      }
    }
  }
  std::printf(
      "rain path, fractal: rate %.4f of the greatest, loss 3 %% and %.4f dB of the integral "
      "by metres, 2 %% and %.4f dB of that of the rates that echo; up to %.1f dB\n",
      rate_error, worst_db, own_db, greatest_loss);
  EXPECT_LT(rate_error, 0.04);
  EXPECT_LT(worst_db, 0.05);
  EXPECT_LT(own_db, 0.05);
  EXPECT_GT(greatest_loss, 10.0);
}

// Two seconds of drift are two seconds of the area's way: the same bits.  Within a step of the
// field a ship that drifts with the rain sees the same row.
TEST(RainPath, TheFieldDriftsWithItsArea) {
  const RadarModel model = model_of(6.0);
  for (const RainKind kind : kFractalRain) {
    Scene scene;
    scene.rain = {field(kind, 500.0, 5000.0, 4000.0, 16.0)};
    const auto row = [&](const SpokeAim& aim) {
      RainPath path;
      path.lay(scene, model, aim);
      return std::vector<float>(path.rate_mm_h().begin(), path.rate_mm_h().end());
    };
    while (rain_map_key(scene.rain[0], in_seconds(scene.time.time_since_epoch())) !=
           rain_map_key(scene.rain[0], in_seconds(scene.time.time_since_epoch()) + 2.0))
      scene.time += std::chrono::seconds(1);
    SpokeAim aim = aim_at(5.0);
    const std::vector<float> before = row(aim);
    aim.dt = 2.0;
    const std::vector<float> drifted = row(aim);
    EXPECT_NE(drifted, before);
    aim.own_ship = scene.rain[0].velocity * 2.0;
    EXPECT_EQ(row(aim), before);
    aim = aim_at(5.0);
    scene.rain[0].centre = scene.rain[0].centre + scene.rain[0].velocity * 2.0;
    scene.time += std::chrono::seconds(2);
    EXPECT_EQ(row(aim), drifted);
  }
}

TEST(RainPath, HasTheSameBitsOnEveryInstructionSet) {
  Scene scene;
  scene.rain = {cloud(900.0, 3000.0, 2000.0, 16.0), cloud(-500.0, 7000.0, 1500.0, 50.0),
                field(RainKind::cell, 0.0, 5000.0, 3000.0, 8.0)};
  const RadarModel model = model_of(6.0);
  std::vector<float> rates, ways;
  for (Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    force_isa(isa);
    RainPath path;
    path.lay(scene, model, aim_at(3.0));
    const std::vector<float> rate(path.rate_mm_h().begin(), path.rate_mm_h().end());
    const std::vector<float> way(path.transmission().begin(), path.transmission().end());
    if (rates.empty()) rates = rate, ways = way;
    EXPECT_EQ(rate, rates);
    EXPECT_EQ(way, ways);
  }
  force_isa(best_isa());
}

}  // namespace
}  // namespace skerry::echo
