// Datagrams: spokes of the native protocol, or records of a board, over UDP.  Each datagram is a
// 32-byte header and a fragment of a body.  The body of a spoke is a ServerMessage, the same bytes
// as in a TCP frame without its length; that of a record is the record (BOARD.md).  SPEC.md has the
// byte table.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry {

// The kind of the bodies, by the magic.
enum class DatagramKind : std::uint32_t {
  spokes = 0x534B5259,   // "SKRY"
  records = 0x534B5242,  // "SKRB"
};
inline constexpr std::uint32_t kDatagramMagic = static_cast<std::uint32_t>(DatagramKind::spokes);
inline constexpr std::uint8_t kDatagramVersion = 1;
inline constexpr std::size_t kDatagramHeaderSize = 32;

// Sizes of UDP payloads.  1472 fits a 1500-byte Ethernet MTU behind IPv4 and UDP headers; 65,507 is
// the most IPv4 carries and makes every spoke one datagram (for loopback).
inline constexpr std::size_t kMinDatagram = 256;
inline constexpr std::size_t kDefaultDatagram = 1472;
inline constexpr std::size_t kMaxDatagram = 65507;

// Longest body.  The longest spoke of version 1 takes 4.3 kB, the longest record 65,728 bytes (two
// channels of 16,384 samples); the rest is room to grow.
inline constexpr std::size_t kMaxDatagramBody = 66560;

// Which spoke or record a datagram belongs to.
struct DatagramSpoke {
  std::uint16_t radar = 0;
  std::uint16_t view = 0;      // 0 for records
  std::uint64_t sequence = 0;  // SpokeHeader::sequence, or the record's
  friend bool operator==(const DatagramSpoke&, const DatagramSpoke&) = default;
};

// The header of one datagram.  All fragments of a body but the last are fragment_size bytes, so
// that fragment i starts at i * fragment_size and each can be checked alone.
struct DatagramHeader {
  DatagramSpoke spoke;
  std::uint16_t fragment_index = 0;
  std::uint16_t fragment_count = 1;
  std::uint16_t fragment_size = 0;                 // of every fragment but the last
  std::uint32_t body_length = 0;                   // of the whole body, 1 .. kMaxDatagramBody
  std::uint32_t offset = 0;                        // of this fragment in the body
  std::uint8_t header_size = kDatagramHeaderSize;  // where the fragment starts
  friend bool operator==(const DatagramHeader&, const DatagramHeader&) = default;
};

// Appends the 32 bytes of `header` (header_size is not looked at).
void append_datagram_header(Bytes& out, const DatagramHeader& header,
                            DatagramKind kind = DatagramKind::spokes);

// Reads the header of one whole datagram and checks all that one datagram can lie about: what
// follows the header is exactly the fragment that index, size and body length say.  A header longer
// than 32 bytes is a later writer's; the rest of it is skipped.
// Error: truncated, malformed (not a Skerry datagram of that kind, or a fragment that does not fit
// its body), oversized, unknown_kind (another version).
Result<DatagramHeader, WireError> decode_datagram_header(std::span<const std::uint8_t> datagram,
                                                         DatagramKind kind = DatagramKind::spokes);

// Number of datagrams of at most `max_datagram` bytes that `body_length` bytes need.
// Requires kMinDatagram <= max_datagram <= kMaxDatagram.
constexpr std::size_t datagram_count(std::size_t body_length, std::size_t max_datagram) {
  const std::size_t fragment = max_datagram - kDatagramHeaderSize;
  return (body_length + fragment - 1) / fragment;
}

// Calls send(std::span<const std::uint8_t> datagram) for each datagram of `body`, in order.  The
// span lies in `scratch` and is valid during the call.  `max_datagram` is brought into
// [kMinDatagram, kMaxDatagram].  Requires 1 <= body.size() <= kMaxDatagramBody.
template <typename Send>
void for_each_datagram(const DatagramSpoke& spoke, std::span<const std::uint8_t> body,
                       std::size_t max_datagram, Bytes& scratch, Send&& send,
                       DatagramKind kind = DatagramKind::spokes) {
  max_datagram = std::clamp(max_datagram, kMinDatagram, kMaxDatagram);
  const std::size_t size = max_datagram - kDatagramHeaderSize;
  const std::size_t count = datagram_count(body.size(), max_datagram);
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = body.subspan(i * size, std::min(size, body.size() - i * size));
    scratch.clear();
    append_datagram_header(scratch,
                           {.spoke = spoke,
                            .fragment_index = static_cast<std::uint16_t>(i),
                            .fragment_count = static_cast<std::uint16_t>(count),
                            .fragment_size = static_cast<std::uint16_t>(size),
                            .body_length = static_cast<std::uint32_t>(body.size()),
                            .offset = static_cast<std::uint32_t>(i * size)},
                           kind);
    scratch.insert(scratch.end(), part.begin(), part.end());
    send(std::span<const std::uint8_t>(scratch));
  }
}

// Puts bodies together again, whatever the order of the datagrams.  At most kInFlight bodies are
// unfinished at a time: the oldest gives way.  A body is given out once; datagrams of one of the
// last kRemembered bodies given out are duplicates.
// Memory: at most kInFlight * kMaxDatagramBody bytes (1 MiB), however hostile the sender. Datagrams
// of the other kind are refused.
// Thread: one at a time.
class DatagramReassembler {
 public:
  static constexpr std::size_t kInFlight = 16;
  static constexpr std::size_t kRemembered = 64;

  explicit DatagramReassembler(DatagramKind kind = DatagramKind::spokes) : kind_(kind) {}

  // The body that `datagram` completed, if it did; parse it as a ServerMessage, or as a record.
  // Error: as decode_datagram_header(); malformed also if the datagram contradicts an earlier one
  // of its spoke, which stays as it was.
  Result<std::optional<Bytes>, WireError> feed(std::span<const std::uint8_t> datagram);

  std::uint64_t completed() const { return completed_; }    // bodies given out
  std::uint64_t abandoned() const { return abandoned_; }    // bodies that gave way, unfinished
  std::uint64_t duplicates() const { return duplicates_; }  // datagrams not needed any more
  std::uint64_t refused() const { return refused_; }        // datagrams answered with an error
  std::size_t in_flight() const { return unfinished_.size(); }

 private:
  struct Unfinished {
    DatagramSpoke spoke;
    std::uint16_t fragment_size = 0;
    std::size_t missing = 0;
    std::vector<bool> have;
    Bytes body;
  };

  bool was_completed(const DatagramSpoke& spoke) const;
  void remember(const DatagramSpoke& spoke);
  Unfinished* find_unfinished(const DatagramSpoke& spoke);
  Unfinished& begin(const DatagramHeader& header);

  DatagramKind kind_;
  std::vector<Unfinished> unfinished_;  // oldest first
  std::array<DatagramSpoke, kRemembered> remembered_{};
  std::uint64_t completed_ = 0;
  std::uint64_t abandoned_ = 0;
  std::uint64_t duplicates_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace skerry
