// The calls of skerry_echo.h on coasts.
#include <fmt/format.h>

#include <algorithm>

#include "echo/capi/coast.hpp"
#include "echo/capi/held.hpp"
#include "protocol/video/scan_geometry.hpp"

namespace {

using namespace skerry::echo::capi;
using skerry::echo::CoastMethod;
using skerry::echo::CoastPicture;
using skerry::echo::CoastRules;
using skerry::echo::CoastStyle;
using skerry::echo::CoastType;
using skerry::echo::SeriesPhases;

// The interface's numbers are the enumerations'.
static_assert(SKERRY_ECHO_METHOD_STRAIGHT == static_cast<int>(CoastMethod::straight));
static_assert(SKERRY_ECHO_METHOD_REGULAR_KOCH == static_cast<int>(CoastMethod::regular_koch));
static_assert(SKERRY_ECHO_METHOD_RANDOM_KOCH == static_cast<int>(CoastMethod::random_koch));
static_assert(SKERRY_ECHO_METHOD_MIDPOINT == static_cast<int>(CoastMethod::midpoint));
static_assert(SKERRY_ECHO_METHOD_WEIERSTRASS == static_cast<int>(CoastMethod::weierstrass));
static_assert(SKERRY_ECHO_PHASES_COSINE == static_cast<int>(SeriesPhases::cosine));
static_assert(SKERRY_ECHO_PHASES_ALTERNATING == static_cast<int>(SeriesPhases::alternating));
static_assert(SKERRY_ECHO_PHASES_RANDOM == static_cast<int>(SeriesPhases::random));
static_assert(SKERRY_ECHO_COAST_UNKNOWN == static_cast<int>(CoastType::unknown));
static_assert(SKERRY_ECHO_COAST_ARTIFICIAL == static_cast<int>(CoastType::artificial));
static_assert(SKERRY_ECHO_COAST_ROCKY == static_cast<int>(CoastType::rocky));
static_assert(SKERRY_ECHO_COAST_SANDY == static_cast<int>(CoastType::sandy));
// Layouts of version 1.0, which never change.
static_assert(sizeof(skerry_echo_position) == 16 && sizeof(skerry_echo_plane_point) == 16);
static_assert(sizeof(skerry_echo_style) == 40 && sizeof(skerry_echo_picture) == 64);

std::size_t type_index(std::int32_t type) {
  require_choice("type", type, SKERRY_ECHO_COAST_UNKNOWN, SKERRY_ECHO_COAST_SANDY);
  return static_cast<std::size_t>(type);
}

skerry_echo_style default_style(std::size_t type) {
  const CoastStyle style = CoastRules{}.styles[type];
  return {sizeof(skerry_echo_style),
          static_cast<std::int32_t>(style.method),
          static_cast<std::int32_t>(style.phases),
          0,
          style.dimension,
          style.amplitude,
          style.gamma};
}

CoastStyle style_of(const skerry_echo_style* given, std::size_t type) {
  const skerry_echo_style style = from_caller("style", given, default_style(type));
  require_choice("style.method", style.method, 0,
                 static_cast<std::int64_t>(skerry::echo::coast_methods().size()) - 1);
  require_choice("style.phases", style.phases, SKERRY_ECHO_PHASES_COSINE,
                 SKERRY_ECHO_PHASES_RANDOM);
  require_choice("style.reserved", style.reserved, 0, 0);
  const CoastStyle out{.method = static_cast<CoastMethod>(style.method),
                       .dimension = style.dimension,
                       .amplitude = style.amplitude,
                       .gamma = style.gamma,
                       .phases = static_cast<SeriesPhases>(style.phases)};
  require_valid(out);
  return out;
}

// Copies what `element(i)` gives for the `needed` elements of a picture's array.
template <typename T, typename Element>
void copy_out(std::size_t needed, T* out, std::size_t capacity, std::size_t* count,
              Element&& element) {
  require_room(needed, out, capacity, count);
  if (!out) return;
  for (std::size_t i = 0; i < needed; ++i) out[i] = element(i);
}

}  // namespace

extern "C" {

int32_t skerry_echo_style_defaults(int32_t type, skerry_echo_style* style, size_t size) {
  return guarded([&] { to_caller("style", style, size, default_style(type_index(type))); });
}

int32_t skerry_echo_coast_create(skerry_echo_chart* chart, uint64_t seed,
                                 skerry_echo_coast** coast) {
  return guarded([&] {
    auto shared = HandleTable::global().find<SharedChart>("chart", chart);
    require_pointer("coast", coast);
    give(std::make_shared<Coast>(std::move(shared), seed), coast);
  });
}

int32_t skerry_echo_coast_set_style(skerry_echo_coast* coast, int32_t type,
                                    const skerry_echo_style* style) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    const std::size_t index = type_index(type);
    CoastRules rules = held->rules();
    rules.styles[index] = style_of(style, index);
    held->set_rules(rules);
  });
}

