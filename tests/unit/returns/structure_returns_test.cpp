// Structures against brute force: a wall as points a centimetre or so apart, each shared between
// the rays beside it.
#include "echo/returns/structure_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kRays = 4096;
constexpr double kTurn = 4294967296.0;
constexpr double kRayArc = 2.0 * std::numbers::pi / kRays;

StructureModel structure_model(double cell_m) {
  return {cell_m, 20.0, 1e12, 0xFFFFFFFFu / kRays + 1};
}

std::shared_ptr<const Structures> structures_of(std::vector<Wall> walls,
                                                std::vector<PointObject> points = {}) {
  return std::make_shared<const Structures>(Structures{std::move(walls), std::move(points)});
}

// Power of all rays of a turn, cell by cell; rays that nothing was added to are empty.
struct Fan {
  std::vector<std::vector<float>> rays;
  double sum_of_cross_sections(double cell_m, double unit) const {
    double sum = 0.0;
    for (const auto& ray : rays) {
      for (std::size_t i = 0; i < ray.size(); ++i)
        sum += static_cast<double>(ray[i]) * std::pow((static_cast<double>(i) + 0.5) * cell_m, 4) /
               unit;
    }
    return sum;
  }
};

Fan fan_of(const Structures& structures, const StructureModel& model, PlanePoint own_ship = {},
           std::uint32_t turned = 0, std::size_t cells = 1024,
           const GroundProfile* ground = nullptr) {
  const StructureIndex index(std::make_shared<const Structures>(structures), {10, -10}, 50.0);
  Fan fan{std::vector<std::vector<float>>(kRays)};
  NearStructures near;
  for (std::uint32_t k = 0; k < kRays; ++k) {
    const Ray ray{own_ship, k * model.ray_units + turned};
    find_structures(index, ray, model, near);
    std::vector<float> power(cells, 0.0f);
    if (add_structures(index, near, ray, model, ground, power)) fan.rays[k] = power;
  }
  return fan;
}

// The same by points along the walls.
std::vector<std::vector<double>> brute_force(const std::vector<Wall>& walls,
                                             const StructureModel& model, PlanePoint own_ship,
                                             std::size_t cells) {
  std::vector<std::vector<double>> rays(kRays, std::vector<double>(cells, 0.0));
  for (const Wall& wall : walls) {
    const double de = wall.to.east_m - wall.from.east_m, dn = wall.to.north_m - wall.from.north_m;
    const double length = std::hypot(de, dn);
    const auto n = static_cast<int>(length / 0.01) + 1;
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) / n;
      const double e = wall.from.east_m + t * de - own_ship.east_m;
      const double m = wall.from.north_m + t * dn - own_ship.north_m;
      const double range = std::hypot(e, m);
      const auto cell = static_cast<std::size_t>(range / model.cell_m);
      if (cell >= cells) continue;
      const double hidden = hidden_height(range, model.antenna_height_m);
      const double height =
          static_cast<double>(wall.top_m) - std::max(static_cast<double>(wall.base_m), hidden);
      if (height <= 0.0) continue;
      const double across = std::fabs(e * dn - m * de) / range / n;
      const double along = std::fabs(e * de + m * dn) / range / n;
      const double sigma = wall_gamma(wall.kind) * height * (across + kAlongTheLine * along);
      const double at = std::fmod(std::atan2(e, m) / kRayArc + kRays, kRays);
      const auto left = static_cast<std::size_t>(at);
      const double to_right = at - std::floor(at);
      const double power = model.unit_signal_to_noise * sigma / std::pow(range, 4);
      rays[left % kRays][cell] += power * (1.0 - to_right);
      rays[(left + 1) % kRays][cell] += power * to_right;
    }
  }
  return rays;
}

