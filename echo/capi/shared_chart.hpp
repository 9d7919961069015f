// SharedChart: an opened chart that any number of coasts and threads use.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "echo/capi/call.hpp"
#include "echo/chart/chart_source.hpp"

namespace skerry::echo::capi {

// Texts of a chart's exceptions are for people already; this adds their codes.
template <typename Body>
auto reading_chart(Body&& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw CallError(SKERRY_ECHO_ERROR_CHART, error.what());
  }
}

// Thread: any; one reads at a time.
class SharedChart {
 public:
  SharedChart(std::unique_ptr<const ChartSource> source, std::string warnings);

  const std::string& name() const { return name_; }
  // The unusable parts of its files, a line each.
  const std::string& warnings() const { return warnings_; }
  // Error: CallError CHART, as ChartSource::load() words it.
  CoastChart load(GeoPoint centre, Length radius) const;
  // Decides by the chart's straight edges.  Keeps the window last used.
  bool is_land(GeoPoint place) const;

 private:
  // A window serves places within half its radius.
  static constexpr double kWindowMetres = 12.0 * Length::kMetresPerNauticalMile;

  std::unique_ptr<const ChartSource> source_;
  std::string name_;
  std::string warnings_;
  mutable std::mutex reading_;  // source_
  mutable std::mutex looking_;  // window_
  mutable std::optional<CoastChart> window_;
};

// Charts and elevations by their files, each over those after it.
// Error: CallError CHART, naming the file.
std::shared_ptr<SharedChart> open_shared_chart(
    const std::vector<std::filesystem::path>& charts,
    const std::vector<std::filesystem::path>& elevations);

// Closed rings, land on the left, of shores of that type (empty: all unknown).
// Error: CallError ARGUMENT, naming ring and vertex.
std::shared_ptr<SharedChart> shared_chart_from_rings(std::span<const skerry_echo_position> vertices,
                                                     std::span<const std::size_t> ring_sizes,
                                                     std::span<const std::int32_t> ring_types);

}  // namespace skerry::echo::capi
