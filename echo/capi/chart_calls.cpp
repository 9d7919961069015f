// The calls of skerry_echo.h on the library itself and on charts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "echo/capi/held.hpp"
#include "echo/capi/shared_chart.hpp"

namespace {

using namespace skerry::echo::capi;

constexpr std::size_t kMostCharts = 1024, kMostElevations = 64;
constexpr std::size_t kMostVertices = 20'000'000;

std::shared_ptr<SharedChart> found(const skerry_echo_chart* chart) {
  return HandleTable::global().find<SharedChart>("chart", chart);
}

std::vector<std::filesystem::path> paths_of(const char* name, const char* const* paths,
                                            std::size_t count) {
  if (count > 0) require_pointer(name, paths);
  std::vector<std::filesystem::path> out;
  for (std::size_t i = 0; i < count; ++i) {
    of_part([&] { return fmt::format("{}[{}]", name, i); },
            [&] { require_pointer("the path", paths[i]); });
    out.emplace_back(paths[i]);
  }
  return out;
}

void copy_text(const std::string& from, char* text, std::size_t capacity, std::size_t* size) {
  require_room(from.size() + 1, text, capacity, size);
  if (text) std::copy_n(from.c_str(), from.size() + 1, text);
}

}  // namespace

extern "C" {

uint32_t skerry_echo_version(void) {
  return SKERRY_ECHO_VERSION_MAJOR << 16 | SKERRY_ECHO_VERSION_MINOR << 8 |
         SKERRY_ECHO_VERSION_PATCH;
}

const char* skerry_echo_version_text(void) { return SKERRY_ECHO_VERSION_TEXT; }

const char* skerry_echo_last_error(void) { return last_error(); }

const char* skerry_echo_result_name(int32_t result) {
  constexpr std::array<const char*, 9> kNames = {"OK",    "ARGUMENT", "HANDLE", "BUSY",    "SIZE",
                                                 "STATE", "CHART",    "MEMORY", "INTERNAL"};
  if (result < 0 || result >= static_cast<int32_t>(kNames.size())) return "UNKNOWN";
  return kNames[static_cast<std::size_t>(result)];
}

int32_t skerry_echo_chart_open(const char* const* paths, size_t count,
                               const char* const* elevations, size_t elevation_count,
                               skerry_echo_chart** chart) {
  return guarded([&] {
    require_pointer("chart", chart);
    require_range("count", std::uint64_t{count}, 1, kMostCharts);
    require_range("elevation_count", std::uint64_t{elevation_count}, 0, kMostElevations);
    give(open_shared_chart(paths_of("paths", paths, count),
                           paths_of("elevations", elevations, elevation_count)),
         chart);
  });
}

int32_t skerry_echo_chart_from_rings(const skerry_echo_position* vertices, size_t vertex_count,
                                     const size_t* ring_sizes, const int32_t* ring_types,
                                     size_t ring_count, skerry_echo_chart** chart) {
  return guarded([&] {
    require_pointer("chart", chart);
    require_range("vertex_count", std::uint64_t{vertex_count}, 0, kMostVertices);
    require_range("ring_count", std::uint64_t{ring_count}, 0, vertex_count / 3);
    if (vertex_count > 0) require_pointer("vertices", vertices);
    if (ring_count > 0) require_pointer("ring_sizes", ring_sizes);
    std::size_t left = vertex_count;
    for (std::size_t r = 0; r < ring_count; ++r) {
      of_part([&] { return fmt::format("ring {}", r); },
              [&] {
                require_range("its ring_sizes", std::uint64_t{ring_sizes[r]}, 3, left);
                left -= ring_sizes[r];
                if (!ring_types) return;
                require_choice("its ring_types", ring_types[r], SKERRY_ECHO_COAST_UNKNOWN,
                               SKERRY_ECHO_COAST_SANDY);
              });
    }
    if (left > 0) {
      throw CallError(SKERRY_ECHO_ERROR_SIZE,
                      fmt::format("vertex_count is {}, the sum of ring_sizes {}; expected the same",
                                  vertex_count, vertex_count - left));
    }
    give(shared_chart_from_rings({vertices, vertex_count}, {ring_sizes, ring_count},
                                 {ring_types, ring_types ? ring_count : 0}),
         chart);
  });
}

int32_t skerry_echo_chart_describe(skerry_echo_chart* chart, char* text, size_t capacity,
                                   size_t* size) {
  return guarded([&] { copy_text(found(chart)->name(), text, capacity, size); });
}

int32_t skerry_echo_chart_warnings(skerry_echo_chart* chart, char* text, size_t capacity,
                                   size_t* size) {
  return guarded([&] { copy_text(found(chart)->warnings(), text, capacity, size); });
}

int32_t skerry_echo_chart_is_land(skerry_echo_chart* chart, double latitude_deg,
                                  double longitude_deg, int32_t* land) {
  return guarded([&] {
    const auto shared = found(chart);
    const skerry::GeoPoint place = place_of(latitude_deg, longitude_deg);
    require_pointer("land", land);
    *land = shared->is_land(place) ? 1 : 0;
  });
}

int32_t skerry_echo_chart_destroy(skerry_echo_chart* chart) {
  return guarded([&] {
    if (!chart) return;
    static_cast<void>(found(chart));
    HandleTable::global().remove(chart);
  });
}

}  // extern "C"
