// Logs made up for tests.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <vector>

#include "protocol/nmea/ais_sentences.hpp"
#include "server/traffic_logs/track_book.hpp"

namespace skerry::server {

inline constexpr std::int64_t kLogBegin_s = 1'609'811'515;  // 2021-01-05T01:51:55Z

inline UtcTime log_time(double seconds) {
  return UtcTime(std::chrono::seconds(kLogBegin_s)) + seconds_as_duration(seconds);
}

inline std::string tag_block(double seconds) {
  const std::string tags =
      fmt::format("c:{}", kLogBegin_s * 1000 + static_cast<std::int64_t>(seconds * 1000));
  return "\\" + tags + "*" + nmea::checksum_text(tags) + "\\";
}

inline nmea::AisPosition position_of(std::uint32_t mmsi, double lat, double lon,
                                     bool class_b = false) {
  return {.mmsi = mmsi,
          .class_b = class_b,
          .status = 0,
          .speed_kn = 12.0,
          .position = GeoPoint{lat, lon},
          .course_deg = 0.0,
          .heading_deg = 1.0,
          .utc_second = 0};
}

// All lines of a message, each with a TAG block.
inline std::vector<std::string> logged(const nmea::AisMessage& message, double seconds,
                                       unsigned identifier = 0) {
  std::vector<std::string> lines;
  for (std::string line : nmea::encode_ais(message, false, identifier, 'A')) {
    line.erase(line.find('\r'));
    lines.push_back(tag_block(seconds) + line);
  }
  return lines;
}

inline HeardFix fix_at(std::uint32_t mmsi, double seconds, double lat, double lon) {
  return {.mmsi = mmsi, .utc = log_time(seconds), .position = GeoPoint{lat, lon}};
}

}  // namespace skerry::server
