// What each stage of the full scene costs, and whether memory or arithmetic bounds it.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "echo/clutter/sea_returns.hpp"
#include "echo/kernel/aligned_floats.hpp"
#include "echo/kernel/isa.hpp"
#include "echo/propagation/propagation.hpp"
#include "echo/receiver/view_receiver.hpp"
#include "echo/returns/static_returns.hpp"
#include "echo/spoke_renderer.hpp"
#include "echo/targets/echo_splat.hpp"
#include "echo/targets/target_returns.hpp"
#include "protocol/wire/frame.hpp"
#include "tests/bench/bench_support.hpp"
#include "tests/bench/memory_speed.hpp"
#include "tests/bench/radar_bench_parts.hpp"
#include "tests/scenes/moving_scene.hpp"
#include "tests/scenes/without.hpp"

namespace skerry::bench {
namespace {

// Of the full scene's cells, those under one of its two clouds.
constexpr double kRainShare = 0.15;

// Bytes of the rows and tables that a stage's code goes through, by cell of the picture.
struct Stage {
  std::string name;
  double seconds = 0.0;
  double read = 0.0, written = 0.0;
};

// The stages of a sector one by one, each timed over a turn behind one that fills what is kept.
class Chain {
 public:
  explicit Chain(const scenes::NamedScene& named)
      : named_(named),
        clock_(named.rpm, named.geometry.spokes_per_turn),
        model_(echo::radar_model(named.set, named.geometry, named.controls.range_scale, clock_, 0)),
        scenes_(named.scene),
        propagation_(named.set, named.scene->atmosphere, named.scene->wave_height_m, 150e3),
        statics_(model_, echo::serial_for),
        sea_(model_),
        targets_(model_, &propagation_),
        splat_(model_),
        plain_(model_, plain_controls()),
        full_(model_, named.controls),
        ahead_(std::max(plain_.rows_ahead(), full_.rows_ahead())),
        pitch_(named.geometry.cells + 16),
        rows_((kSectorSpokes + ahead_) * pitch_),
        dry_(kSectorSpokes),
        video_(std::size_t{kSectorSpokes} * named.geometry.cells) {}

  std::vector<Stage> run() {
    const std::uint32_t turn = named_.geometry.spokes_per_turn;
    for (std::uint64_t first = 0; first < 2 * turn; first += kSectorSpokes) {
      if (first == turn) stages_.clear();
      sector(first);
    }
    const double cells = double{1} * turn * named_.geometry.cells;
    for (Stage& stage : stages_) stage.read /= cells, stage.written /= cells;
    return stages_;
  }

 private:
  echo::ViewControls plain_controls() const {
    echo::ViewControls controls;
    controls.range_scale = named_.controls.range_scale;
    return controls;
  }

  template <typename Work>
  Stage& timed(const std::string& name, Work&& work) {
    const double begun = thread_seconds();
    work();
    const double took = thread_seconds() - begun;
    auto found = std::find_if(stages_.begin(), stages_.end(),
                              [&](const Stage& stage) { return stage.name == name; });
    if (found == stages_.end()) found = stages_.insert(stages_.end(), Stage{name});
    found->seconds += took;
    return *found;
  }

  std::span<float> row(std::size_t k) {
    return std::span<float>(rows_).subspan(k * pitch_, named_.geometry.cells);
  }

  void sector(std::uint64_t first) {
    const echo::ScenePtr scene = scenes_.at(clock_.time_of(first));
    std::vector<echo::SpokeAim> aims;
    for (std::uint32_t k = 0; k < kSectorSpokes; ++k)
      aims.push_back(aim_of(*scene, clock_, first + k));
    land(*scene, first, aims);
    sea(*scene, aims);
    ships(*scene, aims);
    receiver(first, scene->seed);
    encode(first);
  }

  void land(const echo::Scene& scene, std::uint64_t first,
            const std::vector<echo::SpokeAim>& aims) {
    const double cells = double{kSectorSpokes} * named_.geometry.cells;
    const std::uint64_t before = statics_.effort().rows;
    Stage& frame = timed("land: rows of the next frame",
                         [&] { statics_.prepare(scene, first, kSectorSpokes); });
    // A row: rays of two and a half beams, five to a beam, and half-size cells out.
    const auto made = static_cast<double>(statics_.effort().rows - before);
    frame.read += made * 12.5 * 4.0 * named_.geometry.cells;
    frame.written += made * 2.0 * named_.geometry.cells;
    Stage& laid = timed("land: found and laid", [&] {
      for (std::size_t k = 0; k < kSectorSpokes; ++k) {
        std::fill(row(k).begin(), row(k).end(), 0.0f);
        statics_.add(aims[k], row(k), dry_[k]);
      }
    });
    double echoing = 0.0;
    for (std::size_t k = 0; k < kSectorSpokes; ++k)
      echoing += static_cast<double>(
          std::count_if(row(k).begin(), row(k).end(), [](float p) { return p > 0.0f; }));
    laid.read += 6.0 * echoing;  // half-size cells, and the row
    laid.written += 4.0 * cells + 4.0 * echoing;
  }

