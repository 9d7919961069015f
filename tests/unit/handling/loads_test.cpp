#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "server/world/handling/steering_gear.hpp"
#include "server/world/handling/wave_load.hpp"
#include "server/world/handling/wind_load.hpp"

namespace skerry::server {
namespace {

TEST(WindLoad, IsThatOfBlendermann) {
  // A research vessel; coefficients computed by another program from the same equations.
  const WindShape shape{WindType::research, 160.7, 434.8, 1.48, 5.1};
  struct Row {
    double off_bow_deg, cx, cy, ck, cn;
  };
  for (const Row& row : {Row{30, -.5747, .5128, .4631, .1105}, Row{60, -.3318, .8882, .8022, .1076},
                         Row{90, 0, .8500, .7677, .0229}, Row{120, .3876, .8778, .7928, -.0591},
                         Row{150, .6713, .5068, .4577, -.0819}}) {
    for (const double side : {1.0, -1.0}) {  // the wind from port, then from starboard
      const double angle = row.off_bow_deg * std::numbers::pi / 180.0;
      const double speed = 20.0, pressure = 0.5 * kAir_kg_m3 * speed * speed;
      const Loads loads =
          wind_load(shape, 55.0, -speed * std::cos(angle), side * speed * std::sin(angle));
      EXPECT_NEAR(loads.x / (pressure * 160.7), row.cx, 6e-5) << row.off_bow_deg;
      EXPECT_NEAR(loads.y / (pressure * 434.8), side * row.cy, 6e-5) << row.off_bow_deg;
      EXPECT_NEAR(loads.k / (pressure * 434.8 * (434.8 / 55.0)), side * row.ck, 6e-5);
      EXPECT_NEAR(loads.n / (pressure * 434.8 * 55.0), side * row.cn, 6e-5) << row.off_bow_deg;
    }
  }
  EXPECT_EQ(wind_load(shape, 55.0, 0.0, 0.0).x, 0.0);
}

TEST(WindLoad, InNewtons) {
  const WindShape shape{WindType::research, 160.7, 434.8, 1.48, 5.1};
  const double each = 20.0 * std::numbers::sqrt2 / 2.0;
  const Loads loads = wind_load(shape, 55.0, -each, each);
  EXPECT_NEAR(loads.x, -19824.0, 20.0);
  EXPECT_NEAR(loads.y, 82896.0, 80.0);
  EXPECT_NEAR(loads.n, 767235.0, 800.0);
}

TEST(SteeringGear, RunsAtItsRateAndSettles) {
  const SteeringGear plain{.rate_deg_s = 2.5};
  EXPECT_DOUBLE_EQ(rudder_after(plain, 0.0, 10.0, 2.0), 5.0);
  EXPECT_DOUBLE_EQ(rudder_after(plain, 0.0, 10.0, 5.0), 10.0);
  EXPECT_DOUBLE_EQ(rudder_after(plain, 10.0, -50.0, 1000.0), -35.0);
  const SteeringGear servo{.rate_deg_s = 5.0, .lag_s = 1.0};
  EXPECT_DOUBLE_EQ(rudder_after(servo, 0.0, 10.0, 1.0), 5.0);
  EXPECT_NEAR(rudder_after(servo, 0.0, 10.0, 2.0), 10.0 - 5.0 * std::exp(-1.0), 1e-12);
  EXPECT_NEAR(rudder_after(servo, 0.0, -10.0, 50.0), -10.0, 1e-12);
  // Two steps are one.
  double angle = 0.0;
  for (int i = 0; i < 40; ++i) angle = rudder_after(servo, angle, 20.0, 0.1);
  EXPECT_NEAR(angle, rudder_after(servo, 0.0, 20.0, 4.0), 1e-10);
}

TEST(WaveLoad, SlowsHerAndMakesHerYawAboutNothing) {
  const WaveShape shape{100.0, 16.0, 6.0, 0.7};
  EXPECT_EQ(wave_load(shape, 0.0, 1.0, 3.0, 1).n, 0.0);
  double sum = 0.0, most = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Loads loads = wave_load(shape, 3.0, 0.8, 0.1 * i, 1);
    EXPECT_LT(loads.x, 0.0);
    sum += loads.n;
    most = std::max(most, std::fabs(loads.n));
  }
  EXPECT_LT(std::fabs(sum / 20000), 0.01 * most);
  EXPECT_EQ(wave_load(shape, 3.0, std::numbers::pi, 0.0, 1).x, 0.0) << "following seas";
}

}  // namespace
}  // namespace skerry::server
