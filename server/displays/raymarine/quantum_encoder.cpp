#include "server/displays/raymarine/quantum_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skerry::server {
namespace {

// The part of a full echo that a cell is, without the values that mean colours.
std::uint8_t level_of(std::uint8_t cell, std::uint32_t bits) {
  if (bits == 4) return static_cast<std::uint8_t>(cell * raymarine::kQuantumStrongest / 15);
  return std::min(cell, raymarine::kQuantumStrongest);
}

}  // namespace

QuantumEncoder::QuantumEncoder(const DisplayRanges& ranges)
    : ranges_(ranges), resampler_(raymarine::kQuantumSpokes, raymarine::kQuantumCells) {
  spoke_.cells_per_range = raymarine::kQuantumCellsPerRange;
}

const QuantumEncoder::Shape& QuantumEncoder::shape_of(const SpokeHeader& header) {
  const double reach_m = header.reach().in_metres();
  if (reach_m != reach_m_ || !(header.range_scale == scale_)) {
    reach_m_ = reach_m;
    scale_ = header.range_scale;
    const SpokeSpan span = span_of_rows(ranges_, scale_, reach_m);
    const auto cells = std::lround(span.span_m / span.range_m * raymarine::kQuantumCellsPerRange);
    shape_ = {static_cast<std::uint16_t>(std::clamp(cells, 1L, long{raymarine::kQuantumMaxCells})),
              span.parts};
  }
  return shape_;
}

void QuantumEncoder::append(const ResampledSpoke& spoke, EncodedSector& out) {
  // A change of range begins a spoke anew that may have left already.
  if (std::exchange(last_index_, spoke.header.index) == spoke.header.index) return;
  const Shape& shape = shape_of(spoke.header);
  ++spoke_.sequence;
  spoke_.azimuth = static_cast<std::uint16_t>((spoke.header.index + raymarine::kQuantumSpokes / 2) %
                                              raymarine::kQuantumSpokes);
  spoke_.cells.resize(shape.cells);
  for (std::size_t i = 0; i < spoke_.cells.size(); ++i) {
    spoke_.cells[i] = level_of(spoke.cells[i], spoke.header.geometry.bits);
    if (spoke.doppler.empty() || spoke_.cells[i] == 0) continue;
    if (spoke.doppler[i] == DopplerClass::approaching)
      spoke_.cells[i] = raymarine::kQuantumApproaching;
    if (spoke.doppler[i] == DopplerClass::receding) spoke_.cells[i] = raymarine::kQuantumReceding;
  }
  raymarine::append_quantum_spoke(out.bytes, spoke_);
  out.spoke_ends.push_back(static_cast<std::uint32_t>(out.bytes.size()));
}

EncodedSectorPtr QuantumEncoder::encode(const Sector& sector) {
  auto out = std::make_shared<EncodedSector>();
  if (sector.spokes.empty()) return out;
  out->first_sequence = sector.spokes.front()->header.sequence;
  out->scan = sector.spokes.front()->header.scan;
  for (const SpokePtr& spoke : sector.spokes) {
    const Shape shape = shape_of(spoke->header);
    if (!(shape == resampled_)) {
      resampled_ = shape;
      resampler_ = SpokeResampler(raymarine::kQuantumSpokes, shape.cells * shape.parts);
    }
    resampler_.add(*spoke, [&](const ResampledSpoke& done) { append(done, *out); });
  }
  return out;
}

}  // namespace skerry::server
