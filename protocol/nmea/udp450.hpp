// IEC 61162-450: sentences in UDP datagrams.  A datagram begins with "UdPbC" and a zero; each line
// has a TAG block before its sentence, "\s:RA0001,n:12*hh\$...".
// Source: nmea/README.md "Sources" (header, TAG block, groups); the standard could not be
// read.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::nmea {

inline constexpr std::array<std::uint8_t, 6> kUdp450Header = {'U', 'd', 'P', 'b', 'C', 0};
// Payload of a datagram on Ethernet.
inline constexpr std::size_t kMostUdp450 = 1472;

enum class Udp450Group : std::uint8_t {
  misc,        // MISC
  targets,     // TGTD: tracked targets and AIS
  fast,        // SATD: heading, attitude, rate of turn
  navigation,  // NAVD: all else of navigation
  time,        // TIME
};
constexpr Ipv4Endpoint address_of(Udp450Group group) {
  switch (group) {
    case Udp450Group::misc:
      return {ipv4(239, 192, 0, 1), 60001};
    case Udp450Group::targets:
      return {ipv4(239, 192, 0, 2), 60002};
    case Udp450Group::fast:
      return {ipv4(239, 192, 0, 3), 60003};
    case Udp450Group::navigation:
      return {ipv4(239, 192, 0, 4), 60004};
    case Udp450Group::time:
      return {ipv4(239, 192, 0, 7), 60007};
  }
  return {};
}

// Which part of which message of several sentences a line is.
struct TagGroup {
  unsigned part = 1;
  unsigned total = 1;
  unsigned code = 1;  // 1 .. 99
  friend bool operator==(const TagGroup&, const TagGroup&) = default;
};

struct TaggedLine {
  std::string source = {};              // "RA0001"
  std::string destination = {};         // empty: everybody
  std::optional<unsigned> number = {};  // 1 .. 999, counts lines
  std::optional<TagGroup> group = {};
  std::string sentence = {};  // without CR LF; not checked
};

bool is_udp450(std::span<const std::uint8_t> datagram);
// Two capital letters and four digits.
bool is_udp450_source(std::string_view source);

class Udp450Encoder {
 public:
  explicit Udp450Encoder(std::string source) : source_(std::move(source)) {}

  // `lines`: whole sentences with CR LF that belong together.  Datagrams of at most kMostUdp450
  // bytes, as many as it takes.
  std::vector<Bytes> encode(std::span<const std::string> lines);

 private:
  std::string source_ = {};
  unsigned number_ = 0;
  unsigned code_ = 0;
};

// Every line of a datagram.  Error: no header, a TAG block that does not end or has a wrong
// checksum.  Parameters that are not known are passed over; a line may have several blocks or none.
Result<std::vector<TaggedLine>, WireError> decode_udp450(std::span<const std::uint8_t> datagram);

}  // namespace skerry::nmea
