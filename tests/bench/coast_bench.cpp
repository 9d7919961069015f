// From the chart to a coast that rays can meet: what happens when the own ship has sailed on or the
// range scale is changed, off the radar's thread.
#include <algorithm>
#include <exception>
#include <optional>

#include "echo/chart/gshhg_reader.hpp"
#include "tests/bench/bench_support.hpp"

namespace skerry::bench {
namespace {

// The server asks for so much: a quarter more than the range and the way to the plane's end, at
// least 12 NM.
Length window_radius(RangeScale scale) {
  return metres(
      std::max(1.25 * scale.length().in_metres() + echo::CoastPreparer::kMaxAnchorDistance,
               nautical_miles(12.0).in_metres()));
}

echo::RadarResolution resolution_of(RangeScale scale) {
  const ScanGeometry geometry;
  return {scale.length().in_metres(), geometry.cell_size(scale).in_metres(),
          360.0 / geometry.spokes_per_turn};
}

std::string vertices_label(const echo::CoastChart& chart) {
  std::size_t vertices = 0;
  for (const echo::CoastRing& ring : chart.rings) vertices += ring.vertices.size();
  return std::to_string(vertices) + " chart vertices";
}

// Chart windows are read once each, and only when a bench that is run wants one.
struct Window {
  RangeScale scale;
  std::optional<echo::CoastChart> loaded;
  const echo::CoastChart& chart() {
    if (!loaded) loaded = scenes::world_chart(scenes::kBergen, window_radius(scale)).value();
    return *loaded;
  }
  echo::CoastPreparer preparer() { return {chart(), scenes::kBergen, echo::CoastRules{.seed = 1}}; }
};

void bench_load(benchmark::State& state, const echo::GshhgReader& reader, Window& window) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(reader.load(scenes::kBergen, window_radius(window.scale)));
  }
  state.SetLabel(vertices_label(window.chart()));
}

void bench_lay(benchmark::State& state, Window& window) {
  const echo::CoastChart& chart = window.chart();
  for (auto _ : state) {
    echo::CoastChart copy = chart;
    const double begun = thread_seconds();
    const echo::CoastPreparer preparer(std::move(copy), scenes::kBergen,
                                       echo::CoastRules{.seed = 1});
    benchmark::DoNotOptimize(&preparer);
    state.SetIterationTime(thread_seconds() - begun);
  }
  state.SetLabel(vertices_label(chart));
}

void bench_prepare(benchmark::State& state, Window& window) {
  echo::CoastPreparer preparer = window.preparer();
  echo::CoastPicturePtr picture;
  for (auto _ : state) {
    picture = preparer.prepare(scenes::kBergen, resolution_of(window.scale));
  }
  state.SetLabel(std::to_string(picture->edge_count()) + " edges");
}

void bench_index(benchmark::State& state, Window& window) {
  const auto picture = window.preparer().prepare(scenes::kBergen, resolution_of(window.scale));
  const PlanePoint own_ship = picture->plane.to_plane(scenes::kBergen);
  const double slack = std::max(10.0, picture->range_m / 400.0);
  for (auto _ : state) {
    const echo::PolarIndex index(*picture, own_ship, slack);
    benchmark::DoNotOptimize(index.near_edges().data());
  }
  state.SetLabel(std::to_string(picture->edge_count()) + " edges");
}

}  // namespace

void register_coasts() {
  std::shared_ptr<const echo::GshhgReader> reader;
  try {
    reader = std::make_shared<echo::GshhgReader>(
        echo::GshhgReader::open(echo::GshhgReader::find_finest()));
  } catch (const std::exception&) {
    return;  // no chart, no coast of Bergen
  }
  constexpr auto kMs = benchmark::kMillisecond;
  for (const double nm : {0.75, 6.0, 24.0, 96.0}) {
    const auto window = std::make_shared<Window>(Window{*RangeScale::find(nm), std::nullopt});
    std::string miles = std::to_string(nm);
    miles.erase(miles.find_last_not_of("0.") + 1);
    const std::string at = "/Bergen " + miles + " NM";
    register_once(
        "load the chart" + at, [=](benchmark::State& s) { bench_load(s, *reader, *window); }, kMs);
    register_once(
        "lay into the plane" + at, [=](benchmark::State& s) { bench_lay(s, *window); }, kMs, true);
    register_once(
        "refine" + at, [=](benchmark::State& s) { bench_prepare(s, *window); }, kMs);
    register_once(
        "index" + at, [=](benchmark::State& s) { bench_index(s, *window); }, kMs);
  }
}

}  // namespace skerry::bench
