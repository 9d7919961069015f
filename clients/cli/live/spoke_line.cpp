#include "clients/cli/live/spoke_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "protocol/picture/label_text.hpp"

namespace skerry::client {
namespace {

template <typename T>
std::string or_dash(const std::optional<T>& value, const char* format, const char* none) {
  return value ? fmt::format(fmt::runtime(format), *value) : none;
}

std::string time_of_day_text(std::uint32_t in_128ths) {
  const std::uint32_t seconds = in_128ths / 128;
  return fmt::format("{:02}:{:02}:{:02}.{:03}Z", seconds / 3600, seconds / 60 % 60, seconds % 60,
                     in_128ths % 128 * 1000 / 128);
}

}  // namespace

SpokeLine line_of(Spoke spoke) {
  const SpokeHeader& header = spoke.header;
  return {.sequence = header.sequence,
          .scan = header.scan,
          .index = header.index,
          .azimuth_deg = header.bearing().in_degrees(),
          .heading_deg = header.heading.in_degrees(),
          .range_nm = header.range_scale.in_nautical_miles(),
          .cell_size_m = header.cell_size().in_metres(),
          .utc = utc_text(header.utc),
          .cells = std::move(spoke.cells)};
}

SpokeLine line_of(Cat240Video video, std::optional<std::uint32_t> time_of_day) {
  const Length far = video.cell_size() * (double{1} * video.start_range + video.cell_count);
  return {.sequence = video.message_index,
          .scan = std::nullopt,
          .index = std::nullopt,
          .azimuth_deg = video.start_azimuth * (360.0 / 65536.0),
          .heading_deg = std::nullopt,
          .range_nm = far.in_nautical_miles(),
          .cell_size_m = video.cell_size().in_metres(),
          .utc = time_of_day ? time_of_day_text(*time_of_day) : "",
          .cells = std::move(video.cells)};
}

std::string heading_line(LineFormat format) {
  switch (format) {
    case LineFormat::text:
      return fmt::format("# {:>8} {:>6} {:>5} {:>9} {:>9} {:>8} {:>9} {:>7} {:>4}  {}\n",
                         "sequence", "scan", "index", "azimuth", "heading", "range_nm", "cell_m",
                         "nonzero", "max", "utc");
    case LineFormat::csv:
      return "sequence,scan,index,azimuth_deg,heading_deg,range_nm,cell_m,nonzero,max,utc\n";
    case LineFormat::hex:
      return "sequence,scan,index,azimuth_deg,heading_deg,range_nm,cell_m,nonzero,max,utc,cells\n";
  }
  return {};
}

std::string format_line(const SpokeLine& line, LineFormat format) {
  const auto zeros = std::count(line.cells.begin(), line.cells.end(), 0);
  const auto nonzero = static_cast<std::ptrdiff_t>(line.cells.size()) - zeros;
  const int max = line.cells.empty() ? 0 : *std::max_element(line.cells.begin(), line.cells.end());
  if (format == LineFormat::text) {
    return fmt::format("{:>10} {:>6} {:>5} {:>9.4f} {:>9} {:>8.4g} {:>9.3f} {:>7} {:>4}  {}\n",
                       line.sequence, or_dash(line.scan, "{}", "-"), or_dash(line.index, "{}", "-"),
                       line.azimuth_deg, or_dash(line.heading_deg, "{:.4f}", "-"), line.range_nm,
                       line.cell_size_m, nonzero, max, line.utc);
  }
  std::string out = fmt::format("{},{},{},{:.6f},{},{:.6g},{:.6f},{},{},{}", line.sequence,
                                or_dash(line.scan, "{}", ""), or_dash(line.index, "{}", ""),
                                line.azimuth_deg, or_dash(line.heading_deg, "{:.6f}", ""),
                                line.range_nm, line.cell_size_m, nonzero, max, line.utc);
  if (format == LineFormat::hex) {
    out += ',';
    out.reserve(out.size() + 2 * line.cells.size() + 1);
    for (const std::uint8_t cell : line.cells)
      fmt::format_to(std::back_inserter(out), "{:02x}", cell);
  }
  out += '\n';
  return out;
}

}  // namespace skerry::client