int32_t skerry_echo_coast_set_guessing(skerry_echo_coast* coast, int32_t guess) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    require_choice("guess", guess, 0, 1);
    CoastRules rules = held->rules();
    rules.guess_types = guess == 1;
    held->set_rules(rules);
  });
}

int32_t skerry_echo_coast_add_place(skerry_echo_coast* coast, double latitude_deg,
                                    double longitude_deg, double radius_m, int32_t type,
                                    const skerry_echo_style* style) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    skerry::echo::CoastPlace place;
    place.centre = place_of(latitude_deg, longitude_deg);
    require_range("radius_m", radius_m, 10.0, 200'000.0);
    place.radius_m = radius_m;
    require_choice("type", type, SKERRY_ECHO_COAST_AS_CHARTED, SKERRY_ECHO_COAST_SANDY);
    if (type != SKERRY_ECHO_COAST_AS_CHARTED) place.type = static_cast<CoastType>(type);
    if (style) {
      place.style = style_of(
          style, static_cast<std::size_t>(std::max<std::int32_t>(type, SKERRY_ECHO_COAST_UNKNOWN)));
    }
    CoastRules rules = held->rules();
    if (rules.places.size() >= Coast::kMostPlaces) {
      throw CallError(
          SKERRY_ECHO_ERROR_SIZE,
          fmt::format("the coast has {} places, which is the most", Coast::kMostPlaces));
    }
    rules.places.push_back(place);
    held->set_rules(rules);
  });
}

int32_t skerry_echo_coast_refine(skerry_echo_coast* coast, double latitude_deg,
                                 double longitude_deg, double range_m, double cell_m,
                                 double spoke_deg) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    const skerry::GeoPoint place = place_of(latitude_deg, longitude_deg);
    require_range("range_m", range_m, 200.0, 200'000.0);
    require_range("cell_m", cell_m, range_m / skerry::ScanGeometry::kMaxCells, range_m / 16.0);
    require_range("spoke_deg", spoke_deg, 360.0 / skerry::ScanGeometry::kMaxSpokes, 5.0);
    held->refine(place, {range_m, cell_m, spoke_deg});
  });
}

int32_t skerry_echo_coast_picture(skerry_echo_coast* coast, skerry_echo_picture* picture) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    const CoastPicture& made = held->picture();
    const skerry::GeoPoint anchor = made.plane.anchor();
    to_caller("picture", picture,
              skerry_echo_picture{sizeof(skerry_echo_picture), made.centre_ashore ? 1 : 0,
                                  made.vertices.size(), made.run_starts.size() - 1,
                                  anchor.latitude_deg, anchor.longitude_deg, made.centre.east_m,
                                  made.centre.north_m, made.range_m});
  });
}

int32_t skerry_echo_coast_runs(skerry_echo_coast* coast, uint32_t* out, size_t capacity,
                               size_t* count) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    const CoastPicture& made = held->picture();
    copy_out(made.run_starts.size(), out, capacity, count,
             [&](std::size_t i) { return made.run_starts[i]; });
  });
}

int32_t skerry_echo_coast_plane_vertices(skerry_echo_coast* coast, skerry_echo_plane_point* out,
                                         size_t capacity, size_t* count) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    const CoastPicture& made = held->picture();
    copy_out(made.vertices.size(), out, capacity, count, [&](std::size_t i) {
      return skerry_echo_plane_point{made.vertices[i].east_m, made.vertices[i].north_m};
    });
  });
}

int32_t skerry_echo_coast_geo_vertices(skerry_echo_coast* coast, skerry_echo_position* out,
                                       size_t capacity, size_t* count) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    const CoastPicture& made = held->picture();
    copy_out(made.vertices.size(), out, capacity, count, [&](std::size_t i) {
      const skerry::GeoPoint place = made.plane.to_geo(made.vertices[i]);
      return skerry_echo_position{place.latitude_deg, place.longitude_deg};
    });
  });
}

int32_t skerry_echo_coast_edge_types(skerry_echo_coast* coast, uint8_t* out, size_t capacity,
                                     size_t* count) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    const CoastPicture& made = held->picture();
    copy_out(made.vertices.size(), out, capacity, count, [&](std::size_t i) {
      const auto& shore = made.shores[made.shore_of(static_cast<std::uint32_t>(i))];
      return shore.seam ? std::uint8_t{SKERRY_ECHO_COAST_SEAM}
                        : static_cast<std::uint8_t>(shore.type);
    });
  });
}

int32_t skerry_echo_coast_destroy(skerry_echo_coast* coast) {
  return guarded([&] {
    if (!coast) return;
    const Held<Coast> held("coast", coast);
    HandleTable::global().remove(coast);
  });
}

}  // extern "C"
