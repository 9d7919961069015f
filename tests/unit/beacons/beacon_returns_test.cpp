#include "echo/beacons/beacon_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "echo/kernel/hash.hpp"
#include "tests/unit/beacons/beacon_scene.hpp"

namespace skerry::echo {
namespace {

using beacons::at;
using beacons::hear;
using beacons::hear_turn;
using beacons::model_at;
using beacons::Picture;
using beacons::propagation_of;

Scene crowded(std::size_t racons, std::size_t sarts, std::size_t emitters, double reach_m) {
  Scene scene;
  scene.own_velocity = {3.0, 5.0};
  scene.turn_rate_deg_s = 1.0;
  auto drawn = [n = std::uint64_t{0}]() mutable { return as_unit(mixed(0xC20D, ++n)); };
  const auto place = [&] { return at(360.0 * drawn(), reach_m * drawn()); };
  for (std::uint64_t i = 0; i < racons; ++i) {
    Racon racon;
    racon.place = place();
    racon.identity = i;
    racon.code = std::string(1, static_cast<char>('A' + i % 26));
    racon.side_lobe_suppression = i % 4 != 0;
    scene.racons.push_back(racon);
  }
  for (std::uint64_t i = 0; i < sarts; ++i) {
    Sart sart;
    sart.place = place();
    sart.identity = i;
    scene.sarts.push_back(sart);
  }
  for (std::uint64_t i = 0; i < emitters; ++i) {
    Emitter emitter;
    emitter.place = place();
    emitter.velocity = {4.0 * drawn(), -4.0 * drawn()};
    emitter.prf_hz = 600.0 + 2400.0 * drawn();
    emitter.frequency_hz = 9.38e9 + 60e6 * drawn();
    emitter.bearing_deg = 360.0 * drawn();
    emitter.identity = i;
    scene.emitters.push_back(emitter);
  }
  return scene;
}

TEST(BeaconReturns, DoNothingWhereThereIsNothing) {
  const RadarModel model = model_at(6.0);
  const Scene scene;
  BeaconReturns returns(model);
  const SpokeAim first = aim_of(scene, model.clock, 0), last = aim_of(scene, model.clock, 15);
  returns.prepare(scene, propagation_of(model, scene), first, last);
  EXPECT_FALSE(returns.any());
  // Not a cell is read or written.
  std::vector<float> row(model.geometry.cells, std::numeric_limits<float>::quiet_NaN());
  const std::vector<float> before = row;
  returns.add(first, row);
  EXPECT_EQ(std::memcmp(row.data(), before.data(), row.size() * sizeof(float)), 0);
}

TEST(BeaconReturns, ForgetTheSectorBefore) {
  const RadarModel model = model_at(6.0);
  Scene scene = crowded(0, 0, 20, 5000.0);
  BeaconReturns returns(model);
  const SpokeAim first = aim_of(scene, model.clock, 0), last = aim_of(scene, model.clock, 63);
  returns.prepare(scene, propagation_of(model, scene), first, last);
  EXPECT_TRUE(returns.any());
  scene.emitters.clear();
  returns.prepare(scene, propagation_of(model, scene), first, last);
  EXPECT_FALSE(returns.any());
}

TEST(BeaconReturns, AddToWhatIsThere) {
  const RadarModel model = model_at(6.0);
  const Scene scene = crowded(10, 3, 10, 8000.0);
  BeaconReturns returns(model);
  returns.prepare(scene, propagation_of(model, scene), aim_of(scene, model.clock, 0),
                  aim_of(scene, model.clock, 15));
  for (std::uint64_t spoke = 0; spoke < 16; ++spoke) {
    std::vector<float> empty(model.geometry.cells, 0.0f), full(model.geometry.cells, 2.0f);
    returns.add(aim_of(scene, model.clock, spoke), empty);
    returns.add(aim_of(scene, model.clock, spoke), full);
    for (std::size_t i = 0; i < empty.size(); ++i)
      ASSERT_NEAR(full[i], empty[i] + 2.0f, 1e-5f * full[i]);
  }
}

TEST(BeaconReturns, AreTheSameWhoeverAsksInWhateverOrder) {
  const RadarModel model = model_at(12.0);
  const Scene scene = crowded(40, 5, 40, 20e3);
  const Picture once = hear_turn(model, scene);
  EXPECT_EQ(hear_turn(model, scene).cells(), once.cells());

  BeaconReturns returns(model);
  const Propagation propagation = propagation_of(model, scene);
  for (std::uint64_t sector : {7ull, 3ull, 200ull, 3ull}) {  // turns back, and sectors twice
    const std::uint64_t first = 16 * sector;
    returns.prepare(scene, propagation, aim_of(scene, model.clock, first),
                    aim_of(scene, model.clock, first + 15));
    Picture again(model, 16);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (std::size_t k = t; k < 16; k += 4)
          returns.add(aim_of(scene, model.clock, first + 15 - k), again.row(15 - k));
      });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t k = 0; k < 16; ++k) {
      const std::span<const float> expected = once.row(first + k), got = again.row(k);
      ASSERT_TRUE(std::equal(expected.begin(), expected.end(), got.begin())) << first + k;
    }
  }
}

