#include "protocol/wire/spoke_message.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace skerry {
namespace {

// Radar and view numbers fit the 16 bits that datagrams give them.
constexpr std::uint32_t kMaxNumber = std::numeric_limits<std::uint16_t>::max();

// Relative difference allowed between the stated cell size and what it should be; far above the
// rounding of any sender's arithmetic, far below the difference between two scales.
constexpr double kCellSizeTolerance = 1e-6;

Failure<WireError> out_of_range(std::string_view field, double value, std::string_view expected) {
  return Failure{WireError{WireErrorKind::out_of_range, 0,
                           fmt::format("spoke: {} is {}, expected {}", field, value, expected)}};
}

void pack(const std::vector<std::uint8_t>& cells, std::string& bytes) {
  bytes.resize((cells.size() + 1) / 2);
  const std::size_t pairs = cells.size() / 2;
  for (std::size_t i = 0; i < pairs; ++i) {
    bytes[i] = static_cast<char>((cells[2 * i] & 0x0F) | cells[2 * i + 1] << 4);
  }
  if (cells.size() % 2 != 0) bytes.back() = static_cast<char>(cells.back() & 0x0F);
}

std::vector<std::uint8_t> unpacked(std::string_view bytes, std::size_t count) {
  std::vector<std::uint8_t> cells(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto pair = static_cast<std::uint8_t>(bytes[i / 2]);
    cells[i] = i % 2 == 0 ? pair & 0x0F : pair >> 4;
  }
  return cells;
}

void pack(const std::vector<DopplerClass>& classes, std::string& bytes) {
  bytes.assign((classes.size() + 3) / 4, '\0');
  for (std::size_t i = 0; i < classes.size(); ++i) {
    bytes[i / 4] = static_cast<char>(bytes[i / 4] | static_cast<int>(classes[i]) << 2 * (i % 4));
  }
}

// Requires a message whose geometry is valid.  An empty result is no failure: the view asks for
// none.
Result<std::vector<DopplerClass>, WireError> doppler_of(const wire::Spoke& message) {
  const std::string& bytes = message.doppler();
  std::vector<DopplerClass> classes;
  if (bytes.empty()) return classes;
  const std::size_t expected = (message.cell_count() + 3) / 4;
  if (bytes.size() != expected) {
    return Failure{WireError{
        bytes.size() < expected ? WireErrorKind::truncated : WireErrorKind::oversized, bytes.size(),
        fmt::format("spoke: {} bytes of doppler, expected {} or none", bytes.size(), expected)}};
  }
  classes.resize(message.cell_count());
  for (std::size_t i = 0; i < 4 * bytes.size(); ++i) {
    const int value = static_cast<std::uint8_t>(bytes[i / 4]) >> 2 * (i % 4) & 3;
    if (value > 2 || (value != 0 && i >= classes.size())) {
      return Failure{WireError{WireErrorKind::malformed, i / 4,
                               fmt::format("spoke: doppler of cell {} is {}, expected {}", i, value,
                                           i < classes.size() ? "0 .. 2" : "0, there is none")}};
    }
    if (i < classes.size()) classes[i] = static_cast<DopplerClass>(value);
  }
  return classes;
}

}  // namespace

void to_message(const Spoke& spoke, wire::Spoke& message) {
  const SpokeHeader& header = spoke.header;
  message.set_radar(header.radar);
  message.set_view(header.view);
  message.set_sequence(header.sequence);
  message.set_scan(header.scan);
  message.set_index(header.index);
  message.set_spokes_per_turn(header.geometry.spokes_per_turn);
  message.set_range_scale(static_cast<std::uint32_t>(header.range_scale.index()));
  message.set_bits(header.geometry.bits);
  message.set_cell_count(header.geometry.cells);
  message.set_cell_size_m(header.cell_size().in_metres());
  message.set_heading(header.heading.units());
  message.set_latitude_deg(header.own_ship.latitude_deg);
  message.set_longitude_deg(header.own_ship.longitude_deg);
  message.set_utc_ns(static_cast<std::uint64_t>(header.utc.time_since_epoch().count()));
  message.set_scenario_ns(
      static_cast<std::uint64_t>(header.scenario_time.time_since_epoch().count()));
  std::string& bytes = *message.mutable_cells();
  if (header.geometry.bits == 4) {
    pack(spoke.cells, bytes);
  } else {
    bytes.assign(reinterpret_cast<const char*>(spoke.cells.data()), spoke.cells.size());
  }
  if (!spoke.doppler.empty()) {
    pack(spoke.doppler, *message.mutable_doppler());
  } else {
    message.clear_doppler();
  }
}

