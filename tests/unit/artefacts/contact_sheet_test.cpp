#include "tests/unit/artefacts/contact_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "protocol/picture/picture_file.hpp"
#include "tests/unit/artefacts/shown_scene.hpp"

// Every number here is read off the video that the contact sheet shows.

namespace skerry {
namespace {

using namespace scenes::places;

// How many of them are where they should be; all of them must be.
template <typename Expected>
int all_are(const std::vector<Difference>& differences, Expected&& expected) {
  int elsewhere = 0;
  for (const Difference& d : differences) {
    if (expected(d)) continue;
    if (++elsewhere <= 3)
      ADD_FAILURE() << d.gained << " steps at " << d.bearing_deg << " deg, " << d.metres << " m";
  }
  EXPECT_EQ(elsewhere, 0);
  return static_cast<int>(differences.size()) - elsewhere;
}

TEST(ArtefactScenes, SideLobesDrawAnArcAtTheShipsRange) {
  const auto differences = shown("side lobes").differences();
  const int count = all_are(differences, [](const Difference& d) {
    return std::fabs(d.metres - kSideLobeShip) < 60.0 &&
           std::fabs(off_bearing(d.bearing_deg, 90.0)) > 0.4;
  });
  EXPECT_GT(count, 100);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(std::any_of(differences.begin(), differences.end(), [&](const Difference& d) {
      return side * off_bearing(d.bearing_deg, 90.0) > 5.0;
    }));
  }
}

TEST(ArtefactScenes, MultipleEchoesStandAtMultiplesOfTheRange) {
  std::map<long, int> trips;
  all_are(shown("multiple echoes").differences(), [&](const Difference& d) {
    const long trip = std::lround(d.metres / kParallelShip);
    ++trips[trip];
    return d.gained > 0 && trip >= 2 && trip <= 4 &&
           std::fabs(d.metres - static_cast<double>(trip) * kParallelShip) <
               40.0 * static_cast<double>(trip) &&
           std::fabs(off_bearing(d.bearing_deg, 90.0)) < 12.0;
  });
  EXPECT_GT(trips[2], 20);
  EXPECT_GT(trips[3], 5);
}

TEST(ArtefactScenes, IndirectEchoesStandOnMastAndFunnelAtTheShipsRanges) {
  int on_mast = 0, on_funnel = 0;
  all_are(shown("indirect echoes").differences(), [&](const Difference& d) {
    const bool mast = std::fabs(off_bearing(d.bearing_deg, 175.0)) < 3.2 + 1.6;
    const bool funnel = std::fabs(off_bearing(d.bearing_deg, 200.0)) < 5.7 + 1.6;
    on_mast += mast ? 1 : 0;
    on_funnel += funnel ? 1 : 0;
    const bool range =
        std::fabs(d.metres - kMastTarget) < 160.0 || std::fabs(d.metres - 3300.0) < 200.0;
    return (mast || funnel) && range && d.gained > 0;
  });
  EXPECT_GT(on_funnel, 20);
  EXPECT_GT(on_mast, 5);
}

TEST(ArtefactScenes, MastFunnelAndBlankedSectorLoseWhatIsBehindThem) {
  const ShownScene& scene = shown("shadow and blind sectors");
  all_are(scene.differences(), [](const Difference& d) {
    return std::fabs(off_bearing(d.bearing_deg, 320.0)) <= 20.0 ||
           std::fabs(off_bearing(d.bearing_deg, 170.0)) < 45.0 ||
           std::fabs(off_bearing(d.bearing_deg, 200.0)) < 45.0;
  });
  const auto lost = [&](double bearing, double half) {
    return scene.mean(bearing, half, 150.0, 900.0, false) - scene.mean(bearing, half, 150.0, 900.0);
  };
  std::printf("video steps lost: mast %.1f, funnel %.1f, blanked %.1f, 90 deg %.1f\n",
              lost(170.0, 1.0), lost(200.0, 4.0), lost(320.0, 19.0), lost(90.0, 10.0));
  EXPECT_GT(lost(170.0, 1.0), 10.0);
  EXPECT_GT(lost(200.0, 4.0), lost(170.0, 1.0) + 10.0);
  EXPECT_LT(scene.mean(320.0, 19.0, 150.0, 900.0), 1.0);
  EXPECT_EQ(lost(90.0, 10.0), 0.0);
}

TEST(ArtefactScenes, AFarCoastFoldsIntoAHyperbola) {
  const double unambiguous = 299792458.0 / (2.0 * 3000.0);
  int near_the_middle = 0;
  const int count = all_are(shown("second trace").differences(), [&](const Difference& d) {
    const double bearing = d.bearing_deg * std::numbers::pi / 180.0;
    const double apparent = kFarCoastNm * 1852.0 / std::sin(bearing) - unambiguous;
    near_the_middle += std::fabs(d.bearing_deg - 90.0) < 2.0 ? 1 : 0;
    return d.gained > 0 && std::fabs(off_bearing(d.bearing_deg, 90.0)) < 18.0 &&
           std::fabs(d.metres - apparent) < 500.0;
  });
  EXPECT_GT(count, 100);
  EXPECT_GT(near_the_middle, 10);
}

// How many range cells hold nine tenths of the differences.
std::size_t cells_holding_most(const ShownScene& scene) {
  std::map<std::uint32_t, std::size_t> by_cell;
  const auto differences = scene.differences();
  for (const Difference& d : differences) ++by_cell[scene.cell_at(d.metres)];
  std::vector<std::size_t> counts;
  for (const auto& [cell, count] : by_cell) counts.push_back(count);
  std::sort(counts.begin(), counts.end(), std::greater<>());
  std::size_t cells = 0;
  for (std::size_t sum = 0; cells < counts.size() && sum < differences.size() * 9 / 10;)
    sum += counts[cells++];
  return cells;
}

TEST(ArtefactScenes, InterferenceSpiralsAndOfTheSamePrfMakesRings) {
  const ShownScene& spirals = shown("interference");
  const ShownScene& rings = shown("interference, same PRF");
  EXPECT_GT(spirals.differences().size(), 200u);
  EXPECT_GT(rings.differences().size(), 200u);
  const std::size_t spread = cells_holding_most(spirals), gathered = cells_holding_most(rings);
  std::printf("nine tenths of it lie in %zu range cells, of the same PRF in %zu\n", spread,
              gathered);
  EXPECT_GT(spread, 100u);
  EXPECT_LT(gathered, 40u);
}

TEST(ArtefactScenes, ACableEchoesOnceSquareToIt) {
  const int count = all_are(shown("overhead cable").differences(), [](const Difference& d) {
    return d.gained > 0 && std::fabs(d.metres - kCableEast) < 60.0 &&
           std::fabs(off_bearing(d.bearing_deg, 90.0)) < 5.0;
  });
  EXPECT_GT(count, 3);
}

TEST(ArtefactScenes, SaturationLosesTheBuoysBehindAStrongEcho) {
  const ShownScene& scene = shown("saturation");
  all_are(scene.differences(), [](const Difference& d) {
    return d.gained < 0 && d.metres > kStrongTarget &&
           std::fabs(off_bearing(d.bearing_deg, kStrongTargetDeg)) < 2.5;
  });
  int lost = 0;
  for (int i = 1; i <= 8; ++i) {
    const double at = kStrongTarget + 45.0 * i;
    lost += scene.peak(45.0, 0.6, at - 4.0, at + 12.0) + 20 <
                    scene.peak(135.0, 0.6, at - 4.0, at + 12.0)
                ? 1
                : 0;
  }
  EXPECT_GE(lost, 2);
}

TEST(ArtefactScenes, TheFirstMetresAreBlind) {
  const ShownScene& scene = shown("minimum range");
  const int count = all_are(scene.differences(), [](const Difference& d) {
    return d.gained < 0 && d.metres < 27.0 + 50.0;
  });
  EXPECT_GT(count, 1000);
  EXPECT_LT(scene.mean(0.0, 180.0, 1.0, 24.0), 1.0);
}

TEST(ArtefactScenes, RollLosesTheNearSeaAndSwaysTheBuoys) {
  const ShownScene& scene = shown("roll and pitch");
  // The antenna's height times the sine of the roll, at the time the antenna points abeam.
  const auto sway = [](double bearing_deg) {
    const double seconds = bearing_deg / 360.0 * 2.5;
    const double roll = 15.0 * std::sin(2.0 * std::numbers::pi * seconds / 8.0);
    return 30.0 * std::sin(roll * std::numbers::pi / 180.0) *
           std::sin(bearing_deg * std::numbers::pi / 180.0);
  };
  for (const double bearing : {90.0, 270.0}) {
    const auto edge = [&](bool with) {
      const std::uint32_t spoke = scene.spoke_at(bearing);
      std::uint32_t cell = scene.cell_at(kSwayBuoy - 40.0);
      while (scene.level(spoke, cell, with) < 250 && cell < 511) ++cell;
      return cell * scene.cell_m();
    };
    const double moved = edge(true) - edge(false);
    std::printf("buoy at %.0f: %.1f m nearer, the antenna swings %.1f m toward it\n", bearing,
                -moved, sway(bearing));
    EXPECT_NEAR(-moved, sway(bearing), 1.01 * scene.cell_m());
  }
  // At 270 the roll has port up: the beam overshoots.
  EXPECT_LT(scene.mean(270.0, 15.0, 60.0, 250.0),
            scene.mean(270.0, 15.0, 60.0, 250.0, false) - 10.0);
}

TEST(ArtefactScenes, ARaconAnswersInMorseBehindItsMark) {
  const double mark = kRaconNm * 1852.0, begins = mark + 0.5 * 299792458.0 * 0.7e-6;
  const double length = 0.5 * 299792458.0 * 25e-6;
  const ShownScene& scene = shown("racon");
  all_are(scene.differences(), [&](const Difference& d) {
    return d.gained > 0 && std::fabs(off_bearing(d.bearing_deg, 30.0)) < 4.0 &&
           d.metres > begins - 60.0 && d.metres < begins + length + 100.0;
  });
  // K, dash dot dash: three of the nine parts, one of them dark, on, dark, three of them on.
  const std::uint32_t spoke = scene.spoke_at(30.0);
  const auto lit = [&](double part) {
    return scene.level(spoke, scene.cell_at(begins + (part + 0.5) / 9.0 * length)) > 100;
  };
  std::string code;
  for (int part = 0; part < 9; ++part) code += lit(part) ? '#' : '.';
  EXPECT_EQ(code, "###.#.###");
}

TEST(ArtefactScenes, AFarSartShowsTwelveDots) {
  const ShownScene& scene = shown("SART, far");
  const std::uint32_t spoke = scene.spoke_at(70.0);
  std::vector<double> dots;
  bool before = false;
  for (std::uint32_t cell = 0; cell < scene.geometry().cells; ++cell) {
    const bool on = scene.level(spoke, cell) > scene.level(spoke, cell, false) + 20;
    if (on && !before) dots.push_back(cell * scene.cell_m() / 1852.0);
    before = on;
  }
  ASSERT_GE(dots.size(), 11u);
  EXPECT_LE(dots.size(), 13u);
  EXPECT_GT(dots.front(), kFarSartNm - 0.05);
  EXPECT_LT(dots.front(), kFarSartNm + 0.70);
  EXPECT_NEAR((dots.back() - dots.front()) / static_cast<double>(dots.size() - 1), 0.64, 0.03);
}

TEST(ArtefactScenes, ANearSartDrawsRings) {
  std::set<long> bearings;
  for (const Difference& d : shown("SART, near").differences())
    bearings.insert(std::lround(d.bearing_deg));
  std::printf("a near SART on %zu of 360 deg\n", bearings.size());
  EXPECT_GT(bearings.size(), 180u);
  std::set<long> far;
  for (const Difference& d : shown("SART, far").differences())
    far.insert(std::lround(d.bearing_deg));
  EXPECT_LT(far.size(), bearings.size() / 2);
}

TEST(ArtefactScenes, SeaIsBrighterUpwind) {
  const ShownScene& scene = shown("sea clutter");
  const double up = scene.mean(315.0, 25.0, 500.0, 1500.0);
  const double down = scene.mean(135.0, 25.0, 500.0, 1500.0);
  std::printf("mean video upwind %.1f, downwind %.1f\n", up, down);
  EXPECT_GT(up, down + 5.0);
  EXPECT_GT(down, scene.mean(135.0, 25.0, 500.0, 1500.0, false) + 20.0);
}

// How strongly the video waves along a bearing with that length, over its mean.
double waviness(const ShownScene& scene, double bearing_deg, double length_m, bool with) {
  double in_phase = 0.0, quadrature = 0.0, sum = 0.0;
  for (double off = -8.0; off <= 8.0; off += 0.36) {
    const std::uint32_t spoke = scene.spoke_at(bearing_deg + off);
    for (std::uint32_t i = scene.cell_at(250.0); i < scene.cell_at(250.0 + 5.0 * length_m); ++i) {
      const double along = (i + 0.5) * scene.cell_m() * std::cos(off * std::numbers::pi / 180.0);
      const double phase = 2.0 * std::numbers::pi * along / length_m;
      in_phase += scene.level(spoke, i, with) * std::cos(phase);
      quadrature += scene.level(spoke, i, with) * std::sin(phase);
      sum += scene.level(spoke, i, with);
    }
  }
  return std::hypot(in_phase, quadrature) / sum;
}

TEST(ArtefactScenes, SwellStripesTheSea) {
  const ShownScene& scene = shown("swell");
  const double length = 9.81 * 12.0 * 12.0 / (2.0 * std::numbers::pi);
  const double with = waviness(scene, 315.0, length, true);
  const double without = waviness(scene, 315.0, length, false);
  std::printf("the video waves with %.0f m by %.3f of its mean, without swell by %.3f\n", length,
              with, without);
  EXPECT_GT(with, 2.5 * without);
}

TEST(ArtefactScenes, RainEchoesInItsCellAndDimsWhatLiesBehind) {
  const double off = std::hypot(kRainEast, kRainNorth);
  const double middle = std::atan2(kRainEast, kRainNorth) * 180.0 / std::numbers::pi;
  const double half = std::asin(kRainRadius / off) * 180.0 / std::numbers::pi;
  int inside = 0;
  all_are(shown("rain cell").differences(), [&](const Difference& d) {
    const double bearing = d.bearing_deg * std::numbers::pi / 180.0;
    const double away = std::hypot(d.metres * std::sin(bearing) - kRainEast,
                                   d.metres * std::cos(bearing) - kRainNorth);
    inside += away < kRainRadius + 100.0 && d.gained > 0 ? 1 : 0;
    return std::fabs(off_bearing(d.bearing_deg, middle)) < half + 2.0 &&
           (away < kRainRadius + 100.0 || d.metres > off);
  });
  EXPECT_GT(inside, 2000);
  // At 3 GHz rain returns 20 dB less (SOURCES.md "Vectors"); the set makes good some of it.
  const auto level = [&](const std::string& name) {
    return shown(name).mean(middle, 0.5 * half, off - 1500.0, off + 1500.0);
  };
  std::printf("mean video in the rain %.1f, by the S band set %.1f\n", level("rain cell"),
              level("rain cell, S band"));
  EXPECT_LT(level("rain cell, S band"), level("rain cell") - 40.0);
}

TEST(ArtefactScenes, AShipHidesSeaAndBoatsBehindHer) {
  const ShownScene& scene = shown("shadow of a ship");
  const auto boat = [&](double bearing, bool with) {
    return scene.peak(bearing, 0.6, kShadowedBoat - 10.0, kShadowedBoat + 20.0, with);
  };
  EXPECT_LT(boat(90.0, true) + 40, boat(90.0, false));
  EXPECT_EQ(boat(82.0, true), boat(82.0, false));
  EXPECT_EQ(boat(98.0, true), boat(98.0, false));
  EXPECT_LT(scene.mean(90.0, 2.0, 900.0, 1400.0),
            scene.mean(90.0, 2.0, 900.0, 1400.0, false) - 1.0);
}

TEST(ArtefactScenes, AnIslandHidesTheShipBehindIt) {
  const ShownScene& scene = shown("ship behind an island");
  const auto ship = [&](double bearing, bool with) {
    return scene.peak(bearing, 0.7, kHiddenShip - 40.0, kHiddenShip + 40.0, with);
  };
  EXPECT_GT(ship(90.0, false), 200);
  EXPECT_LT(ship(90.0, true), 100);
  EXPECT_GT(ship(250.0, true), 200);
}

TEST(ArtefactScenes, EveryTurbineOfAWindFarmEchoes) {
  const ShownScene& scene = shown("wind farm");
  for (int i = 0; i < 20; ++i) {
    const double east = 1800.0 + 550.0 * (i % 5), north = -900.0 + 600.0 * (i / 5);
    const double range = std::hypot(east, north);
    if (range > 5400.0) continue;
    const double bearing = std::atan2(east, north) * 180.0 / std::numbers::pi;
    EXPECT_GT(scene.peak(bearing, 0.8, range - 60.0, range + 60.0), 150) << i;
  }
}

TEST(ArtefactScenes, AWakeLiesBehindTheShip) {
  const int count = all_are(shown("wake").differences(), [](const Difference& d) {
    const double bearing = d.bearing_deg * std::numbers::pi / 180.0;
    const double east = d.metres * std::sin(bearing), north = d.metres * std::cos(bearing);
    return std::fabs(east - 500.0) < 140.0 && north < 340.0;
  });
  EXPECT_GT(count, 50);
}

TEST(ContactSheet, ShowsEveryScene) {
  std::vector<Thumbnail> pictures;
  for (const auto& scene : scenes::artefact_scenes()) {
    const ShownScene& video = shown(scene.name);
    EXPECT_LE(scene.name.size(), 24u) << scene.name;
    EXPECT_LE(scene.caption.size(), 50u) << scene.name;
    EXPECT_FALSE(video.differences().empty()) << scene.name << " shows nothing of its own";
    pictures.push_back(
        {scene.name, scene.caption, last_turn(video.with(), video.geometry(), video.scale())});
  }
  const RgbaImage sheet =
      contact_sheet("Artefacts and what else echoes in a way of its own", pictures);
  EXPECT_EQ(sheet.width, 2 * 16 + kColumns * kPicture + (kColumns - 1) * 14);
  const std::string path = SKERRY_PICTURE_DIR "/artefacts.png";
  write_file(path, encode_png(sheet, {{"Title", "Skerry artefacts"}}));
  std::printf("contact sheet of %zu scenes: %s\n", pictures.size(), path.c_str());
}

}  // namespace
}  // namespace skerry
