// Two own ships in one server: two radars, two pictures, one coast.
//
// A radar measures range to a cell and bearing to its beam, so "the same place on Earth" is held
// against one coast that both radars must lie on, made once, in another plane than either's, as
// places on Earth:
// - Range: on spokes on which that coast keeps its range over more than the beam's width, so that
//   the beam cannot draw it nearer, the first strong cell is where the coast is, to a cell and a
//   half.
// - Bearing: turned against the coast by some angle, the picture fits best at none: to a quarter of
//   the beam.
// The two radars' coasts are compared point by point, before any video.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "server/world/scenario.hpp"
#include "tests/scenes/charts.hpp"
#include "tests/system/one_coast.hpp"
#include "tests/system/receive.hpp"

namespace skerry::system_test {
namespace {

// Land fluctuates: where the first cell of a shore fades, its edge is seen a cell later.
constexpr double kFade = 1.5;         // cells
constexpr double kBeamDegrees = 1.2;  // which the default scenario leaves at its default

// The default scenario with a turn coarse and slow enough for a server with a sanitizer, and with
// nothing before the coast that is none: a calm sea, no false echoes, nobody else's pulses.
std::string slow_default_scenario() {
  std::string text = text_of_file(SKERRY_SOURCE_DIR "/server/world/scenarios/bergen.yaml");
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"spokes: 4096", "spokes: 1024"}, {"rpm: 24", "rpm: 12"}, {"state: 2", "state: 0"}};
  for (const auto& [from, to] : changes) {
    std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error("the default scenario has no " + from);
    for (; at != std::string::npos; at = text.find(from)) text.replace(at, from.size(), to);
  }
  return text + "artefacts: {side_lobes: false, multiple_echoes: false, interference: false}\n";
}

GeoPoint place_of(const scenario::OwnShip& ship) {
  return {ship.position().lat(), ship.position().lon()};
}

echo::CoastPicturePtr picture_at(GeoPoint own_ship, std::uint64_t seed, double range_m,
                                 double cell_m, double spoke_degrees) {
  auto chart = scenes::world_chart(own_ship, metres(1.25 * range_m + 10000.0));
  if (!chart) throw std::runtime_error("no chart is installed");
  return echo::CoastPreparer(std::move(*chart), own_ship, echo::CoastRules{.seed = seed})
      .prepare(own_ship, {range_m, cell_m, spoke_degrees});
}

