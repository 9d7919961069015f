// radar_bench: what a radar costs on one core, against the bare floor of the same run.
//
//   radar_bench                 scenes, contributors, views and how cost grows
//   radar_bench --turns 8       longer
//   radar_bench --full          the full scene alone, to be profiled
//   radar_bench --full --isa avx2   the same with a lesser instruction set (baseline, avx2)
//   radar_bench --fleet [N]     N radars by turns against one after the other
//   radar_bench --memory        whose memory a radar is made of
//   radar_bench --stages        what each stage costs, and its share of memory's speed
//   radar_bench --changes       first sectors after changes of the range scale
//
// Columns: ns/cell of the scene, of the floor beside it, their ratio, and how many such radars of
// 4096 x 1024 cells at 24 rpm one core carries in real time.  Medians over turns of CPU time of the
// thread; scene and floor take turns sector by sector, so that what else the machine does weighs on
// both alike.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/bench_support.hpp"
#include "tests/bench/radar_bench_parts.hpp"
#include "tests/scenes/full_scene.hpp"
#include "tests/scenes/moving_scene.hpp"
#include "tests/scenes/without.hpp"

namespace skerry::bench {
namespace {

struct Cost {
  double scene_ns = 0.0, floor_ns = 0.0;  // per cell
  double worst_sector_ms = 0.0;
  double ratio() const { return scene_ns / floor_ns; }
};

// One turn to fill what is kept, then `turns` measured ones, the own ship and all else under way.
class Sail {
 public:
  explicit Sail(const scenes::NamedScene& named)
      : geometry_(named.geometry),
        clock_(named.rpm, named.geometry.spokes_per_turn),
        renderer_(named.set, named.geometry, clock_, 0),
        scenes_(named.scene),
        floor_(named.geometry.cells),
        video_(std::size_t{kSectorSpokes} * named.geometry.cells) {
    renderer_.set_controls(named.controls);
  }

  Cost turns(int count) {
    turn();
    std::vector<double> scene_ns, floor_ns;
    Cost cost;
    for (int i = 0; i < count; ++i) {
      const Cost one = turn();
      scene_ns.push_back(one.scene_ns);
      floor_ns.push_back(one.floor_ns);
      cost.worst_sector_ms = std::max(cost.worst_sector_ms, one.worst_sector_ms);
    }
    cost.scene_ns = median_of(scene_ns);
    cost.floor_ns = median_of(floor_ns);
    return cost;
  }

 private:
  Cost turn() {
    Cost cost;
    for (std::uint32_t k = 0; k < geometry_.spokes_per_turn;
         k += kSectorSpokes, spoke_ += kSectorSpokes) {
      const echo::ScenePtr scene = scenes_.at(clock_.time_of(spoke_));
      const double begun = thread_seconds();
      renderer_.render(*scene, spoke_, kSectorSpokes, video_);
      const double made = thread_seconds();
      for (std::uint32_t i = 0; i < kSectorSpokes; ++i) floor_.run();
      cost.scene_ns += made - begun;
      cost.floor_ns += thread_seconds() - made;
      cost.worst_sector_ms = std::max(cost.worst_sector_ms, 1e3 * (made - begun));
    }
    const double cells = double{1} * geometry_.spokes_per_turn * geometry_.cells;
    cost.scene_ns *= 1e9 / cells;
    cost.floor_ns *= 1e9 / cells;
    return cost;
  }

