// The AIS of a scenario, or of a recorded exercise, made without a network.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "server/traffic_logs/traffic_writer.hpp"

namespace skerry::server {

struct TrafficExport {
  TrafficForm form = TrafficForm::nmea;
  std::optional<Duration> every = {};  // whole seconds, instead of the intervals of AIS
  // Time 0; absent: 2026-01-01 for a scenario, when it was made for a recording.  Whole seconds.
  std::optional<UtcTime> begin = {};
  double minutes = 0.0;  // 0: the exercise's or the recording's length
  bool own_ships = false;
};

struct ExportedTraffic {
  std::uint64_t reports = 0;
  std::size_t ships = 0;
  double minutes = 0.0;
};

// `file`: as open_scenario() takes it, or a recording, which ends in ".mcap".  Nobody steers a
// scenario; a recorded exercise has its orders, and goes by its time on the air.
// Error: ConfigError, or std::runtime_error of a recording without its exercise.
ExportedTraffic export_traffic(const std::string& file, const TrafficExport& wanted,
                               const TrafficWriter::Sink& sink,
                               const std::function<void(double)>& progress);

}  // namespace skerry::server
