// Shared by the benches of the echo.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "echo/kernel/isa.hpp"
#include "echo/kernel/log_receiver.hpp"
#include "tests/scenes/ray_returns.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::bench {

using Body = std::function<void(benchmark::State&)>;

// Registers `body` as NAME/baseline, NAME/avx2 ... for each instruction set of this machine.
void register_per_isa(const std::string& name, const Body& body,
                      benchmark::TimeUnit unit = benchmark::kNanosecond, bool manual_time = false);
void register_once(const std::string& name, const Body& body,
                   benchmark::TimeUnit unit = benchmark::kNanosecond, bool manual_time = false);

// CPU time of the calling thread, seconds.
double thread_seconds();

// The least any radar of this kind has to do for a cell: exponential noise, log, gain, clamp, 8
// bits; a row without echoes through detect_and_quantise().
class Floor {
 public:
  explicit Floor(std::uint32_t cells);
  void run();
  std::uint32_t cells() const { return static_cast<std::uint32_t>(video_.size()); }

 private:
  std::vector<float> power_, offset_;
  std::vector<std::uint8_t> video_;
  std::uint32_t spoke_ = 0;
};

// The counters of every bench: "ns/cell", "floor" (ns/cell, measured in the same run) and "ratio"
// of the two.  All benches have the same ones because Google Benchmark's CSV has one header.
void report_cells(benchmark::State& state, double seconds, double cells, double floor_seconds,
                  double floor_cells);

// Reports a loop: make it before, stop() it after.  The floor is measured before and after the
// loop.
class Meter {
 public:
  Meter(benchmark::State& state, double cells_per_iteration);
  void stop();

 private:
  void measure_floor();

  benchmark::State& state_;
  double cells_per_iteration_;
  Floor floor_{1024};
  double floor_seconds_ = 0.0, floor_cells_ = 0.0;
  double begun_ = 0.0;
};

// The scenes that are benched: "open sea", "islands", "traffic" and, where a chart is installed,
// "Bergen".  Made once.
const std::vector<scenes::NamedScene>& bench_scenes();
// Requires a name among them.
const scenes::NamedScene& bench_scene(const std::string& name);

// How `named` is looked at, ray by ray.
echo::RayModel ray_model_of(const scenes::NamedScene& named);

void register_kernels();
void register_returns();
void register_scenes();
void register_coasts();

}  // namespace skerry::bench
