// SpokeLine: one spoke as `skerry dump` writes it, whatever protocol it came by.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/asterix/cat240.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry::client {

enum class LineFormat : std::uint8_t { text, csv, hex };

struct SpokeLine {
  std::uint64_t sequence = 0;         // CAT240: message index
  std::optional<std::uint32_t> scan;  // what CAT240 does not know is not there
  std::optional<std::uint32_t> index;
  double azimuth_deg = 0.0;  // true
  std::optional<double> heading_deg;
  double range_nm = 0.0;  // far end of the last cell
  double cell_size_m = 0.0;
  std::string utc;  // CAT240: time of day
  std::vector<std::uint8_t> cells;
};

SpokeLine line_of(Spoke spoke);
// The azimuth is the record's start, where skerryd puts a spoke's own bearing.
SpokeLine line_of(Cat240Video video, std::optional<std::uint32_t> time_of_day);

// Each ends in a line feed.
std::string heading_line(LineFormat format);
std::string format_line(const SpokeLine& line, LineFormat format);

}  // namespace skerry::client
