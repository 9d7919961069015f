// The echo of one ray: all rays of a turn are one iteration, and ns/cell is per cell of a ray.
// These scenes have one ray per spoke.
#include "echo/radar/radar_equation.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/returns/land_returns.hpp"
#include "protocol/quantity/bearing.hpp"
#include "tests/bench/bench_support.hpp"

namespace skerry::bench {
namespace {

using scenes::NamedScene;

double cells_per_turn(const echo::RayModel& model) {
  return static_cast<double>(model.rays_per_turn) * model.cells;
}

std::string rays_label(const echo::RayModel& model) {
  return std::to_string(model.rays_per_turn) + " rays";
}

std::uint32_t ray_units(std::uint32_t ray, const echo::RayModel& model) {
  return RelativeBearing::of_spoke(ray, model.rays_per_turn).units();
}

void bench_crossings(benchmark::State& state, const NamedScene& named) {
  const echo::RayModel model = ray_model_of(named);
  const echo::Scene& scene = *named.scene;
  std::vector<echo::Crossing> crossings;
  std::vector<echo::LandInterval> land;
  std::size_t found = 0;
  Meter meter(state, cells_per_turn(model));
  for (auto _ : state) {
    found = 0;
    for (std::uint32_t ray = 0; ray < model.rays_per_turn; ++ray) {
      echo::find_crossings(*scene.coast, *scene.index, {scene.own_ship, ray_units(ray, model)},
                           crossings);
      echo::land_along(crossings, scene.ashore, model.cell_m * model.cells, land);
      benchmark::DoNotOptimize(land.data());
      found += crossings.size();
    }
  }
  meter.stop();
  state.SetLabel(rays_label(model) + " " + std::to_string(found) + " crossings");
}

void bench_add_land(benchmark::State& state, const NamedScene& named) {
  const echo::RayModel model = ray_model_of(named);
  const echo::Scene& scene = *named.scene;
  const echo::LandModel land{model.cell_m, model.set.antenna_height_m, 0.00077,
                             echo::unit_signal_to_noise(model.set, model.pulse), 7};
  std::vector<std::vector<echo::LandInterval>> ashore(model.rays_per_turn);
  std::vector<echo::Crossing> crossings;
  for (std::uint32_t ray = 0; ray < model.rays_per_turn; ++ray) {
    echo::find_crossings(*scene.coast, *scene.index, {scene.own_ship, ray_units(ray, model)},
                         crossings);
    echo::land_along(crossings, scene.ashore, model.cell_m * model.cells, ashore[ray]);
  }
  std::vector<float> power(model.cells);
  Meter meter(state, cells_per_turn(model));
  for (auto _ : state) {
    for (std::uint32_t ray = 0; ray < model.rays_per_turn; ++ray) {
      echo::add_land(
          ashore[ray], land,
          echo::lattice_path(scene.own_ship_geo, {}, ray_units(ray, model), model.cell_m), power);
      benchmark::DoNotOptimize(power.data());
    }
  }
  meter.stop();
  state.SetLabel(rays_label(model));
}

void bench_ray_returns(benchmark::State& state, const NamedScene& named) {
  const echo::RayModel model = ray_model_of(named);
  echo::RayScratch scratch;
  std::vector<float> power(model.cells);
  Meter meter(state, cells_per_turn(model));
  for (auto _ : state) {
    for (std::uint32_t ray = 0; ray < model.rays_per_turn; ++ray) {
      echo::ray_returns(*named.scene, model, ray_units(ray, model), 0.1, scratch, power);
      benchmark::DoNotOptimize(power.data());
    }
  }
  meter.stop();
  state.SetLabel(rays_label(model));
}

}  // namespace

// Code without a kernel is the same for every instruction set, and measured once.
void register_returns() {
  constexpr auto kMs = benchmark::kMillisecond;
  for (const NamedScene& named : bench_scenes()) {
    const auto on = [&named](auto bench) {
      return [bench, &named](benchmark::State& state) { bench(state, named); };
    };
    const bool land = named.scene->coast->edge_count() > 0;
    if (land) {
      register_once("find_crossings+land_along/" + named.name, on(bench_crossings), kMs);
      register_per_isa("add_land/" + named.name, on(bench_add_land), kMs);
    }
    register_per_isa("ray_returns/" + named.name, on(bench_ray_returns), kMs);
  }
}

}  // namespace skerry::bench