  // Where some spoke of the sector sees water, as SeaReturns::prepare() wants it.
  std::vector<std::uint8_t> wet_cells() const {
    constexpr std::size_t kCells = echo::SeaReturns::kWetCells;
    std::vector<std::uint8_t> wet((named_.geometry.cells + kCells - 1) / kCells, 0);
    for (std::size_t k = 0; k < kSectorSpokes; ++k) {
      std::size_t from = 0;
      const auto mark = [&](std::size_t end) {
        for (std::size_t cell = from; cell < end; ++cell) wet[cell / kCells] = 1;
      };
      for (const echo::CellRun& run : dry_[k]) {
        mark(run.first);
        from = std::max<std::size_t>(from, run.last);
      }
      mark(named_.geometry.cells);
    }
    return wet;
  }

  void sea(const echo::Scene& scene, const std::vector<echo::SpokeAim>& aims) {
    const std::vector<std::uint8_t> wet_runs = wet_cells();
    const double seen = static_cast<double>(std::count(wet_runs.begin(), wet_runs.end(), 1)) /
                        static_cast<double>(wet_runs.size());
    Stage& waves =
        timed("sea: waves", [&] { sea_.prepare(scene, aims.front(), aims.back(), wet_runs); });
    const double reach = seen * sea_.reach_cells();
    const double laid_rows = double{kSectorSpokes} / sea_.texture_spokes();
    const double samples = reach / sea_.profile().cells_per_sample();
    // Two bearings' samples, their distance and the wind's spread; means and the row itself.
    waves.read += laid_rows * (4.0 * 4.0 * samples + 4.0 * reach);
    waves.written += laid_rows * (4.0 * samples + 4.0 * reach);
    double wet = 0.0;
    Stage& laid = timed("sea: laid", [&] {
      for (std::size_t k = 0; k < kSectorSpokes; ++k) {
        std::uint32_t from = 0;
        const auto add = [&](std::uint32_t end) {
          sea_.add(aims[k], row(k), from, end);
          if (end > from) wet += end - from;
        };
        for (const echo::CellRun& run : dry_[k]) {
          add(std::min<std::uint32_t>(run.first, sea_.reach_cells()));
          from = std::max<std::uint32_t>(from, run.last);
        }
        add(sea_.reach_cells());
      }
    });
    laid.read += 16.0 * wet;  // two rows of waves, speckle, the row
    laid.written += 4.0 * wet;
  }

  void ships(const echo::Scene& scene, const std::vector<echo::SpokeAim>& aims) {
    timed("ships and buoys: found", [&] {
      points_.clear();
      targets_.prepare(
          scene, aims.front(), aims.back(),
          [this](std::uint32_t units, double range_m) {
            return statics_.hidden_height(units, range_m);
          },
          points_);
      splat_.prepare(points_, aims.front(), aims.back(), targets_.strong());
    });
    Stage& laid = timed("ships and buoys: laid", [&] {
      for (std::size_t k = 0; k < kSectorSpokes; ++k) {
        if (targets_.shadows().any()) targets_.shadows().apply(aims[k], row(k));
        splat_.add(aims[k], row(k));
      }
    });
    double filled = 0.0;
    for (const echo::SpokeAim& aim : aims) {
      splat_.each_body(aim, named_.geometry.cells,
                       [&](std::uint32_t, std::uint32_t, std::span<const float> cells) {
                         filled += static_cast<double>(cells.size());
                       });
    }
    laid.read += 12.0 * filled;  // both quadratures, and the row
    laid.written += 12.0 * filled;
  }

  void receiver(std::uint64_t first, std::uint64_t seed) {
    const double cells = double{kSectorSpokes} * named_.geometry.cells;
    Stage& plain = timed("receiver: noise, log, gain and STC", [&] {
      plain_.receive(rows_, pitch_, first, kSectorSpokes, seed, echo::serial_for, video_, 0);
    });
    plain.read += (4.0 + 24.0 + 4.0) * cells;  // power, three stretches of noise, offsets
    plain.written += cells;
    Stage& full = timed("receiver: all stages", [&] {
      full_.receive(rows_, pitch_, first, kSectorSpokes, seed, echo::serial_for, video_, ahead_);
    });
    // And two spokes before, sums of the group and so far; the video three times.
    full.read += (32.0 + 8.0 + 8.0 + 3.0) * cells;
    full.written += (1.0 + 4.0 + 8.0 + 3.0) * cells;
  }

