// Ipv4Fragments: puts the fragments of IPv4 datagrams together again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace skerry::pcap {

inline constexpr std::uint8_t kProtocolUdp = 17;  // of an IPv4 header

// Source: RFC 791 3.2.  Fragments may come in any order; one that comes twice counts once.  A
// datagram whose fragments overlap or reach beyond its end is given up, as the RFC's successors do.
// Memory: at most `max_pending` datagrams of 64 KiB; the oldest gives way.  Thread: one at a time.
class Ipv4Fragments {
 public:
  explicit Ipv4Fragments(std::size_t max_pending) : max_pending_(max_pending) {}

  // The fields that fragments of one packet share.
  struct Key {
    std::uint32_t from = 0, to = 0;
    std::uint16_t identification = 0;
    std::uint8_t protocol = 0;
    friend bool operator==(const Key&, const Key&) = default;
  };
  // The payload that `fragment` completed, if it did.  `offset` is in octets.
  std::optional<std::vector<std::uint8_t>> add(const Key& key, std::size_t offset, bool more,
                                               std::span<const std::uint8_t> fragment);

  std::size_t pending() const { return pending_.size(); }
  std::uint64_t given_up() const { return given_up_; }

 private:
  struct Pending {
    Key key;
    std::map<std::size_t, std::vector<std::uint8_t>> pieces;  // by offset
    std::size_t held = 0;                                     // octets in them
    std::optional<std::size_t> total;                         // known from the last fragment
  };
  enum class Fit : std::uint8_t { taken, again, contradiction };

  std::list<Pending>::iterator find_or_begin(const Key& key);
  static Fit put(Pending& datagram, std::size_t offset, bool more,
                 std::span<const std::uint8_t> fragment);

  std::size_t max_pending_;
  std::list<Pending> pending_;  // oldest first
  std::uint64_t given_up_ = 0;
};

}  // namespace skerry::pcap