TEST(StructureReturns, AWallIsWhatBruteForceMakesOfIt) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Wall> walls;
  for (int i = 0; i < 60; ++i) {
    const PlanePoint from{3000.0 * unit(random), 3000.0 * unit(random)};
    const double size = i % 3 ? 60.0 : 900.0;
    const PlanePoint to{from.east_m + size * unit(random), from.north_m + size * unit(random)};
    // Not closer than 200 m: there a part between two rays covers cells unevenly.
    bool far = true;
    for (double t = 0.0; t <= 1.0; t += 0.01)
      far = far && std::hypot(from.east_m + t * (to.east_m - from.east_m),
                              from.north_m + t * (to.north_m - from.north_m)) > 200.0;
    if (!far) continue;
    const auto base = i % 4 ? 0.0f : 18.0f;
    walls.push_back({from, to, base, base + 3.0f + static_cast<float>(i % 5),
                     i % 4 ? ObjectClass::pier : ObjectClass::bridge});
  }
  // One that points at the own ship, and two nearly.
  walls.push_back({{700, 700}, {900, 900}, 0.0f, 4.0f, ObjectClass::breakwater});
  walls.push_back({{-700, 700}, {-900, 900.5}, 0.0f, 4.0f, ObjectClass::pontoon});
  walls.push_back({{0.2, 1500}, {-0.3, 1300}, 0.0f, 4.0f, ObjectClass::building});
  ASSERT_GT(walls.size(), 40u);

  const StructureModel model = structure_model(6.0);
  double worst_cell = 0.0, total = 0.0, off = 0.0;
  for (const PlanePoint own_ship : {PlanePoint{0, 0}, PlanePoint{31, 17}}) {
    const auto reference = brute_force(walls, model, own_ship, 1024);
    const Fan fan = fan_of(*structures_of(walls), model, own_ship);
    for (std::uint32_t k = 0; k < kRays; ++k) {
      const double peak = *std::max_element(reference[k].begin(), reference[k].end());
      for (std::size_t i = 0; i < 1024; ++i) {
        const double made = fan.rays[k].empty() ? 0.0 : static_cast<double>(fan.rays[k][i]);
        const double range = (static_cast<double>(i) + 0.5) * 6.0;
        const double weight = std::pow(range, 4);
        total += reference[k][i] * weight;
        off += std::fabs(made - reference[k][i]) * weight;
        worst_cell = std::max(worst_cell, std::fabs(made - reference[k][i]) / (peak + 1e-30));
      }
      EXPECT_EQ(peak > 0.0, !fan.rays[k].empty()) << "ray " << k;
    }
  }
  std::printf(
      "walls: %.3f %% of what they return stands in another cell or ray than by brute "
      "force\n",
      50.0 * off / total);
  EXPECT_LT(off / total, 0.02);
}

// 100 m of pier, square to the ray at 2 km: gamma h R dtheta on each ray, by the radar equation.
TEST(StructureReturns, AWallSquareToTheRayIsThatOfTheRadarEquation) {
  const StructureModel model = structure_model(10.0);
  const Fan fan =
      fan_of(*structures_of({{{-50, 2005}, {50, 2005}, 0.0f, 5.0f, ObjectClass::pier}}), model);
  const double sigma = 0.501 * 5.0 * 2005.0 * kRayArc;
  EXPECT_NEAR(static_cast<double>(fan.rays[0][200]) / (1e12 * sigma / std::pow(2005.0, 4)), 1.0,
              1e-3);
  EXPECT_NEAR(fan.sum_of_cross_sections(10.0, 1e12), 0.501 * 5.0 * 100.0, 0.5);
}

// Exactly end on, whatever ray it falls on and however the bow turns: it returns its share of its
// length, over all cells it covers, and never vanishes.
TEST(StructureReturns, AWallSeenEndOnNeverVanishes) {
  const StructureModel model = structure_model(10.0);
  const double sigma = 0.501 * 4.0 * kAlongTheLine * 200.0;
  for (const PlanePoint to : {PlanePoint{0, 1}, PlanePoint{0.6, 0.8}, PlanePoint{-0.8, 0.6},
                              PlanePoint{0, -1}, PlanePoint{-1, 0}}) {
    const Wall pier{to * 1000.0, to * 1200.0, 0.0f, 4.0f, ObjectClass::pier};
    for (const std::uint32_t turned : {0u, 1u, 99999u, 524288u, 1048575u}) {
      const Fan fan = fan_of(*structures_of({pier}), model, {}, turned);
      double sum = 0.0;
      for (const auto& ray : fan.rays) {
        for (std::size_t i = 0; i < ray.size(); ++i) {
          sum += static_cast<double>(ray[i]) * std::pow((static_cast<double>(i) + 0.5) * 10.0, 4) /
                 1e12;
          if (i < 100 || i >= 121) {
            EXPECT_EQ(ray[i], 0.0f);
          }
        }
      }
      EXPECT_NEAR(sum / sigma, 1.0, 0.01) << to.east_m << ", turned " << turned;
    }
  }
}

