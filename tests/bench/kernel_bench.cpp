// The loops over the cells of one row.
#include <cstring>

#include "echo/kernel/azimuth_sum.hpp"
#include "echo/kernel/pulse_stretch.hpp"
#include "echo/kernel/relief_noise.hpp"
#include "tests/bench/bench_support.hpp"

namespace skerry::bench {
namespace {

constexpr std::uint32_t kCells = 1024;

// Mean powers over noise as land gives them, 0.1 to 1e5.
std::vector<float> busy_row(std::uint32_t cells) {
  std::vector<float> row(cells);
  for (std::uint32_t i = 0; i < cells; ++i) {
    row[i] = 0.1f * static_cast<float>(1u << (i * 7 % 20));
  }
  return row;
}

void bench_memset(benchmark::State& state) {
  std::vector<std::uint8_t> row(kCells);
  Meter meter(state, kCells);
  for (auto _ : state) {
    std::memset(row.data(), 0, row.size());
    benchmark::DoNotOptimize(row.data());
    benchmark::ClobberMemory();
  }
  meter.stop();
}

void bench_floor(benchmark::State& state) {
  Floor floor(kCells);
  Meter meter(state, kCells);
  for (auto _ : state) floor.run();
  meter.stop();
}

void bench_sum_rays(benchmark::State& state) {
  constexpr std::uint32_t kTaps = 35, kPitch = kCells + 16;
  std::vector<float> powers(kTaps * kPitch, 1.5f), sum(kCells);
  std::vector<echo::WeightedRay> rays;
  for (std::uint32_t k = 0; k < kTaps; ++k) {
    rays.push_back({powers.data() + std::size_t{k} * kPitch, 0.01f * static_cast<float>(k + 1)});
  }
  Meter meter(state, kCells);
  for (auto _ : state) {
    echo::sum_rays(rays, sum);
    benchmark::DoNotOptimize(sum.data());
    benchmark::ClobberMemory();
  }
  meter.stop();
}

// The row is filled anew each time, which is part of the figure.
void bench_stretch_pulse(benchmark::State& state, double pulse_cells) {
  const std::vector<float> original = busy_row(kCells);
  std::vector<float> row(kCells), scratch;
  Meter meter(state, kCells);
  for (auto _ : state) {
    std::memcpy(row.data(), original.data(), kCells * sizeof(float));
    echo::stretch_pulse(row, pulse_cells, scratch);
    benchmark::DoNotOptimize(row.data());
    benchmark::ClobberMemory();
  }
  meter.stop();
}

void bench_relief_noise(benchmark::State& state) {
  constexpr echo::NoiseOctave kOctaves[] = {
      {330.0, 0.45f}, {130.0, 0.3f}, {52.0, 0.17f}, {21.0, 0.08f}};
  const echo::LatticePath path{6.7e6, 6.0, -1e-6, 3.0e5, 9.0, 1e-6};
  std::vector<float> row(kCells);
  Meter meter(state, kCells);
  for (auto _ : state) {
    echo::relief_noise(path, kOctaves, 7, 0, row);
    benchmark::DoNotOptimize(row.data());
    benchmark::ClobberMemory();
  }
  meter.stop();
}

void bench_receiver(benchmark::State& state, double rain) {
  echo::ViewControls controls;
  controls.range_scale = *RangeScale::find(6.0);
  controls.rain = rain;
  const echo::RadarModel model =
      echo::radar_model({}, {4096, kCells, 8}, controls.range_scale, {24.0, 4096}, 0);
  echo::ViewReceiver receiver(model, controls);
  const std::vector<float> power = busy_row(kCells);
  std::vector<std::uint8_t> video(kCells);
  std::uint64_t spoke = 0;
  Meter meter(state, kCells);
  for (auto _ : state) {
    receiver.receive(power, kCells, spoke++, 1, 1, echo::serial_for, video);
    benchmark::DoNotOptimize(video.data());
    benchmark::ClobberMemory();
  }
  meter.stop();
}

}  // namespace

void register_kernels() {
  register_once("memset of a row", bench_memset);
  register_per_isa("floor", bench_floor);
  register_per_isa("sum_rays/35 taps", bench_sum_rays);
  for (const double cells : {3.5, 13.8}) {
    register_per_isa("stretch_pulse/" + std::to_string(cells).substr(0, 4) + " cells",
                     [cells](benchmark::State& state) { bench_stretch_pulse(state, cells); });
  }
  register_per_isa("relief_noise/4 octaves", bench_relief_noise);
  register_per_isa("receiver", [](benchmark::State& state) { bench_receiver(state, 0.0); });
  register_per_isa("receiver with rain control",
                   [](benchmark::State& state) { bench_receiver(state, 60.0); });
}

}  // namespace skerry::bench
