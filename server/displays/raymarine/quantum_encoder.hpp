// Sectors of a view as the spokes of a Raymarine Quantum radar.
#pragma once

#include <cstdint>

#include "protocol/raymarine/quantum_spoke.hpp"
#include "protocol/video/spoke_resampler.hpp"
#include "server/core/video_channel.hpp"
#include "server/displays/display_range.hpp"

namespace skerry::server {

// Thread: one at a time.
class QuantumEncoder {
 public:
  explicit QuantumEncoder(const DisplayRanges& ranges);
  EncodedSectorPtr encode(const Sector& sector);

 private:
  struct Shape {
    std::uint16_t cells = raymarine::kQuantumCells;
    std::uint32_t parts = 1;
    friend bool operator==(const Shape&, const Shape&) = default;
  };
  const Shape& shape_of(const SpokeHeader& header);
  void append(const ResampledSpoke& spoke, EncodedSector& out);

  DisplayRanges ranges_;
  RangeScale scale_;      // of shape_
  double reach_m_ = 0.0;  // of shape_
  Shape shape_;
  Shape resampled_;  // what resampler_ makes
  SpokeResampler resampler_;
  std::uint32_t last_index_ = UINT32_MAX;  // that left
  raymarine::QuantumSpoke spoke_;
};

}  // namespace skerry::server