double percentile(std::vector<double> values, double part) {
  if (values.empty()) return std::nan("");
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double between(GeoPoint a, GeoPoint b) {
  const PlanePoint p = echo::LocalPlane(a).to_plane(b);
  return std::hypot(p.east_m, p.north_m);
}

TEST(TwoOwnShips, MakeTheSameCoastOfTheChart) {
  const scenario::Scenario scenario = server::default_scenario();
  struct View {
    GeoPoint own_ship;
    double range_m, cell_m;
    CoastOnEarth coast;
  };
  std::vector<View> views;
  for (const scenario::OwnShip& ship : scenario.own_ships()) {
    const scenario::Radar& radar = ship.radars(0);
    const double range = nautical_miles(radar.controls().range_nm()).in_metres(),
                 cell = range / radar.cells();
    const auto picture =
        picture_at(place_of(ship), scenario.seed(), range, cell, 360.0 / radar.spokes());
    views.push_back({place_of(ship), range, cell, on_earth(*picture)});
  }
  ASSERT_EQ(views.size(), 2u);
  const View &one = views[0], &other = views[1];
  const double coarser_cell = std::max(one.cell_m, other.cell_m);
  const CoastSeenFrom seen_by_other(other.coast, other.own_ship, 100.0);
  std::vector<double> apart;
  for (const GeoPoint& vertex : one.coast.vertices) {
    if (between(one.own_ship, vertex) > one.range_m) continue;
    if (between(other.own_ship, vertex) > other.range_m) continue;
    apart.push_back(seen_by_other.distance(vertex));
  }
  ASSERT_GT(apart.size(), 1000u);
  const double worst = percentile(apart, 1.0);
  std::printf(
      "%zu points of the coast seen by both: %.3f m apart in the middle, %.2f m at most; "
      "a cell is %.1f m\n",
      apart.size(), percentile(apart, 0.5), worst, coarser_cell);
  EXPECT_LT(worst, coarser_cell);
}

// A turn of one radar beside the coast.
class TurnOnCoast {
 public:
  TurnOnCoast(const Scan& scan, const CoastOnEarth& coast) : scan_(scan) {
    const CoastSeenFrom seen(coast, header(0).own_ship, 200.0);
    shores_.resize(scan.spokes.size());
    for (std::size_t i = 0; i < scan.spokes.size(); ++i) {
      for (int step = -kReach; step <= kReach; ++step) {
        shores_[i].push_back(seen.first_shore(header(i).own_ship,
                                              header(i).bearing() + degrees(step * kStepDegrees)));
      }
    }
  }

  // Over the square spokes, by how much the video's first strong cell and the coast are apart.
  std::vector<double> range_errors() const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < scan_.spokes.size(); ++i) {
      const auto video = first_strong(i);
      if (video && is_square(i)) errors.push_back(*video - nearest_shore(i, 0, kHalfBeam));
    }
    return errors;
  }

  // The angle by which the picture must be turned to fit the coast best: to have it, nearest shore
  // in the beam for first strong cell, on most spokes, to two cells.
  double best_turn_degrees() const {
    std::vector<std::optional<double>> video;
    for (std::size_t i = 0; i < scan_.spokes.size(); ++i) video.push_back(first_strong(i));
    int best = 0, most = -1;
    for (int step = -kMostTurn; step <= kMostTurn; ++step) {
      int fits = 0;
      for (std::size_t i = 0; i < video.size(); ++i) {
        if (!video[i]) continue;
        if (std::fabs(nearest_shore(i, step, kHalfBeam) - *video[i]) < 2.0 * cell_m()) ++fits;
      }
      if (fits > most || (fits == most && std::abs(step) < std::abs(best))) {
        most = fits;
        best = step;
      }
    }
    return best * kStepDegrees;
  }

  double cell_m() const { return header(0).cell_size().in_metres(); }

 private:
  // Bearings beside a spoke's own, in steps.
  static constexpr int kHalfBeam = 3, kSquare = 4, kMostTurn = 12;
  static constexpr int kReach = kMostTurn + kHalfBeam;
  static constexpr double kStepDegrees = 0.5 * kBeamDegrees / kHalfBeam;

  const SpokeHeader& header(std::size_t spoke) const { return scan_.spokes[spoke]->header; }

  // The middle of the first of two strong cells: receiver noise is alone.
  std::optional<double> first_strong(std::size_t spoke) const {
    constexpr std::uint8_t kStrong = 110;
    const auto& cells = scan_.spokes[spoke]->cells;
    for (std::size_t n = 4; n + 1 < cells.size(); ++n) {
      if (cells[n] >= kStrong && cells[n + 1] >= kStrong) {
        return (static_cast<double>(n) + 0.5) * cell_m();
      }
    }
    return std::nullopt;
  }

  // Within so many steps of the spoke turned by `turn` steps.
  double nearest_shore(std::size_t spoke, int turn, int steps) const {
    const auto middle = shores_[spoke].begin() + kReach + turn;
    return *std::min_element(middle - steps, middle + steps + 1);
  }

  // Whether the coast keeps its range to a cell over four thirds of the beam.
  bool is_square(std::size_t spoke) const {
    const auto middle = shores_[spoke].begin() + kReach;
    const auto [nearest, farthest] = std::minmax_element(middle - kSquare, middle + kSquare + 1);
    return *farthest < header(spoke).range_scale.length().in_metres() &&
           *farthest - *nearest <= cell_m();
  }

  const Scan& scan_;
  std::vector<std::vector<double>> shores_;  // by spoke and step, metres
};

TEST(TwoOwnShips, HaveTwoPicturesOfOneCoast) {
  const TempFolder folder;
  const std::string text = slow_default_scenario();
  const scenario::Scenario scenario = server::parse_scenario(text, "bergen.yaml");
  const RunningServer server({"--scenario", folder.write("bergen.yaml", text)});
  std::vector<Scan> scans;
  for (int radar = 0; radar < 2; ++radar) {
    client::SpokeClient console = subscribed(server, static_cast<std::uint32_t>(radar));
    scans.push_back(next_scan(console));
    EXPECT_LT(between(scans.back().spokes[0]->header.own_ship, place_of(scenario.own_ships(radar))),
              500.0);
  }
  std::size_t different = 0;
  for (std::size_t i = 0; i < scans[0].spokes.size(); ++i) {
    if (scans[0].spokes[i]->cells != scans[1].spokes[i]->cells) ++different;
  }
  EXPECT_GT(different, scans[0].spokes.size() * 9 / 10);

  const auto& far = scans[1].spokes[0]->header;
  const double reach = far.range_scale.length().in_metres() +
                       between(scans[0].spokes[0]->header.own_ship, far.own_ship);
  // All that either radar can see, finer than it can tell.
  const CoastOnEarth coast =
      on_earth(*picture_at(far.own_ship, scenario.seed(), reach, 10.0, 0.05));
  for (const Scan& scan : scans) {
    const TurnOnCoast turn(scan, coast);
    std::vector<double> errors = turn.range_errors();
    for (double& error : errors) error = std::fabs(error);
    const double p90 = percentile(errors, 0.9);
    const double best = turn.best_turn_degrees();
    std::printf(
        "radar %u: %zu square spokes, edges %.1f m off in the middle, p90 %.1f m, cell "
        "%.1f m; best turned by %.3f deg\n",
        scan.radar, errors.size(), percentile(errors, 0.5), p90, turn.cell_m(), best);
    EXPECT_GE(errors.size(), 10u);
    EXPECT_LE(p90, kFade * turn.cell_m());
    EXPECT_LE(std::fabs(best), 0.25 * kBeamDegrees);
  }
}

}  // namespace
}  // namespace skerry::system_test