Result<Spoke, WireError> from_message(const wire::Spoke& message) {
  if (message.radar() > kMaxNumber) return out_of_range("radar", message.radar(), "0 .. 65535");
  if (message.view() > kMaxNumber) return out_of_range("view", message.view(), "0 .. 65535");

  Spoke spoke;
  SpokeHeader& header = spoke.header;
  header.geometry = {message.spokes_per_turn(), message.cell_count(), message.bits()};
  if (!header.geometry.valid()) {
    return Failure{WireError{
        WireErrorKind::out_of_range, 0,
        fmt::format("spoke: {} spokes per turn of {} cells of {} bits, expected {} .. {} spokes of "
                    "{} .. {} cells of 4 or 8 bits",
                    message.spokes_per_turn(), message.cell_count(), message.bits(),
                    ScanGeometry::kMinSpokes, ScanGeometry::kMaxSpokes, ScanGeometry::kMinCells,
                    ScanGeometry::kMaxCells)}};
  }
  if (message.index() >= message.spokes_per_turn()) {
    return out_of_range("index", message.index(), "less than spokes_per_turn");
  }
  const auto scale = RangeScale::from_index(message.range_scale());
  if (!scale) return out_of_range("range_scale", message.range_scale(), "0 .. 11");
  // Its share of the range scale's cell.  Written so that a NaN fails.
  const double cell_size = header.geometry.cell_size(*scale).in_metres();
  const double share = message.cell_size_m() / cell_size;
  if (!(share >= kShortestReach * (1.0 - kCellSizeTolerance) &&
        share <= kLongestReach * (1.0 + kCellSizeTolerance))) {
    return out_of_range(
        "cell_size_m", message.cell_size_m(),
        fmt::format("{} .. {}, or {} without an instrumented range", kShortestReach * cell_size,
                    kLongestReach * cell_size, cell_size));
  }
  if (std::abs(share - 1.0) > kCellSizeTolerance) {
    header.instrumented_range = metres(message.cell_size_m()) * header.geometry.cells;
  }
  const double latitude = message.latitude_deg();
  const double longitude = message.longitude_deg();
  if (!(latitude >= -90.0 && latitude <= 90.0)) {
    return out_of_range("latitude_deg", latitude, "-90 .. 90");
  }
  if (!(longitude >= -180.0 && longitude <= 180.0)) {
    return out_of_range("longitude_deg", longitude, "-180 .. 180");
  }
  constexpr std::uint64_t kMaxNanoseconds = std::numeric_limits<std::int64_t>::max();
  if (message.utc_ns() > kMaxNanoseconds) {
    return out_of_range("utc_ns", static_cast<double>(message.utc_ns()), "less than 2^63");
  }
  if (message.scenario_ns() > kMaxNanoseconds) {
    return out_of_range("scenario_ns", static_cast<double>(message.scenario_ns()),
                        "less than 2^63");
  }

  const std::string& bytes = message.cells();
  const std::size_t expected =
      message.bits() == 4 ? (message.cell_count() + 1) / 2 : message.cell_count();
  if (bytes.size() != expected) {
    return Failure{WireError{
        bytes.size() < expected ? WireErrorKind::truncated : WireErrorKind::oversized, bytes.size(),
        fmt::format("spoke: {} bytes of cells, expected {}", bytes.size(), expected)}};
  }
  if (message.bits() == 4) {
    if (message.cell_count() % 2 != 0 && static_cast<std::uint8_t>(bytes.back()) > 0x0F) {
      return Failure{WireError{WireErrorKind::malformed, bytes.size() - 1,
                               "spoke: unused high nibble of the last cell byte is not zero"}};
    }
    spoke.cells = unpacked(bytes, message.cell_count());
  } else {
    const auto* const cells = reinterpret_cast<const std::uint8_t*>(bytes.data());
    spoke.cells.assign(cells, cells + bytes.size());
  }

  auto doppler = doppler_of(message);
  if (!doppler) return Failure{doppler.error()};
  spoke.doppler = *std::move(doppler);

  header.radar = message.radar();
  header.view = message.view();
  header.sequence = message.sequence();
  header.scan = message.scan();
  header.index = message.index();
  header.range_scale = *scale;
  header.heading = TrueBearing::from_units(message.heading());
  header.own_ship = {latitude, wrapped_longitude(longitude)};
  header.utc = UtcTime(Duration(static_cast<std::int64_t>(message.utc_ns())));
  header.scenario_time = ScenarioTime(Duration(static_cast<std::int64_t>(message.scenario_ns())));
  return spoke;
}

}  // namespace skerry
