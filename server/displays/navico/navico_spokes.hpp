// NavicoSpokes: a view's sectors into frames of 32 spokes.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "protocol/navico/frame.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/navico/spoke_range.hpp"
#include "protocol/video/spoke_resampler.hpp"
#include "server/core/video_channel.hpp"

namespace skerry::server {

// Carries from net-0 to the radar's thread whether the range transmits, and which range the display
// has at which range scale.  Thread: any.
class NavicoGate {
 public:
  void open(bool on) { open_.store(on, std::memory_order_relaxed); }
  bool is_open() const { return open_.load(std::memory_order_relaxed); }

  void set_range(RangeScale scale, std::uint32_t range_dm) {
    range_.store(std::uint64_t{range_dm} << 8 | scale.index(), std::memory_order_relaxed);
  }
  // The display's range for spokes of `scale`; 0 if it was told of another scale.
  std::uint32_t range_dm(RangeScale scale) const {
    const std::uint64_t range = range_.load(std::memory_order_relaxed);
    return (range & 0xFF) == scale.index() ? static_cast<std::uint32_t>(range >> 8) : 0;
  }

 private:
  std::atomic<bool> open_{false};
  std::atomic<std::uint64_t> range_{0xFF};
};

// Cells of the view beyond the reach of the protocol's spoke are cut off, and missing ones are
// empty; where the view's spoke does not end exactly at that reach, its last cell is off by at most
// half a cell of the view.  Thread: one at a time (the radar's).
class NavicoSpokes {
 public:
  NavicoSpokes(navico::Model model, std::shared_ptr<const NavicoGate> gate);

  // The frames that `sector` completes; none while the gate is closed.
  EncodedSectorPtr encode(const Sector& sector);

 private:
  void add(const Spoke& spoke, EncodedSector& out);
  void append(const ResampledSpoke& spoke, EncodedSector& out);
  const Spoke& cut(const Spoke& spoke);
  void begin_anew();

  navico::Model model_;
  std::shared_ptr<const NavicoGate> gate_;
  SpokeResampler resampler_;
  Spoke cut_;
  std::uint32_t range_dm_ = 0;
  navico::SpokeRange range_;
  Bytes frame_;  // in the making
  std::size_t frame_spokes_ = 0;
  std::uint16_t scan_ = 0;
  std::uint16_t rotation_ = 0;
  std::uint32_t next_index_ = navico::kTurnSpokes;  // expected; kTurnSpokes: none
};

// The range, dm, that `model` shows at a range scale nobody chose a range for.
std::uint32_t range_of_scale_dm(navico::Model model, RangeScale scale);

}  // namespace skerry::server
