// Sectors of a view as the spokes of a Garmin xHD radar.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "protocol/video/spoke_resampler.hpp"
#include "server/core/video_channel.hpp"
#include "server/displays/display_range.hpp"

namespace skerry::server {

// The antenna's angle at the last spoke sent, in units of 1 / garmin::kAnglesPerTurn of a turn.
// Written by the radar's thread, read by net-0.
using XhdAntenna = std::shared_ptr<std::atomic<std::uint32_t>>;

// Thread: one at a time.
class XhdEncoder {
 public:
  XhdEncoder(const DisplayRanges& ranges, XhdAntenna antenna);
  EncodedSectorPtr encode(const Sector& sector);

 private:
  const SpokeSpan& span_of(const SpokeHeader& header);
  void append(const ResampledSpoke& spoke, EncodedSector& out);

  DisplayRanges ranges_;
  XhdAntenna antenna_;
  RangeScale scale_;      // of span_
  double reach_m_ = 0.0;  // of span_
  SpokeSpan span_;
  std::uint32_t parts_ = 1;  // of resampler_
  SpokeResampler resampler_;
  std::uint32_t last_index_ = UINT32_MAX;  // that left
  std::vector<std::uint8_t> cells_;
};

}  // namespace skerry::server
