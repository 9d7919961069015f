#include "echo/spoke_rain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace skerry::echo {
namespace {

RadarModel model_of(double nm) {
  return radar_model(RadarSet{}, ScanGeometry{}, *RangeScale::find(nm), SpokeClock(24.0, 4096), 0);
}

RainCell area(RainKind kind, PlanePoint centre, double radius_m, double rate_mm_h) {
  RainCell cell;
  cell.centre = centre;
  cell.velocity = {5.0, 3.0};
  cell.radius_m = radius_m;
  cell.rate_mm_h = rate_mm_h;
  cell.kind = kind;
  cell.identity = static_cast<std::uint64_t>(radius_m);
  return cell;
}

// Three areas of a kind, over a range scale.
Scene rain_of(RainKind kind, double nm, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double reach = nm * 1852.0;
  Scene scene;
  for (int i = 0; i < 3; ++i)
    scene.rain.push_back(
        area(kind, {(unit(random) - 0.5) * 1.4 * reach, (unit(random) - 0.5) * 1.4 * reach},
             std::max(500.0, reach * (0.05 + 0.4 * unit(random))), std::pow(40.0, unit(random))));
  return scene;
}

struct Beside {
  double worst = 0.0, sum2 = 0.0, worst_db = 0.0;
  std::size_t count = 0;
  double rms() const {
    return std::sqrt(sum2 / static_cast<double>(std::max<std::size_t>(1, count)));
  }
};

// Of all areas together.
double greatest_rate(const Scene& scene) {
  double sum = 0.0;
  for (const RainCell& cell : scene.rain) {
    const bool even = cell.kind == RainKind::even;
    sum += cell.rate_mm_h * (even ? 1.0 : rain_map_for(rain_map_key(cell, 0.0))->greatest());
  }
  return sum;
}

// What each spoke sees against what its group does: rates as shares of the greatest, and losses in
// dB beyond a tenth of themselves.
void compare(const Scene& scene, const RadarModel& model, Beside& beside) {
  const std::uint32_t together = rain_spokes(scene, model);
  const double greatest = greatest_rate(scene);
  RainPath own, group;
  for (std::uint64_t spoke = 5; spoke < 4096; spoke += 37) {
    own.lay(scene, model, aim_of(scene, model.clock, spoke));
    group.lay(scene, model, rain_aim(scene, model.clock, spoke, together));
    if (!own.any() || !group.any()) continue;
    const auto rates = own.rate_mm_h(), others = group.rate_mm_h();
    for (std::size_t i = 0; i < rates.size(); ++i) {
      if (rates[i] == 0.0f && others[i] == 0.0f) continue;
      const double off = std::fabs(static_cast<double>(rates[i] - others[i])) / greatest;
      beside.worst = std::max(beside.worst, off);
      beside.sum2 += off * off;
      ++beside.count;
      const double a = -10.0 * std::log10(static_cast<double>(own.transmission()[i]));
      const double b = -10.0 * std::log10(static_cast<double>(group.transmission()[i]));
      if (a < 100.0) beside.worst_db = std::max(beside.worst_db, std::fabs(a - b) - 0.1 * a);
    }
  }
}

TEST(SpokeRain, SpokesOfAGroupSeeWhatEachWouldSee) {
  for (const RainKind kind :
       {RainKind::even, RainKind::cell, RainKind::shower, RainKind::squall_line}) {
    Beside beside;
    for (const double nm : {1.5, 6.0, 24.0}) {
      const RadarModel model = model_of(nm);
      for (std::uint64_t seed = 1; seed <= 6; ++seed)
        compare(rain_of(kind, nm, seed), model, beside);
    }
    std::printf("kind %d: rate off by %.3f of the greatest, rms %.4f; loss 10 %% and %.3f dB\n",
                static_cast<int>(kind), beside.worst, beside.rms(), beside.worst_db);
    ASSERT_GT(beside.count, 50000u);
    EXPECT_LE(beside.worst, 0.1);
    EXPECT_LE(beside.rms(), 0.01);
    EXPECT_LE(beside.worst_db, 0.8);
  }
}

TEST(SpokeRain, SpokesShareAsFarAsTheBeamAndSmallAreasAllow) {
  const RadarModel model = model_of(6.0);
  Scene scene = rain_of(RainKind::cell, 6.0, 1);
  EXPECT_EQ(rain_spokes(scene, model), 4u);
  scene.rain.push_back(area(RainKind::even, {0.0, 10000.0}, 3000.0, 4.0));
  EXPECT_EQ(rain_spokes(scene, model), 4u);
  scene.rain.push_back(area(RainKind::even, {0.0, 10000.0}, 100.0, 4.0));
  EXPECT_EQ(rain_spokes(scene, model), 1u);
}

TEST(SpokeRain, IsTheSameHoweverSpokesAreDivided) {
  const RadarModel model = model_of(6.0);
  const Scene scene = rain_of(RainKind::cell, 6.0, 3);
  SpokeRain whole(model), parts(model);
  const auto aims_from = [&](std::uint64_t first, std::size_t count) {
    std::vector<SpokeAim> aims;
    for (std::size_t k = 0; k < count; ++k) aims.push_back(aim_of(scene, model.clock, first + k));
    return aims;
  };
  for (std::uint64_t first = 0; first < 4096; first += 64) {
    const std::vector<SpokeAim> all = aims_from(first, 64);
    whole.prepare(scene, all, false, serial_for);
    for (std::size_t k = 0; k < 64; k += 3) {
      parts.prepare(scene, aims_from(first + k, std::min<std::size_t>(3, 64 - k)), false,
                    serial_for);
      std::vector<float> a(1024, 1.0f), b(1024, 1.0f);
      whole.pass(7, all[k], a);
      parts.pass(7, all[k], b);
      ASSERT_EQ(a, b) << first + k;
      parts.release();
    }
    whole.release();
  }
}

TEST(SpokeRain, PassesNothingWithoutRainOrAfterItsRelease) {
  const RadarModel model = model_of(6.0);
  const Scene wet = rain_of(RainKind::cell, 6.0, 3);
  const std::vector<SpokeAim> aims(1, aim_of(wet, model.clock, 0));
  SpokeRain rain(model);
  rain.prepare(wet, aims, false, serial_for);
  rain.release();
  rain.prepare(Scene{}, aims, false, serial_for);
  std::vector<float> row(1024, 1.0f);
  rain.pass(7, aims[0], row);
  EXPECT_EQ(row, std::vector<float>(1024, 1.0f));
}

}  // namespace
}  // namespace skerry::echo
