#include "protocol/captures/spoke_fitter.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/video/spoke_resampler.hpp"

namespace skerry::captures {
namespace {

// Displays say 463 m for 0.25 NM, and a radar's reach is rounded: so much longer is the same scale.
constexpr double kSameScale = 1.01;
// A little inside what the protocol allows.
constexpr double kShortestShare = 1.0 / 16.0, kLongestShare = 2.0, kInside = 1e-9;

bool known(Length length) { return length.in_metres() > 0.0; }

// The strongest of the cells that fall together.
std::vector<std::uint8_t> thinned(const std::vector<std::uint8_t>& cells, std::uint32_t most) {
  const CellShares shares(static_cast<std::uint32_t>(cells.size()), most);
  std::vector<std::uint8_t> out(most);
  for (std::uint32_t c = 0; c < most; ++c) {
    out[c] = *std::max_element(cells.begin() + shares.begin(c), cells.begin() + shares.end(c));
  }
  return out;
}

}  // namespace

std::optional<RangeScale> scale_of(Length nominal, Length reach) {
  if (!std::isfinite(reach.in_metres()) || !known(reach)) return std::nullopt;
  // An unknown range is the one that the picture shows.
  const Length wanted = known(nominal) ? nominal : reach;
  std::optional<RangeScale> best;
  for (std::size_t i = 0; i < RangeScale::kCount && !best; ++i) {
    const RangeScale scale = *RangeScale::from_index(i);
    const bool holds = scale.length() * kSameScale >= wanted;
    if (holds && reach / scale.length() <= kLongestShare - kInside) best = scale;
  }
  const RangeScale last = *RangeScale::from_index(RangeScale::kCount - 1);
  if (!best && reach / last.length() <= kLongestShare - kInside) best = last;
  if (best && reach / best->length() < kShortestShare + kInside) return std::nullopt;
  return best;
}

void SpokeFitter::take(CapturedSpoke spoke, const ShipTrack& ship, std::vector<Spoke>& out) {
  if (!spoke.heading && ship.heading()) {
    spoke.heading = ship.heading();
    spoke.heading_magnetic = false;
  }
  thin(spoke);  // first: those that wait are of bounded size
  if (known(spoke.reach)) {
    reach_ = spoke.reach;
    nominal_ = spoke.nominal;
    give_waiting(out);
    return fit(spoke, ship.position(), out);
  }
  ++counts_.range_unknown;
  waiting_.push_back({std::move(spoke), ship.position()});
  if (known(reach_) || waiting_.size() >= kMaxWaiting) give_waiting(out);
}

void SpokeFitter::give_waiting(std::vector<Spoke>& out) {
  for (Waiting& each : waiting_) {
    each.spoke.reach = known(reach_) ? reach_ : nautical_miles(kAssumedRangeNm);
    each.spoke.nominal = nominal_;
    fit(each.spoke, each.position, out);
  }
  waiting_.clear();
}

void SpokeFitter::finish(std::vector<Spoke>& out) { give_waiting(out); }

void SpokeFitter::thin(CapturedSpoke& from) {
  if (from.cells.size() <= ScanGeometry::kMaxCells) return;
  from.cells = thinned(from.cells, ScanGeometry::kMaxCells);
  from.doppler = {};
  ++counts_.thinned;
}

void SpokeFitter::pad(CapturedSpoke& from) {
  const std::size_t cells = from.cells.size();
  if (cells >= ScanGeometry::kMinCells) return;
  from.reach =
      from.reach * (static_cast<double>(ScanGeometry::kMinCells) / static_cast<double>(cells));
  from.cells.resize(ScanGeometry::kMinCells);
  if (!from.doppler.empty()) from.doppler.resize(ScanGeometry::kMinCells);
  ++counts_.padded;
}

void SpokeFitter::fit(CapturedSpoke& from, const std::optional<GeoPoint>& position,
                      std::vector<Spoke>& out) {
  sequence_ += from.missing;
  counts_.missing += from.missing;
  const Length reach = from.reach;
  pad(from);
  const auto scale = scale_of(from.nominal, from.reach);
  if (!scale || from.index >= from.spokes_per_turn) {
    ++counts_.refused;
    ++sequence_;
    return;
  }
  Spoke spoke;
  SpokeHeader& header = spoke.header;
  header.radar = radar_;
  header.sequence = sequence_++;
  header.geometry = {from.spokes_per_turn, static_cast<std::uint32_t>(from.cells.size()),
                     from.bits};
  header.range_scale = *scale;
  header.instrumented_range = from.reach;
  header.index = from.index;
  header.heading = from.heading.value_or(TrueBearing{});
  if (from.from_north) {
    const TrueBearing bearing =
        TrueBearing::of_spoke(from.index, from.spokes_per_turn) + from.beyond;
    header.index = to_relative(bearing, header.heading).nearest_spoke(from.spokes_per_turn);
    header.heading = TrueBearing::from_units(
        bearing.units() - RelativeBearing::of_spoke(header.index, from.spokes_per_turn).units());
  }
  counts_.magnetic |= from.heading.has_value() && from.heading_magnetic;
  header.scan = turns_.take(header.index, from.spokes_per_turn, from.time, turn_);
  if (position)
    header.own_ship = {position->latitude_deg, wrapped_longitude(position->longitude_deg)};
  header.utc = std::max(from.time, UtcTime{});
  header.scenario_time = ScenarioTime(std::max(from.time - begin_, Duration{}));
  spoke.cells = std::move(from.cells);
  spoke.doppler = std::move(from.doppler);
  ++counts_.spokes;
  ++counts_.at_reach_dm[std::llround(reach.in_metres() * 10.0)];
  out.push_back(std::move(spoke));
}

}  // namespace skerry::captures
