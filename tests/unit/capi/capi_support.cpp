#include "tests/unit/capi/capi_support.hpp"

#include <cmath>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/kernel/hash.hpp"
#include "tests/scenes/charts.hpp"

namespace skerry::capi_test {

Rings islands(Length radius, int count, std::uint64_t seed) {
  Rings rings;
  for (const echo::CoastRing& ring : scenes::made_up_chart(kAfloat, radius, count, seed).rings) {
    for (const GeoPoint p : ring.vertices) {
      rings.vertices.push_back(
          {std::round(p.latitude_deg * 1e7) / 1e7, std::round(p.longitude_deg * 1e7) / 1e7});
    }
    rings.sizes.push_back(ring.vertices.size());
  }
  return rings;
}

Chart chart_of(const Rings& rings) {
  Chart chart;
  EXPECT_OK(skerry_echo_chart_from_rings(rings.vertices.data(), rings.vertices.size(),
                                         rings.sizes.data(), nullptr, rings.sizes.size(),
                                         chart.out()));
  return chart;
}

echo::CoastChart coast_chart_of(const Rings& rings, GeoPoint centre, double radius_m) {
  echo::CoastChart chart;
  chart.centre = centre;
  chart.radius_m = radius_m;
  std::size_t next = 0;
  for (const std::size_t size : rings.sizes) {
    echo::CoastRing ring;
    for (std::size_t i = 0; i < size; ++i, ++next) {
      const skerry_echo_position p = rings.vertices[next];
      ring.vertices.push_back({p.latitude_deg, p.longitude_deg});
      ring.vertex_ids.push_back(
          echo::mixed(static_cast<std::uint64_t>(std::llround(p.latitude_deg * 1e7)),
                      static_cast<std::uint64_t>(std::llround(p.longitude_deg * 1e7))));
    }
    ring.edges.assign(size, echo::EdgeKind::shoreline);
    chart.rings.push_back(std::move(ring));
  }
  return chart;
}

bool world_installed() {
  try {
    static_cast<void>(echo::GshhgReader::find_finest());
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

int32_t open_chart(const std::string& path, Chart& chart) {
  const char* const paths[] = {path.c_str()};
  return skerry_echo_chart_open(paths, 1, nullptr, 0, chart.out());
}

Coast coast_of(skerry_echo_chart* chart, std::uint64_t seed) {
  Coast coast;
  EXPECT_OK(skerry_echo_coast_create(chart, seed, coast.out()));
  return coast;
}

skerry_echo_radar_options small_options() {
  skerry_echo_radar_options options;
  EXPECT_OK(skerry_echo_radar_defaults(&options, sizeof options));
  options.spokes_per_turn = 512;
  options.cells = 256;
  return options;
}

Radar radar_of(skerry_echo_coast* coast, const skerry_echo_radar_options& options) {
  Radar radar;
  EXPECT_OK(skerry_echo_radar_create(coast, &options, radar.out()));
  return radar;
}

skerry_echo_own_ship own_ship_at(GeoPoint place) {
  skerry_echo_own_ship ship;
  EXPECT_OK(skerry_echo_own_ship_defaults(&ship, sizeof ship));
  ship.latitude_deg = place.latitude_deg;
  ship.longitude_deg = place.longitude_deg;
  return ship;
}

skerry_echo_target target_at(GeoPoint place, std::uint64_t identity) {
  skerry_echo_target target;
  EXPECT_OK(skerry_echo_target_defaults(&target, sizeof target));
  target.identity = identity;
  target.latitude_deg = place.latitude_deg;
  target.longitude_deg = place.longitude_deg;
  return target;
}

}  // namespace skerry::capi_test