  ScanGeometry geometry_;
  echo::SpokeClock clock_;
  echo::SpokeRenderer renderer_;
  scenes::MovingScene scenes_;
  Floor floor_;
  std::vector<std::uint8_t> video_;
  std::uint64_t spoke_ = 0;
};

void heading() {
  fmt::print("{:<44}{:>9}{:>9}{:>8}{:>13}{:>12}\n", "", "ns/cell", "floor", "ratio", "radars/core",
             "worst ms");
}

Cost report(const std::string& name, const scenes::NamedScene& named, int turns) {
  const Cost cost = Sail(named).turns(turns);
  const double cells_per_second = 4096.0 * 1024.0 * 24.0 / 60.0;
  fmt::print("{:<44}{:>9.2f}{:>9.2f}{:>8.2f}{:>13.0f}{:>12.2f}\n", name, cost.scene_ns,
             cost.floor_ns, cost.ratio(), 1e9 / (cost.scene_ns * cells_per_second),
             cost.worst_sector_ms);
  return cost;
}

// Least squares line through (x, y).
struct Line {
  double at_zero, slope, worst;  // worst: of the points off the line, share of the line
};
Line fit(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  Line line{};
  line.slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  line.at_zero = (sy - line.slope * sx) / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double on_line = line.at_zero + line.slope * x[i];
    line.worst = std::max(line.worst, std::fabs(y[i] - on_line) / on_line);
  }
  return line;
}

void growth_with_targets(int turns) {
  fmt::print("\nCost by the number of targets (ships : buoys = 2 : 5)\n");
  heading();
  std::vector<double> x, y;
  for (const int ships : {0, 40, 80, 160, 320}) {
    auto named = scenes::full_scene({ships, ships * 5 / 2});
    if (!named) return;
    const Cost cost = report(fmt::format("{} targets", ships * 7 / 2), *named, turns);
    x.push_back(ships * 3.5);
    y.push_back(cost.ratio());
  }
  const Line line = fit(x, y);
  fmt::print("fit: ratio {:.2f} + {:.5f} per target, worst point {:.0f} % off the line\n",
             line.at_zero, line.slope, 100.0 * line.worst);
}

void growth_with_coast(int turns) {
  fmt::print("\nCost by visible coast: made-up islands within 6 NM\n");
  heading();
  std::vector<double> x, y;
  for (const int islands : {0, 25, 50, 100, 200}) {
    scenes::NamedScene named;
    const RangeScale scale = *RangeScale::find(6.0);
    named.scene =
        scenes::scene_at(scenes::made_up_chart(scenes::kBergen, scale.length() * 1.3, islands, 7),
                         scenes::kBergen, scale, named.geometry);
    named.controls.range_scale = scale;
    const double edges = static_cast<double>(named.scene->coast->edge_count());
    const Cost cost = report(fmt::format("{} islands, {} edges", islands, edges), named, turns);
    x.push_back(edges);
    y.push_back(cost.ratio());
  }
  const Line line = fit(x, y);
  fmt::print("fit: ratio {:.2f} + {:.3f} per 10 000 edges, worst point {:.0f} % off the line\n",
             line.at_zero, 1e4 * line.slope, 100.0 * line.worst);
}

void size_of_the_chart(int turns) {
  fmt::print("\nCost by the size of the chart window, Bergen on 6 NM\n");
  heading();
  for (const double nm : {8.0, 16.0, 32.0, 64.0}) {
    auto chart = scenes::world_chart(scenes::kBergen, nautical_miles(nm));
    if (!chart) return;
    scenes::NamedScene named;
    named.controls.range_scale = *RangeScale::find(6.0);
    std::size_t vertices = 0;
    for (const auto& ring : chart->rings) vertices += ring.vertices.size();
    named.scene = scenes::scene_at(std::move(*chart), scenes::kBergen, named.controls.range_scale,
                                   named.geometry);
    report(fmt::format("{:.0f} NM, {} chart vertices", nm, vertices), named, turns);
  }
}

void a_further_view(const scenes::NamedScene& full) {
  fmt::print("\nA further view of the full scene\n");
  heading();
  const echo::SpokeClock clock(full.rpm, full.geometry.spokes_per_turn);
  const echo::RadarModel model =
      echo::radar_model(full.set, full.geometry, full.controls.range_scale, clock, 0);
  const auto measure = [&](const std::string& name, const echo::ViewControls& controls) {
    echo::SpokeReturns returns(model, echo::serial_for);
    echo::ViewReceiver view(model, controls);
    Floor floor(full.geometry.cells);
    const std::uint32_t row_cells =
        echo::row_cells_for(full.geometry, full.controls.range_scale, controls);
    returns = echo::SpokeReturns(echo::with_rows_of(model, row_cells), echo::serial_for);
    view.set_row_cells(row_cells);
    std::vector<std::uint8_t> video(std::size_t{kSectorSpokes} * full.geometry.cells);
    double view_s = 0.0, floor_s = 0.0;
    for (std::uint32_t first = 0; first < full.geometry.spokes_per_turn; first += kSectorSpokes) {
      const echo::PowerRows rows =
          returns.make(*full.scene, first, kSectorSpokes + view.rows_ahead());
      const double begun = thread_seconds();
      view.receive(rows.cells, rows.pitch, first, kSectorSpokes, full.scene->seed, echo::serial_for,
                   video, view.rows_ahead());
      const double made = thread_seconds();
      for (std::uint32_t i = 0; i < kSectorSpokes; ++i) floor.run();
      view_s += made - begun;
      floor_s += thread_seconds() - made;
    }
    const double cells = double{1} * full.geometry.spokes_per_turn * full.geometry.cells;
    fmt::print("{:<44}{:>9.2f}{:>9.2f}{:>8.2f}\n", name, 1e9 * view_s / cells,
               1e9 * floor_s / cells, view_s / floor_s);
  };
  echo::ViewControls plain;
  plain.range_scale = full.controls.range_scale;
  measure("gain and STC", plain);
  echo::ViewControls shorter = plain;
  shorter.range_scale = *RangeScale::find(3.0);
  measure("another range scale", shorter);
  echo::ViewControls rain = plain;
  rain.rain = 50.0;
  measure("rain control", rain);
  echo::ViewControls stretch = plain;
  stretch.echo_stretch = 50.0;
  measure("echo stretch", stretch);
  measure("all stages", full.controls);
  const auto with = [&](const char* name, const std::function<void(echo::ViewControls&)>& change) {
    echo::ViewControls controls = plain;
    change(controls);
    measure(name, controls);
  };
  with("automatic gain", [](auto& c) { c.gain_auto = true; });
  with("side lobe suppression", [](auto& c) { c.side_lobe_suppression = 50.0; });
  with("noise rejection", [](auto& c) { c.noise_rejection = 50.0; });
  with("target separation", [](auto& c) { c.target_separation = 50.0; });
  with("target boost", [](auto& c) { c.target_boost = 50.0; });
  with("harbour mode", [](auto& c) { c.mode = echo::PictureMode::harbour; });
  const double scale_m = plain.range_scale.length().in_metres();
  with("0.9 times the range scale", [&](auto& c) { c.instrumented_range_m = 0.9 * scale_m; });
  with("1.7 times the range scale", [&](auto& c) { c.instrumented_range_m = 1.7 * scale_m; });
  with("twice the range scale", [&](auto& c) { c.instrumented_range_m = 2.0 * scale_m; });
}

// The cost of rows of which a view wants more: longer ones, or with radial speeds.
void more_of_the_rows(const scenes::NamedScene& full) {
  fmt::print("\nRows of the full scene that show more\n");
  heading();
  const echo::SpokeClock clock(full.rpm, full.geometry.spokes_per_turn);
  const auto measure = [&](const std::string& name, std::uint32_t row_cells, bool doppler) {
    const echo::RadarModel model =
        echo::radar_model(full.set, full.geometry, full.controls.range_scale, clock, 0);
    echo::SpokeReturns returns(echo::with_rows_of(model, row_cells), echo::serial_for);
    returns.set_doppler(doppler);
    Floor floor(full.geometry.cells);
    double rows_s = 0.0, floor_s = 0.0;
    for (std::uint32_t first = 0; first < 2 * full.geometry.spokes_per_turn;
         first += kSectorSpokes) {
      const double begun = thread_seconds();
      returns.make(*full.scene, first, kSectorSpokes);
      const double made = thread_seconds();
      for (std::uint32_t i = 0; i < kSectorSpokes; ++i) floor.run();
      if (first < full.geometry.spokes_per_turn) continue;  // a turn to fill what is kept
      rows_s += made - begun;
      floor_s += thread_seconds() - made;
    }
    const double cells = double{1} * full.geometry.spokes_per_turn * full.geometry.cells;
    fmt::print("{:<44}{:>9.2f}{:>9.2f}{:>8.2f}\n", name, 1e9 * rows_s / cells,
               1e9 * floor_s / cells, rows_s / floor_s);
  };
  const std::uint32_t cells = full.geometry.cells;
  measure("to the range scale", cells, false);
  measure("with radial speeds", cells, true);
  measure("to 1.5 times the range scale", cells * 3 / 2, false);
  measure("to twice the range scale", cells * 2, false);
}

void fleets(const scenes::NamedScene& full, const std::vector<std::size_t>& sizes, int turns) {
  fmt::print("\nMany radars of the full scene on one core, ns/cell and radars in real time\n");
  fmt::print("{:<10}{:>8}{:>14}{:>14}{:>10}{:>22}\n", "", "radars", "one by one", "by sectors",
             "ratio", "carried: one by one, by sectors");
  for (const echo::Isa isa : {echo::Isa::avx2, echo::Isa::avx512}) {
    if (isa > echo::best_isa()) continue;
    echo::force_isa(isa);
    for (const std::size_t radars : sizes) by_turns(full, radars, turns);
  }
  echo::force_isa(echo::best_isa());
}

void contributors(const scenes::NamedScene& full, int turns) {
  fmt::print("\nThe full scene without each of its parts\n");
  heading();
  using scenes::with;
  report("without rain", with(full, scenes::no_rain), turns);
  report("without sea", with(full, scenes::no_sea), turns);
  report("without sea and rain", with(with(full, scenes::no_sea), scenes::no_rain), turns);
  report("without ships and buoys", with(full, scenes::no_targets), turns);
  report("without land", with(full, scenes::no_land), turns);
  scenes::NamedScene plain = full;
  plain.controls = {};
  plain.controls.range_scale = full.controls.range_scale;
  report("gain and STC alone", plain, turns);
}

int run(int turns, const std::string& part, std::size_t radars) {
  const auto full = scenes::full_scene();
  const auto bergen = scenes::bergen();
  if (!full || !bergen) {
    fmt::print("no chart installed: apt install gmt-gshhg-full\n");
    return 0;
  }
  if (part == "--fleet") {
    fleets(*full, radars > 0 ? std::vector<std::size_t>{radars} : std::vector<std::size_t>{1, 150},
           turns);
    return 0;
  }
  if (part == "--memory") {
    working_set(*full);
    return 0;
  }
  if (part == "--stages") {
    stage_table(*full);
    return 0;
  }
  if (part == "--changes") {
    range_changes(*full);
    return 0;
  }
  if (part == "--full") {
    heading();
    report("full", *full, turns);
    return 0;
  }
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    if (isa > echo::best_isa()) continue;
    echo::force_isa(isa);
    fmt::print("\n{}\n", echo::name_of(isa));
    heading();
    for (const scenes::NamedScene& named : scenes::made_up_scenes()) {
      if (named.name == "open sea") report("open sea", named, turns);
    }
    report("default: Bergen, a dozen ships", *bergen, turns);
    report("full", *full, turns);
  }
  fleets(*full, turns > 1 ? std::vector<std::size_t>{1, 150, 400} : std::vector<std::size_t>{10},
         turns);
  working_set(*full);
  stage_table(*full);
  if (turns > 1) range_changes(*full);
  contributors(*full, turns);
  a_further_view(*full);
  more_of_the_rows(*full);
  growth_with_targets(turns);
  growth_with_coast(turns);
  size_of_the_chart(turns);
  return 0;
}

}  // namespace

