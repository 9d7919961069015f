// Cat240Stream: spokes into the datagrams of one CAT240 receiver.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "protocol/asterix/cat240.hpp"
#include "protocol/video/spoke_resampler.hpp"

namespace skerry {

// The shape of the video that a receiver is sent.
struct Cat240StreamShape {
  Cat240Options options;
  std::uint32_t turn_spokes = 0;  // 1 .. 8192; 0: as the radar has them
  std::uint32_t cells = 0;        // of a spoke, 1 .. 8192; 0: as the radar has them
  // Video records to a data block, 1 .. 64, and so to a datagram; fewer where a block would exceed
  // `max_datagram` octets (512 .. 65,507).  One alone may be longer.
  std::uint32_t records = 1;
  std::size_t max_datagram = 65'507;
  bool summaries = true;  // one in a datagram of its own before every turn's first spoke
  friend bool operator==(const Cat240StreamShape&, const Cat240StreamShape&) = default;
};

// Video is resampled so that peaks stay (spoke_resampler.hpp); the message index counts video
// records from 0.  A data block that is not full when a sector ends waits for the next. Thread: one
// at a time.
class Cat240Stream {
 public:
  explicit Cat240Stream(const Cat240StreamShape& shape) : shape_(shape) {}

  // Calls `sink` with every datagram that is complete; it is valid during the call.
  using Sink = std::function<void(std::span<const std::uint8_t>)>;
  void add(const Spoke& spoke, const Sink& sink);

 private:
  void add_record(const SpokeHeader& header, std::span<const std::uint8_t> cells, const Sink& sink);
  void send_block(const Sink& sink);

  Cat240StreamShape shape_;
  std::optional<SpokeResampler> resampler_;
  ScanGeometry resampled_;  // the source's geometry that resampler_ is for
  std::uint32_t message_index_ = 0;
  std::optional<std::uint32_t> summarised_;  // the scan
  Bytes block_;                              // in the making, from its header on; may be empty
  std::uint32_t held_ = 0;                   // records in it
  Bytes scratch_;
};

}  // namespace skerry