TEST(StructureReturns, ABridgeSinksByItsDeckAndAPierByItsFoot) {
  const StructureModel model = structure_model(100.0);
  const double range = 30000.0;  // the Earth hides 7.9 m
  const double hidden = hidden_height(range, 20.0);
  const auto sigma = [&](Wall wall) {
    wall.from = {-50, range}, wall.to = {50, range};
    return fan_of(*structures_of({wall}), model).sum_of_cross_sections(100.0, 1e12) *
           std::pow(range / (300.5 * 100.0), 4) / 100.0;
  };
  EXPECT_NEAR(hidden, 7.88, 0.1);
  EXPECT_NEAR(sigma({{}, {}, 20.0f, 25.0f, ObjectClass::bridge}), 5.0, 0.05);
  EXPECT_NEAR(sigma({{}, {}, 5.0f, 25.0f, ObjectClass::bridge}), 25.0 - hidden, 0.05);
  EXPECT_NEAR(sigma({{}, {}, 20.0f, 20.0f, ObjectClass::bridge}), kDeckDepth, 0.05);
  EXPECT_EQ(sigma({{}, {}, 0.0f, 5.0f, ObjectClass::pier}), 0.0);
}

TEST(StructureReturns, APointStandsAtItsRangeAndBearingWithItsCrossSection) {
  const StructureModel model = structure_model(10.0);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double bearing = 2.0 * std::numbers::pi * unit(random), range = 60 + 9000 * unit(random);
    const PointObject buoy{
        {range * std::sin(bearing), range * std::cos(bearing)}, 4.0f, 7.5f, ObjectClass::buoy, 1};
    const Fan fan = fan_of(*structures_of({}, {buoy}), model);
    double sum = 0.0, middle = 0.0;
    int rays = 0;
    for (std::uint32_t k = 0; k < kRays; ++k) {
      if (fan.rays[k].empty()) continue;
      ++rays;
      const auto cell = static_cast<std::size_t>(range / 10.0);
      for (std::size_t c = 0; c < fan.rays[k].size(); ++c) {
        if (c != cell) {
          ASSERT_EQ(fan.rays[k][c], 0.0f);
        }
      }
      const double power = static_cast<double>(fan.rays[k][cell]);
      sum += power;
      middle += power * std::remainder(k * kRayArc - bearing, 2.0 * std::numbers::pi);
    }
    EXPECT_LE(rays, 2);
    EXPECT_NEAR(sum / (1e12 * 7.5 / std::pow(range, 4)), 1.0, 1e-5);
    EXPECT_NEAR(middle / sum, 0.0, 0.01 * kRayArc);
  }
}

TEST(StructureReturns, APointSinksBelowTheHorizon) {
  const StructureModel model = structure_model(100.0);
  const auto level = [&](double range) {
    const PointObject mast{{0, range}, 30.0f, 10.0f, ObjectClass::landmark, 1};
    const Fan fan = fan_of(*structures_of({}, {mast}), model);
    return fan.sum_of_cross_sections(100.0, 1e12) / 10.0 /
           std::pow((std::floor(range / 100.0) + 0.5) * 100.0 / range, 4);
  };
  EXPECT_NEAR(level(10000.0), 1.0, 1e-5);
  EXPECT_NEAR(level(35000.0), 1.0 - hidden_height(35000.0, 20.0) / 30.0, 1e-5);
  EXPECT_EQ(level(radar_horizon(20.0, 30.0) + 1000.0), 0.0);
}

// Land 30 m high before it hides a beacon and the lower part of a tower; a building on the land
// stands out of it.
TEST(StructureReturns, LandHidesWhatStandsBehindIt) {
  const StructureModel model = structure_model(10.0);
  GroundProfile ground;
  ground.clear(1024);
  const double slope = (30.0 - 20.0 - 1000.0 * 1000.0 / (2.0 * kEffectiveEarth)) / 1005.0;
  for (std::size_t i = 101; i < 1024; ++i) ground.shadow[i] = static_cast<float>(slope);
  for (std::size_t i = 150; i < 200; ++i) ground.height_m[i] = 34.0f;
  const auto sigma = [&](double range, float top, ObjectClass kind) {
    const Wall wall{{-20, range}, {20, range}, 0.0f, top, kind};
    return fan_of(*structures_of({wall}), model, {}, 0, 1024, &ground)
               .sum_of_cross_sections(10.0, 1e12) /
           (40.0 * wall_gamma(kind)) * std::pow(range / (std::floor(range / 10.0) * 10.0 + 5.0), 4);
  };
  const double hides = 20.0 + 3000.0 * 3000.0 / (2.0 * kEffectiveEarth) + slope * 3000.0;
  EXPECT_NEAR(hides, 50.2, 0.3);
  EXPECT_NEAR(sigma(3000.0, 4.0f, ObjectClass::pier), 0.0, 1e-9);
  EXPECT_NEAR(sigma(3000.0, 60.0f, ObjectClass::pier), 60.0 - hides, 0.2);
  EXPECT_NEAR(sigma(995.0, 4.0f, ObjectClass::pier), 4.0, 0.05);  // before the hill
  // In the first cell the hill hides, a quay's wall still stands before it.
  EXPECT_NEAR(sigma(1015.0, 4.0f, ObjectClass::pier), 4.0, 0.05);
  EXPECT_NEAR(sigma(1025.0, 4.0f, ObjectClass::pier), 0.0, 1e-9);
  // On the ground of 34 m at 1.7 km, of which nearer land hides all but what stands over 36.9 m.
  EXPECT_NEAR(sigma(1700.0, 6.0f, ObjectClass::building), 42.0 - 37.0, 0.3);
  EXPECT_NEAR(sigma(1700.0, 80.0f, ObjectClass::building), 80.0 - 37.0, 0.3);

  const PointObject hidden{{0, 3000}, 20.0f, 10.0f, ObjectClass::beacon, 1};
  const Fan fan = fan_of(*structures_of({}, {hidden}), model, {}, 0, 1024, &ground);
  EXPECT_EQ(fan.sum_of_cross_sections(10.0, 1.0), 0.0);
}

