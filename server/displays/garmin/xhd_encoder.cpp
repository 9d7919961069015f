#include "server/displays/garmin/xhd_encoder.hpp"

#include <cmath>
#include <utility>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_spoke.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kAngleStep = garmin::kAnglesPerTurn / garmin::kSpokesPerTurn;
constexpr std::uint8_t kEightBitsOfFour = 17;  // 15 becomes 255

}  // namespace

XhdEncoder::XhdEncoder(const DisplayRanges& ranges, XhdAntenna antenna)
    : ranges_(ranges),
      antenna_(std::move(antenna)),
      resampler_(garmin::kSpokesPerTurn, garmin::kCells) {}

const SpokeSpan& XhdEncoder::span_of(const SpokeHeader& header) {
  const double reach_m = header.reach().in_metres();
  if (reach_m != reach_m_ || !(header.range_scale == scale_)) {
    reach_m_ = reach_m;
    scale_ = header.range_scale;
    span_ = span_of_rows(ranges_, scale_, reach_m);
  }
  return span_;
}

void XhdEncoder::append(const ResampledSpoke& spoke, EncodedSector& out) {
  // A change of range begins a spoke anew that may have left already.
  if (std::exchange(last_index_, spoke.header.index) == spoke.header.index) return;
  const SpokeSpan& span = span_of(spoke.header);
  garmin::SpokePacket packet;
  packet.angle = static_cast<std::uint16_t>(spoke.header.index * kAngleStep);
  packet.range_m = static_cast<std::uint32_t>(std::lround(span.range_m));
  packet.span_m = static_cast<std::uint32_t>(std::lround(span.span_m));
  packet.cells = spoke.cells.first(garmin::kCells);
  if (spoke.header.geometry.bits == 4) {
    cells_.assign(packet.cells.begin(), packet.cells.end());
    for (std::uint8_t& cell : cells_) cell = static_cast<std::uint8_t>(cell * kEightBitsOfFour);
    packet.cells = cells_;
  }
  garmin::append_spoke(out.bytes, packet);
  out.spoke_ends.push_back(static_cast<std::uint32_t>(out.bytes.size()));
  antenna_->store(packet.angle, std::memory_order_relaxed);
}

EncodedSectorPtr XhdEncoder::encode(const Sector& sector) {
  auto out = std::make_shared<EncodedSector>();
  if (sector.spokes.empty()) return out;
  out->first_sequence = sector.spokes.front()->header.sequence;
  out->scan = sector.spokes.front()->header.scan;
  out->bytes.reserve(sector.spokes.size() * (garmin::kSpokeHeaderBytes + garmin::kCells));
  for (const SpokePtr& spoke : sector.spokes) {
    const std::uint32_t parts = span_of(spoke->header).parts;
    if (parts != parts_) {
      parts_ = parts;
      resampler_ = SpokeResampler(garmin::kSpokesPerTurn, garmin::kCells * parts);
    }
    resampler_.add(*spoke, [&](const ResampledSpoke& done) { append(done, *out); });
  }
  return out;
}

}  // namespace skerry::server
