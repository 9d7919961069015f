#include "clients/cli/board/board_turn.hpp"

#include <algorithm>
#include <bit>
#include <chrono>

#include "clients/cli/board/board_scope.hpp"
#include "clients/cli/board/board_words.hpp"

namespace skerry::client {

std::uint32_t spokes_that_fit(const board::SweepMeta& meta, std::uint32_t most) {
  most = std::clamp(most, ScanGeometry::kMinSpokes, ScanGeometry::kMaxSpokes);
  if (meta.spokes_per_turn >= ScanGeometry::kMinSpokes &&
      meta.spokes_per_turn <= ScanGeometry::kMaxSpokes) {
    return meta.spokes_per_turn;  // formed by the board already
  }
  // One ACP that came too late or too early says nothing of the turn.
  const double turn_ticks = meta.turn_ticks != 0
                                ? static_cast<double>(meta.turn_ticks)
                                : static_cast<double>(meta.acp_period) * meta.acp_per_turn;
  const double turn_s = turn_ticks / std::max(1u, meta.sample_clock_hz);
  const double pulses = turn_s * meta.prf_millihertz * 1e-3;
  if (!(pulses >= 1.0)) return most;
  const auto whole = static_cast<std::uint32_t>(std::min(pulses, 1e9));
  return std::clamp(std::bit_floor(whole), ScanGeometry::kMinSpokes, most);
}

std::vector<std::uint8_t> cells_of(const board::Sweep& sweep, std::size_t channel,
                                   const ScanGeometry& geometry, RangeScale range) {
  const std::uint32_t top = board::largest_code(sweep.meta.channels[channel]);
  const bool inverted = sweep.meta.channels[channel].inverted;
  const auto columns =
      columns_of(sweep, channel, {0.0, range.length().in_metres()}, geometry.cells);
  std::vector<std::uint8_t> cells(geometry.cells);
  for (std::size_t n = 0; n < cells.size(); ++n) {
    if (!columns[n].any) continue;
    const std::uint32_t code = inverted ? top - std::min<std::uint32_t>(columns[n].low, top)
                                        : std::min<std::uint32_t>(columns[n].high, top);
    cells[n] = static_cast<std::uint8_t>(code * 255u / top);
  }
  return cells;
}

void TurnAssembler::take(const board::Sweep& formed, TrueBearing heading, GeoPoint own_ship) {
  const std::uint32_t index = formed.meta.spoke % geometry_.spokes_per_turn;
  const bool wrapped = last_index_ && index < *last_index_;
  last_index_ = index;
  if (wrapped && begun_) whole_ = true;
  if (whole_) return;
  if (wrapped) {
    begun_ = true;
    faults_ = formed.meta.faults;
    scan_ = Scan{.radar = formed.meta.radar,
                 .view = 0,
                 .number = formed.meta.arp_count,
                 .geometry = geometry_,
                 .spokes = std::vector<std::optional<Spoke>>(geometry_.spokes_per_turn),
                 .received = 0};
  }
  if (!begun_ || scan_.spokes[index]) return;
  Spoke spoke;
  spoke.header.radar = formed.meta.radar;
  spoke.header.sequence = formed.meta.trigger_count;
  spoke.header.scan = scan_.number;
  spoke.header.index = index;
  spoke.header.geometry = geometry_;
  spoke.header.range_scale = range_;
  spoke.header.heading = heading;
  spoke.header.own_ship = own_ship;
  spoke.header.utc =
      UtcTime{std::chrono::nanoseconds(static_cast<std::int64_t>(formed.meta.utc_ns))};
  spoke.cells = cells_of(formed, channel_, geometry_, range_);
  scan_.spokes[index] = std::move(spoke);
  ++scan_.received;
}

std::optional<Scan> TurnAssembler::feed(const board::Sweep& sweep, TrueBearing heading,
                                        GeoPoint own_ship) {
  if (whole_ || sweep.samples[channel_].empty()) return std::nullopt;
  if (sweep.meta.spokes_per_turn == geometry_.spokes_per_turn) {
    take(sweep, heading, own_ship);
  } else {
    former_.add(sweep, [&](const board::Sweep& formed) { take(formed, heading, own_ship); });
  }
  faults_ |= sweep.meta.faults;
  if (!whole_) return std::nullopt;
  return std::move(scan_);
}

}  // namespace skerry::client