TEST(StructureReturns, SurvivesWhatAChartMayHold) {
  const StructureModel model = structure_model(10.0);
  const Structures odd{{{{0, 0}, {0, 0}, 0.0f, 5.0f, ObjectClass::pier},
                        {{-100, 0}, {100, 0}, 0.0f, 5.0f, ObjectClass::pier},
                        {{-1e7, 5}, {1e7, 5}, 0.0f, 5.0f, ObjectClass::pier},
                        {{300, 300}, {300, 300}, 5.0f, 5.0f, ObjectClass::pier},
                        {{1e6, 1e6}, {2e6, 2e6}, 0.0f, 5e3f, ObjectClass::bridge}},
                       {{{0, 0}, 0.0f, 1.0f, ObjectClass::buoy, 1},
                        {{0, 1e-9}, 1.0f, 1.0f, ObjectClass::buoy, 1},
                        {{500, 0}, 0.0f, 1.0f, ObjectClass::rock, 1},
                        {{1e8, 0}, 1e5f, 1e9f, ObjectClass::racon, 1}}};
  for (const PlanePoint own_ship : {PlanePoint{0, 0}, PlanePoint{50, 0}, PlanePoint{-100, 0}}) {
    const Fan fan = fan_of(odd, model, own_ship);
    for (const auto& ray : fan.rays) {
      for (const float p : ray) {
        ASSERT_TRUE(std::isfinite(p));
        ASSERT_GE(p, 0.0f);
      }
    }
  }
}

// Whatever echoes on a ray is among what the index offers, wherever she is within its slack.
TEST(StructureIndex, OffersAllThatEchoes) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Wall> walls;
  std::vector<PointObject> points;
  for (int i = 0; i < 400; ++i) {
    const double reach = std::pow(10.0, 2.5 + unit(random));
    const PlanePoint at{reach * unit(random), reach * unit(random)};
    walls.push_back({at,
                     {at.east_m + reach * unit(random), at.north_m + reach * unit(random)},
                     0.0f,
                     5.0f,
                     ObjectClass::pier});
    points.push_back({{at.north_m, -at.east_m}, 5.0f, 1.0f, ObjectClass::buoy, 0});
  }
  const auto all = structures_of(walls, points);
  const StructureIndex index(all, {0, 0}, 40.0);
  NearStructures everything, near;
  for (std::uint32_t i = 0; i < 400; ++i) {
    everything.walls.push_back(i);
    everything.points.push_back(i);
  }
  std::size_t offered = 0, rays = 0;
  for (const std::uint32_t turn : {256u, 4096u, 8192u}) {
    StructureModel model = structure_model(5.0);
    model.ray_units = static_cast<std::uint32_t>(kTurn / turn);
    for (const PlanePoint own_ship : {PlanePoint{0, 0}, PlanePoint{28, 28}, PlanePoint{-40, 0}}) {
      EXPECT_TRUE(index.serves(own_ship));
      for (std::uint32_t k = 0; k < turn; k += 3, ++rays) {
        const Ray ray{own_ship, k * model.ray_units + 12345u};
        std::vector<float> by_index(2000, 0.0f), by_all(2000, 0.0f);
        find_structures(index, ray, model, near);
        offered += near.walls.size() + near.points.size();
        add_structures(index, near, ray, model, nullptr, by_index);
        add_structures(index, everything, ray, model, nullptr, by_all);
        ASSERT_EQ(by_index, by_all) << "ray " << k << " of " << turn;
      }
    }
  }
  std::printf("structure index: %.1f of 800 offered to a ray\n",
              static_cast<double>(offered) / static_cast<double>(rays));
  EXPECT_FALSE(index.serves({41, 0}));
}

}  // namespace
}  // namespace skerry::echo
