#include "tests/bench/bench_support.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "echo/receiver/log_video.hpp"
#include "echo/returns/static_frame.hpp"

namespace skerry::bench {
namespace {

constexpr double kStepsPerDb = 256.0 / echo::kLogVideoDb;

void set_up(benchmark::internal::Benchmark* registered, benchmark::TimeUnit unit,
            bool manual_time) {
  registered->Unit(unit);
  if (manual_time) registered->UseManualTime();
}

}  // namespace

void register_per_isa(const std::string& name, const Body& body, benchmark::TimeUnit unit,
                      bool manual_time) {
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    if (isa > echo::best_isa()) continue;
    const std::string full = name + "/" + std::string(echo::name_of(isa));
    const auto forced = [isa, body](benchmark::State& state) {
      echo::force_isa(isa);
      body(state);
      echo::force_isa(echo::best_isa());
    };
    set_up(benchmark::RegisterBenchmark(full.c_str(), forced), unit, manual_time);
  }
}

void register_once(const std::string& name, const Body& body, benchmark::TimeUnit unit,
                   bool manual_time) {
  set_up(benchmark::RegisterBenchmark(name.c_str(), body), unit, manual_time);
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

Floor::Floor(std::uint32_t cells) : power_(cells, 0.0f), offset_(cells), video_(cells) {
  const double cell_m = ScanGeometry{4096, cells, 8}.cell_size(RangeScale{}).in_metres();
  for (std::uint32_t i = 0; i < cells; ++i) {
    offset_[i] = static_cast<float>(
        -kStepsPerDb * (echo::threshold_db(50.0) + echo::stc_db(20.0, (i + 0.5) * cell_m)));
  }
}

void Floor::run() {
  constexpr echo::QuantiserScale kScale{static_cast<float>(kStepsPerDb * echo::kDecibelsPerOctave),
                                        255.0f};
  echo::detect_and_quantise(power_, offset_, echo::noise_key(1, 0, 0, spoke_++), kScale, video_);
  benchmark::DoNotOptimize(video_.data());
  benchmark::ClobberMemory();
}

void report_cells(benchmark::State& state, double seconds, double cells, double floor_seconds,
                  double floor_cells) {
  const double ns = seconds * 1e9 / cells, floor_ns = floor_seconds * 1e9 / floor_cells;
  state.counters["ns/cell"] = ns;
  state.counters["floor"] = floor_ns;
  state.counters["ratio"] = ns / floor_ns;
}

Meter::Meter(benchmark::State& state, double cells_per_iteration)
    : state_(state), cells_per_iteration_(cells_per_iteration) {
  measure_floor();
  begun_ = thread_seconds();
}

void Meter::stop() {
  const double seconds = thread_seconds() - begun_;
  measure_floor();
  report_cells(state_, seconds, static_cast<double>(state_.iterations()) * cells_per_iteration_,
               floor_seconds_, floor_cells_);
}

void Meter::measure_floor() {
  constexpr int kFloorRows = 256;
  floor_.run();
  const double begun = thread_seconds();
  for (int i = 0; i < kFloorRows; ++i) floor_.run();
  floor_seconds_ += thread_seconds() - begun;
  floor_cells_ += static_cast<double>(kFloorRows) * floor_.cells();
}

const std::vector<scenes::NamedScene>& bench_scenes() {
  static const std::vector<scenes::NamedScene> all = [] {
    std::vector<scenes::NamedScene> chosen;
    for (scenes::NamedScene& scene : scenes::made_up_scenes()) {
      if (scene.name == "open sea" || scene.name == "islands" || scene.name == "traffic") {
        chosen.push_back(std::move(scene));
      }
    }
    if (auto bergen = scenes::bergen()) chosen.push_back(std::move(*bergen));
    return chosen;
  }();
  return all;
}

const scenes::NamedScene& bench_scene(const std::string& name) {
  for (const scenes::NamedScene& scene : bench_scenes()) {
    if (scene.name == name) return scene;
  }
  throw std::invalid_argument("no scene '" + name + "' among the benched ones");
}

echo::RayModel ray_model_of(const scenes::NamedScene& named) {
  const RangeScale scale = named.controls.range_scale;
  // Whole rays to a spoke, and no fewer than land has to a beam.
  const double spoke_beams = named.geometry.spokes_per_turn * named.set.beam_width_deg / 360.0;
  const auto per_spoke =
      static_cast<std::uint32_t>(std::ceil(std::max(1.0, echo::kRaysPerBeam / spoke_beams)));
  const std::uint32_t rays = named.geometry.spokes_per_turn * per_spoke;
  return {named.set, named.set.pulse_for(scale), rays, named.geometry.cells,
          named.geometry.cell_size(scale).in_metres()};
}

}  // namespace skerry::bench
