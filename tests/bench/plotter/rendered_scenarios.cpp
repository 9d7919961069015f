// The four scenarios of A.823(19) on rendered video: what extraction adds to
// standard_scenarios_bench.
//
// By the echo and the receiver come: how the hull of 200 m fades and glints, beam, pulse, the
// spokes' and cells' quantisation, noise.  Told wrongly by the spokes, as by A.823: the gyro's and
// the log's errors, roll and pitch, backlash and encoder.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "echo/chart/local_plane.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/exercise_tool/radar_turns.hpp"
#include "server/plotter/plotter.hpp"
#include "tests/unit/plotter/standard_scenarios.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;

constexpr double kPi = 3.14159265358979323846;
constexpr GeoPoint kBegin{56.3, 4.2};  // the open North Sea
constexpr double kRoll_s = 12.0;

PlanePoint way(double course_deg, double speed_kn) {
  const double a = course_deg / kDegreesPerRadian, v = speed_kn * 1852.0 / 3600.0;
  return {v * std::sin(a), v * std::cos(a)};
}

std::string scenario_text(const StandardScenario& scenario, double seconds, std::uint64_t seed) {
  const PlanePoint own = way(0.0, scenario.own_speed_kn);
  const PlanePoint target = way(scenario.true_course_deg, scenario.true_speed_kn);
  const PlanePoint off =
      way(scenario.bearing_deg, scenario.range_nm * 3600.0) - (target - own) * seconds;
  const GeoPoint place = echo::LocalPlane(kBegin).to_geo(off);
  return fmt::format(
      "name: standard\nseed: {}\nsea: {{state: 0}}\nown_ships:\n  - {{name: Own, position: "
      "{{lat: {:.8f}, lon: {:.8f}}}, course_deg: 0, speed_kn: {:.3f}, radars: [{{range_nm: {}, "
      "spokes: 2048, cells: 1024}}]}}\ntargets:\n  - {{name: Target, position: {{lat: {:.8f}, "
      "lon: {:.8f}}}, course_deg: {:.4f}, speed_kn: {:.4f}, length_m: 200, beam_m: 30, height_m: "
      "25}}\n",
      seed, kBegin.latitude_deg, kBegin.longitude_deg, scenario.own_speed_kn,
      scenario.range_nm > 3.0 ? 12 : 3, place.latitude_deg, place.longitude_deg,
      scenario.true_course_deg, scenario.true_speed_kn);
}

// What the spokes of a turn tell wrongly.
class SensorFaults {
 public:
  SensorFaults(const StandardScenario& scenario, std::uint64_t seed)
      : scenario_(scenario), state_(seed * 977 + 5) {
    constant_deg_ = next_share(state_) < 0.5 ? 0.5 : -0.5;
    constant_kn_ = next_share(state_) < 0.5 ? 0.5 : -0.5;
    phase_ = 2.0 * kPi * next_share(state_);
  }
  void put_into(SpokeHeader& header) {
    const double t = in_seconds(header.scenario_time.time_since_epoch());
    if (t >= next_s_) {
      next_s_ = t + 0.2;
      gyro_deg_ = constant_deg_ + 0.12 * next_draw(state_);
      log_kn_ = constant_kn_ + 0.2 / 3.0 * next_draw(state_);
    }
    if (header.index == 0) {
      antenna_deg_ = 0.05 * (2.0 * next_share(state_) - 1.0) + 0.03 * next_draw(state_);
    }
    place_ = place_ + way(gyro_deg_, scenario_.own_speed_kn + log_kn_) * (t - before_s_);
    before_s_ = t;
    // None ahead and abeam, most at 045.
    const double roll = 0.22 + 0.22 * std::sin(4.0 * kPi * t / kRoll_s + phase_);
    const double off_deg =
        gyro_deg_ + antenna_deg_ + roll * std::sin(2.0 * header.antenna().in_radians());
    header.heading = TrueBearing::from(degrees(header.heading.in_degrees() + off_deg));
    header.own_ship = earth_.to_geo(place_);
  }

 private:
  const StandardScenario scenario_;
  const echo::LocalPlane earth_{kBegin};
  std::uint64_t state_;
  double constant_deg_ = 0.0, constant_kn_ = 0.0, phase_ = 0.0;
  double gyro_deg_ = 0.0, log_kn_ = 0.0, antenna_deg_ = 0.0;
  double next_s_ = 0.0, before_s_ = 0.0;
  PlanePoint place_;
};

std::vector<double> rendered_run(const StandardScenario& scenario, double minutes,
                                 std::uint64_t seed, const echo::ChartSource& chart) {
  const double seconds = 60.0 * minutes;
  const ExercisePlan plan = exercise_plan(scenario_text(scenario, seconds, seed), "standard");
  World world(plan.scenario);
  RadarTurns turns(plan, 0, std::nullopt, chart, world);
  Plotter::Rule rule;
  rule.tracks.acquire = Tracker::Acquire::all;
  Plotter plotter(rule);
  SensorFaults faults(scenario, seed);
  while (true) {
    const Scan scan = turns.turn();
    for (const auto& spoke : scan.spokes) {
      if (!spoke) continue;
      Spoke told = *spoke;
      faults.put_into(told.header);
      plotter.add(told);
      if (in_seconds(told.header.scenario_time.time_since_epoch()) < seconds + 0.6) continue;
      // That of the target is the one nearest to where she is.
      const PlanePoint truly = way(scenario.bearing_deg, scenario.range_nm * 3600.0);
      std::optional<PlottedTrack> nearest;
      double least_m = 1000.0;
      for (const PlottedTrack& track : plotter.tracks()) {
        const double off_m =
            length_of(way(track.bearing.in_degrees(), track.range_m / 1852.0 * 3600.0) - truly);
        if (off_m >= least_m) continue;
        least_m = off_m;
        nearest = track;
      }
      return nearest ? errors_of(scenario, *nearest) : std::vector<double>{};
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The four scenarios of A.823(19) on rendered video."};
  int runs = 500;
  app.add_option("--runs", runs, "Of each scenario")->check(CLI::Range(1, 100'000));
  CLI11_PARSE(app, argc, argv);
  const auto chart = open_charts({}, "");
  std::printf("scenario  min   rel.course  rel.speed     CPA    TCPA   course   speed\n");
  std::printf("                       deg         kn      NM     min      deg      kn\n");
  for (std::size_t s = 0; s < kStandardScenarios.size(); ++s) {
    for (const double minutes : {1.0, 3.0}) {
      int lost = 0;
      const StandardScenario& scenario = kStandardScenarios[s];
      const auto errors = errors_of_95(runs, lost, [&](int i) {
        return rendered_run(scenario, minutes, static_cast<std::uint64_t>(i), *chart);
      });
      const auto asked = (minutes < 2.0 ? scenario.after_1_min : scenario.after_3_min).all();
      std::printf("%zu        %4.0f ", s + 1, minutes);
      for (std::size_t k = 0; k < errors.size(); ++k) {
        std::printf("  %6.2f%s", errors[k],
                    asked[k] == 0.0         ? "   "
                    : errors[k] <= asked[k] ? " ok"
                                            : " NO");
      }
      std::printf("   no track: %d\n", lost);
      std::fflush(stdout);
    }
  }
}
