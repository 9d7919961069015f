#include "tests/scenes/charts.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::scenes {
namespace {

GeoPoint at(GeoPoint centre, double bearing_deg, double metres) {
  GeoPoint p;
  GeographicLib::Geodesic::WGS84().Direct(centre.latitude_deg, centre.longitude_deg, bearing_deg,
                                          metres, p.latitude_deg, p.longitude_deg);
  // To 1 cm: the geodesic's last bits are libm's and differ from machine to machine.
  p.latitude_deg = std::round(p.latitude_deg * 1e7) * 1e-7;
  p.longitude_deg = std::round(p.longitude_deg * 1e7) * 1e-7;
  return p;
}

void close(echo::CoastRing& ring, std::uint64_t identity) {
  const std::size_t n = ring.vertices.size();
  ring.edges.assign(n, echo::EdgeKind::shoreline);
  for (std::size_t i = 0; i < n; ++i) ring.vertex_ids.push_back(echo::mixed(identity, i));
}

}  // namespace

echo::CoastChart made_up_chart(GeoPoint centre, Length radius, int islands, std::uint64_t seed) {
  echo::CoastChart chart;
  chart.centre = centre;
  chart.radius_m = radius.in_metres();
  chart.source = "made up";
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < islands; ++i) {
    const double bearing = 360.0 * unit(random);
    const double distance = 400.0 + (0.9 * radius.in_metres() - 400.0) * unit(random);
    const double size = std::min(0.4 * distance, 60.0 + 900.0 * unit(random) * unit(random));
    const GeoPoint middle = at(centre, bearing, distance);
    const int corners = 7 + static_cast<int>(20 * unit(random));
    echo::CoastRing ring;
    // Counter-clockwise: land on the left.
    for (int k = 0; k < corners; ++k) {
      ring.vertices.push_back(at(middle, -360.0 * k / corners, size * (0.6 + 0.4 * unit(random))));
    }
    close(ring, echo::mixed(seed, static_cast<std::uint64_t>(i)));
    chart.rings.push_back(std::move(ring));
  }
  return chart;
}

std::optional<echo::CoastChart> world_chart(GeoPoint centre, Length radius) {
  std::filesystem::path file;
  try {
    file = echo::GshhgReader::find_finest();
  } catch (const std::runtime_error&) {
    return std::nullopt;  // not installed; what is wrong with an installed one fails the test
  }
  return echo::GshhgReader::open(file).load(centre, radius);
}

}  // namespace skerry::scenes