  void encode(std::uint64_t first) {
    const double cells = double{kSectorSpokes} * named_.geometry.cells;
    Spoke spoke;
    spoke.header.geometry = named_.geometry;
    spoke.cells.resize(named_.geometry.cells);
    Stage& stage = timed("encoding, native", [&] {
      for (std::uint32_t k = 0; k < kSectorSpokes; ++k) {
        spoke.header.sequence = first + k;
        std::copy_n(video_.begin() + k * named_.geometry.cells, named_.geometry.cells,
                    spoke.cells.begin());
        frame_.clear();
        append_spoke_frame(frame_, spoke);
      }
    });
    stage.read += 2.0 * cells;
    stage.written += 2.0 * cells;
  }

  const scenes::NamedScene& named_;
  echo::SpokeClock clock_;
  echo::RadarModel model_;
  scenes::MovingScene scenes_;
  echo::Propagation propagation_;
  echo::StaticReturns statics_;
  echo::SeaReturns sea_;
  echo::TargetReturns targets_;
  echo::EchoSplat splat_;
  echo::ViewReceiver plain_, full_;
  std::uint32_t ahead_;
  std::size_t pitch_;
  echo::AlignedFloats rows_;
  std::vector<std::vector<echo::CellRun>> dry_;
  std::vector<std::uint8_t> video_;
  std::vector<echo::PointEcho> points_;
  Bytes frame_;
  std::vector<Stage> stages_;
};

// Of a whole radar, seconds a turn.
double turn_seconds_of(const scenes::NamedScene& named) {
  const echo::SpokeClock clock(named.rpm, named.geometry.spokes_per_turn);
  echo::SpokeRenderer renderer(named.set, named.geometry, clock, 0);
  renderer.set_controls(named.controls);
  scenes::MovingScene scenes(named.scene);
  std::vector<std::uint8_t> video(std::size_t{kSectorSpokes} * named.geometry.cells);
  std::vector<double> turns;
  std::uint64_t spoke = 0;
  for (int turn = 0; turn < 4; ++turn) {
    double seconds = 0.0;
    for (std::uint32_t k = 0; k < named.geometry.spokes_per_turn;
         k += kSectorSpokes, spoke += kSectorSpokes) {
      const echo::ScenePtr scene = scenes.at(clock.time_of(spoke));
      const double begun = thread_seconds();
      renderer.render(*scene, spoke, kSectorSpokes, video);
      seconds += thread_seconds() - begun;
    }
    if (turn > 0) turns.push_back(seconds);
  }
  return percentile_of(turns, 0.0);
}

void print_stage(const Stage& stage, double cells, const MemorySpeed& memory) {
  const double ns = 1e9 * stage.seconds / cells, bytes = stage.read + stage.written;
  if (bytes <= 0.0) {
    fmt::print("{:<38}{:>8.3f}{:>8}{:>8}{:>8}{:>10}  {}\n", stage.name, ns, "-", "-", "-", "-", "");
    return;
  }
  const double share = bytes / ns / memory.triad;
  fmt::print("{:<38}{:>8.3f}{:>8.2f}{:>8.2f}{:>8.1f}{:>9.0f}%  {}\n", stage.name, ns, stage.read,
             stage.written, bytes / ns, 100.0 * share,
             share >= 1.0   ? "needs its caches"
             : share >= 0.5 ? "memory's, but for its caches"
                            : "arithmetic");
}

}  // namespace

void stage_table(const scenes::NamedScene& full) {
  const MemorySpeed memory = memory_speed();
  fmt::print(
      "\nMemory beyond the caches, one core: memcpy {:.1f}, memset {:.1f}, triad {:.1f} GB/s\n",
      memory.copy, memory.set, memory.triad);
  const double cells = double{1} * full.geometry.spokes_per_turn * full.geometry.cells;
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    if (isa > echo::best_isa()) continue;
    echo::force_isa(isa);
    fmt::print(
        "\nStages of the full scene, {}; bytes as the code's own arrays have them\n"
        "{:<38}{:>8}{:>8}{:>8}{:>8}{:>10}  {}\n",
        echo::name_of(isa), "", "ns/cell", "B read", "written", "GB/s", "of triad", "bound by");
    for (const Stage& stage : Chain(full).run()) print_stage(stage, cells, memory);
    const double all = turn_seconds_of(full);
    // Levels and speckle of the rain, and the row.
    Stage rain{"rain (what the scene without it saves)",
               std::max(0.0, all - turn_seconds_of(scenes::with(full, scenes::no_rain)))};
    rain.read = 12.0 * kRainShare, rain.written = 4.0 * kRainShare;
    print_stage(rain, cells, memory);
    print_stage({"a whole radar", all}, cells, memory);
  }
  echo::force_isa(echo::best_isa());
}

}  // namespace skerry::bench