double percentile_of(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}
double median_of(std::vector<double> values) { return percentile_of(std::move(values), 0.5); }

}  // namespace skerry::bench

int main(int argc, char** argv) {
  int turns = 3;
  std::string part;
  std::size_t radars = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--turns" && i + 1 < argc) {
      turns = std::max(1, std::atoi(argv[++i]));
    } else if (word == "--full" || word == "--memory" || word == "--stages" ||
               word == "--changes") {
      part = word;
    } else if (word == "--isa" && i + 1 < argc) {
      const std::string_view name = argv[++i];
      for (const auto isa : {skerry::echo::Isa::baseline, skerry::echo::Isa::avx2})
        if (name == skerry::echo::name_of(isa)) skerry::echo::force_isa(isa);
    } else if (word == "--fleet") {
      part = word;
      if (i + 1 < argc && std::atoi(argv[i + 1]) > 0)
        radars = static_cast<std::size_t>(std::atoi(argv[++i]));
    } else if (word.starts_with("--benchmark")) {
      turns = 1;  // run with the others, shortly
    } else {
      fmt::print(stderr,
                 "radar_bench: unknown argument '{}'; usage: radar_bench [--turns N]\n"
                 "  [--full [--isa NAME] | --stages | --memory | --changes | --fleet [RADARS]]\n",
                 word);
      return 2;
    }
  }
  return skerry::bench::run(turns, part, radars);
}
