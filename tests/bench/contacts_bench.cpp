// What looking for collisions costs: 20 own ships among 500 targets.
#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <string>
#include <vector>

#include "server/world/contacts.hpp"
#include "server/world/scenario.hpp"
#include "server/world/world.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;

// Ships at random within so many miles of each other.
scenario::Scenario fleet(double miles, int own_ships, int targets) {
  std::string yaml = "name: Fleet\nseed: 1\nown_ships:\n";
  std::uint64_t state = 12345;
  const auto random = [&](double from, double to) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return from + (to - from) * static_cast<double>(state >> 11) * 0x1p-53;
  };
  const auto place = [&] {
    return fmt::format("position: {{lat: {}, lon: {}}}, course_deg: {}, speed_kn: {}",
                       50.0 + random(0.0, miles / 60.0), 10.0 + random(0.0, miles / 40.0),
                       random(0.0, 360.0), random(0.0, 20.0));
  };
  for (int i = 0; i < own_ships; ++i) {
    yaml += fmt::format("  - {{name: Own {}, {}, radars: [{{}}]}}\n", i, place());
  }
  yaml += "targets:\n";
  for (int i = 0; i < targets; ++i) yaml += fmt::format("  - {{name: T {}, {}}}\n", i, place());
  return parse_scenario(yaml, "fleet.yaml");
}

void look(benchmark::State& bench) {
  const scenario::Scenario scenario = fleet(static_cast<double>(bench.range(0)), 20, 500);
  World world(scenario);
  const Traffic traffic(scenario);
  std::vector<ShipState> own = world.state().own_ships;
  Contacts contacts;
  std::size_t found = 0;
  for (auto _ : bench) {
    found += contacts.look(World::kTick, World::kTick, own, traffic).size();
  }
  bench.counters["contacts"] = static_cast<double>(found);
}
BENCHMARK(look)->Arg(60)->Arg(20)->Arg(5)->Unit(benchmark::kMicrosecond);

void step(benchmark::State& bench) {
  World world(fleet(static_cast<double>(bench.range(0)), 20, 500));
  for (auto _ : bench) world.step();
}
BENCHMARK(step)->Arg(20)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