TEST(BeaconReturns, HardlyDependOnTheLengthOfSectors) {
  const RadarModel model = model_at(12.0);
  Scene scene = crowded(40, 5, 40, 20e3);
  for (Racon& racon : scene.racons) racon.on_s = racon.period_s;
  const Picture a = hear(model, scene, 0, 2048, {}, 16), b = hear(model, scene, 0, 2048, {}, 64);
  double sum = 0.0, difference = 0.0;
  for (std::size_t i = 0; i < a.cells().size(); ++i) {
    const double x = std::log1p(static_cast<double>(a.cells()[i]));
    const double y = std::log1p(static_cast<double>(b.cells()[i]));
    sum += x, difference += std::fabs(x - y);
  }
  EXPECT_LT(difference, 0.01 * sum);
}

void expect_sound(const Picture& picture) {
  for (const float p : picture.cells()) {
    ASSERT_TRUE(std::isfinite(p));
    ASSERT_GE(p, 0.0f);
    ASSERT_LT(p, 1e30f);
    ASSERT_TRUE(p == 0.0f || std::isnormal(p));
  }
}

TEST(BeaconReturns, StaySoundWithHundredsOfEverything) {
  const Scene scene = crowded(200, 200, 200, 40e3);
  for (const double scale : {0.125, 1.5, 12.0, 96.0})
    expect_sound(hear(model_at(scale), scene, 1000, 512, {}, 64));
}

TEST(BeaconReturns, StaySoundBesideTheAntenna) {
  Scene scene = crowded(3, 3, 3, 1e-3);
  scene.own_velocity = {}, scene.turn_rate_deg_s = 0.0;
  for (Emitter& emitter : scene.emitters) {
    emitter.place = {}, emitter.velocity = {};
    emitter.power_w = 1e6, emitter.antenna_gain_db = 50.0;
    emitter.frequency_hz = 9.41e9;
  }
  for (const double scale : {0.125, 96.0}) {
    const Picture picture = hear_turn(model_at(scale), scene);
    expect_sound(picture);
    EXPECT_GT(picture.most(), 1.0f);
  }
}

TEST(BeaconReturns, BoundTheirWorkHoweverManySend) {
  Scene scene = crowded(0, 0, 4000, 10e3);
  for (Emitter& emitter : scene.emitters) emitter.prf_hz = 20000.0;
  const RadarModel model = model_at(96.0);
  const Picture picture = hear(model, scene, 0, 64, {}, 64);
  std::size_t lit = 0;
  for (const float p : picture.cells()) lit += p > 0.0f;
  EXPECT_GT(lit, 1000u);
  // A dot covers three cells of this scale at most, so no more cells than that can be lit.
  EXPECT_LE(lit, 3 * Interference::kMostDots);
  expect_sound(picture);
}

TEST(BeaconReturns, TurnWithTheShipNotWithItsHeading) {
  // A racon stays at its bearing over ground while the ship points elsewhere.
  const RadarModel model = model_at(6.0);
  Scene scene;
  Racon racon;
  racon.place = at(90.0, 5000.0);
  racon.on_s = racon.period_s;
  scene.racons = {racon};
  scene.heading_deg = 45.0;
  const Picture picture = hear_turn(model, scene);
  std::size_t brightest = 0;
  float most = 0.0f;
  for (std::size_t s = 0; s < picture.spokes(); ++s)
    for (const float p : picture.row(s))
      if (p > most) most = p, brightest = s;
  EXPECT_NEAR(static_cast<double>(brightest) * 360.0 / 4096.0, 45.0, 0.1);
}

}  // namespace
}  // namespace skerry::echo
