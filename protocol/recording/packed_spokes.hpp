// Spokes packed by their differences: the compact mode (RECORDING.md).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/wire_error.hpp"

namespace skerry::recording {

// From the first spoke of a message to its last: less than this.
inline constexpr Duration kMaxPackedSpan = std::chrono::seconds(1);

// The numbers of a wire::Spoke; doubles by their bits.
struct SpokeNumbers {
  static constexpr std::size_t kFields = 15;
  std::array<std::uint64_t, kFields> values{};  // in the order of radar.proto
};

// Predicts the numbers of a spoke from the two before it; only differences are stored.
class SpokeForecast {
 public:
  // Requires that all fields before `field` of `spoke` are known.
  std::uint64_t of(std::size_t field, const SpokeNumbers& spoke) const;
  void take(const SpokeNumbers& spoke) {
    before_ = last_;
    last_ = spoke;
  }

 private:
  SpokeNumbers last_, before_;
};

// Gathers spokes of a radar and view into one message.  Memory: that of their cells, twice.
// Thread: one at a time.
class SpokePacker {
 public:
  // False if the spoke does not go with those that are in: another number of cells, a time before
  // the last one's or too long after the first one's; or not at all: its bytes are not what its
  // values are written as, or its time is not `time_ns`.
  bool add(std::span<const std::uint8_t> spoke, std::uint64_t time_ns);

  bool empty() const { return count_ == 0; }
  std::uint64_t first_time() const { return first_time_; }  // ns
  // The message will have this many octets at most.
  std::size_t size_bound() const;
  // Appends the serialised PackedSpokes; empty afterwards.
  void finish(Bytes& out);

 private:
  std::uint32_t count_ = 0;
  std::uint64_t first_time_ = 0, last_time_ = 0;
  std::size_t cell_bytes_ = 0, doppler_bytes_ = 0;  // of a spoke
  SpokeForecast forecast_;
  Bytes numbers_;
  Bytes cells_, doppler_;  // one spoke after the other
  wire::Spoke message_;
  Bytes again_;
};

// How many spokes a serialised PackedSpokes says it has; 0 if it is none.
std::uint32_t packed_count(std::span<const std::uint8_t> message);

// Gives them back one by one.  Bounded: it holds as many octets as the message, and a spoke.
// Thread: one at a time.
class SpokeUnpacker {
 public:
  // Error: what is wrong with the message.
  static Result<std::unique_ptr<SpokeUnpacker>, std::string> open(
      std::span<const std::uint8_t> message);

  // The next one; false at the end, and where the rest cannot be read: then broken() too.
  bool next();
  std::span<const std::uint8_t> bytes() const { return bytes_; }  // of the wire::Spoke
  std::int64_t time() const { return time_; }                     // ns since 1970
  bool broken() const { return broken_; }
  std::size_t memory() const {
    return sizeof(*this) + numbers_.capacity() + cells_.capacity() + doppler_.capacity();
  }

 private:
  SpokeUnpacker() = default;
  bool read_numbers(SpokeNumbers& spoke);

  std::uint32_t left_ = 0;
  std::size_t cell_bytes_ = 0, doppler_bytes_ = 0;
  std::size_t taken_ = 0;   // spokes
  std::size_t offset_ = 0;  // in numbers_
  Bytes numbers_, cells_, doppler_;
  SpokeForecast forecast_;
  wire::Spoke message_;
  Bytes bytes_;
  std::int64_t first_time_ = 0, time_ = 0;
  bool broken_ = false;
};

}  // namespace skerry::recording
