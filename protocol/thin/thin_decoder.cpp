#include "protocol/thin/thin_decoder.hpp"

#include <fmt/format.h>
#include <zstd.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/thin/thin_shape.hpp"
#include "protocol/video/scan_geometry.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry {
namespace {

// The k-th of `steps` equal steps to `change`.
std::int64_t part_of(std::int64_t change, std::uint32_t k, std::uint32_t steps) {
  if (steps == 0) return 0;
  return std::llround(static_cast<long double>(change) * k / steps);
}

// Of a sum of a longitude and less than a turn; anything else stays wrong, and is refused later.
double turned_once(double degrees) {
  return degrees >= 180.0 ? degrees - 360.0 : degrees < -180.0 ? degrees + 360.0 : degrees;
}

// Without overflow: a time that no clock shows is refused later.
std::uint64_t moved(std::uint64_t time, std::int64_t by) {
  return time + static_cast<std::uint64_t>(by);
}

Result<std::string, WireError> unpacked(std::string_view packed, std::size_t size) {
  const unsigned long long said = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (said != size) {
    return failure(WireErrorKind::malformed, 0,
                   fmt::format("thin_spokes.cells: no zstd frame of {} bytes", size));
  }
  std::string cells(size, '\0');
  const std::size_t done =
      ZSTD_decompress(cells.data(), cells.size(), packed.data(), packed.size());
  if (ZSTD_isError(done) || done != size) {
    return failure(
        WireErrorKind::malformed, 0,
        fmt::format("thin_spokes.cells: {}",
                    ZSTD_isError(done) ? ZSTD_getErrorName(done) : "ends before it should"));
  }
  return cells;
}

}  // namespace

Result<std::vector<Spoke>, WireError> from_message(const wire::ThinSpokes& message) {
  const wire::Spoke& first = message.first();
  const std::uint32_t count = message.count();
  const auto wrong = [](std::string text) {
    return failure(WireErrorKind::out_of_range, 0, "thin_spokes: " + std::move(text));
  };
  if (count == 0 || count > kMostThinSpokes) {
    return wrong(fmt::format("count {}, expected 1 to {}", count, kMostThinSpokes));
  }
  if (first.bits() != 4) return wrong(fmt::format("bits {}, expected 4", first.bits()));
  if (first.cell_count() < ScanGeometry::kMinCells ||
      first.cell_count() > ScanGeometry::kMaxCells) {
    return wrong(fmt::format("cell_count {}, expected {} to {}", first.cell_count(),
                             ScanGeometry::kMinCells, ScanGeometry::kMaxCells));
  }
  if (!first.cells().empty() || !first.doppler().empty()) {
    return wrong("the first spoke has cells or classes of its own, expected none");
  }
  if (first.index() >= first.spokes_per_turn() || count > first.spokes_per_turn() - first.index()) {
    return wrong(fmt::format("{} spokes from index {} on, of {} in a turn", count, first.index(),
                             first.spokes_per_turn()));
  }
  if (first.sequence() > std::numeric_limits<std::uint64_t>::max() - count) {
    return wrong("its spokes' numbers do not fit into 64 bits");
  }
  const std::size_t row = (first.cell_count() + 1) / 2;
  const auto cells = unpacked(message.cells(), row * count);
  if (!cells) return Failure{cells.error()};

  std::vector<Spoke> spokes;
  spokes.reserve(count);
  wire::Spoke each = first;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t steps = count - 1;
    const double share = steps == 0 ? 0.0 : static_cast<double>(k) / steps;
    each.set_sequence(first.sequence() + k);
    each.set_index(first.index() + k);
    each.set_heading(first.heading() +
                     static_cast<std::uint32_t>(part_of(message.heading_change(), k, steps)));
    each.set_utc_ns(moved(first.utc_ns(), part_of(message.utc_ns_change(), k, steps)));
    each.set_scenario_ns(
        moved(first.scenario_ns(), part_of(message.scenario_ns_change(), k, steps)));
    each.set_latitude_deg(first.latitude_deg() + share * message.latitude_change_deg());
    each.set_longitude_deg(
        turned_once(first.longitude_deg() + share * message.longitude_change_deg()));
    each.set_cells(cells.value().data() + k * row, row);
    auto made = from_message(each);
    if (!made) return Failure{made.error()};
    spokes.push_back(std::move(made).value());
  }
  return spokes;
}

}  // namespace skerry
