// ThinEncoder: spokes as ThinSpokes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "protocol/thin/thin_shape.hpp"
#include "protocol/video/spoke_resampler.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry {

// Spokes of one view, as thin as a level has them, in blocks of a thirty-second of a turn. Numbered
// from 0 without a gap; Doppler classes are left out.  A block is given when it is full, and what a
// turn, a change of range or shape, or a gap cuts off as it is.
//
// Of the headers only the first spoke's is exact.  Those between it and the last are in a straight
// line: while the own ship's rate of turn changes by r deg/min within a block of t seconds, a
// heading is off by up to r t / 480 degrees: 0.02 for 100 deg/min and 80 ms.
// Held by ThinTest.HeadersBetweenAreStraight.
// Thread: one at a time.
class ThinEncoder {
 public:
  // 1 .. kThinLevels.
  explicit ThinEncoder(std::uint32_t level);
  ThinEncoder(ThinEncoder&&) noexcept;
  ~ThinEncoder();

  // Called with each block; valid during the call.
  using Sink = std::function<void(const wire::ThinSpokes&)>;
  // Requires a spoke as SpokeResampler does.
  void add(const Spoke& spoke, const Sink& sink);

  std::uint64_t next() const { return sequence_; }  // number of the next spoke

 private:
  class Compressor;
  void collect(const ResampledSpoke& made, const Sink& sink);
  bool goes_on(const SpokeHeader& next) const;
  void give(const Sink& sink);

  const ThinShape shape_;
  ScanGeometry source_;
  std::optional<SpokeResampler> resampler_;
  std::uint64_t sequence_ = 0;
  // The block so far.
  std::vector<SpokeHeader> headers_;
  std::vector<std::uint8_t> cells_;  // two in a byte
  std::unique_ptr<Compressor> compressor_;
  wire::ThinSpokes message_;  // kept for its memory
};

}  // namespace skerry
