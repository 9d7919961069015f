// RadarsHeard: who says on the network that he is a radar.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "clients/doctor/radar_kinds.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::client::doctor {

// Where to listen.
struct Ear {
  std::uint32_t interface_address = 0;
  Ipv4Endpoint group;
  friend constexpr auto operator<=>(const Ear&, const Ear&) = default;
};

// One sender to one group.
struct Heard {
  Ear ear;
  Ipv4Endpoint sender;
  std::uint64_t datagrams = 0;
  // What its last locator says; empty and 0 without any.
  std::string serial;
  Ipv4Endpoint data;
};

struct HeardRadars {
  std::vector<Heard> heard;
  struct Deaf {
    Ear ear;
    int problem = 0;  // errno
  };
  std::vector<Deaf> deaf;  // where one cannot listen
};

// Listens for that long, and asks Navico radars to announce themselves as a display does.  At most
// kMostHeard senders are kept.  `go_on` is asked every 0.1 s.
inline constexpr std::size_t kMostHeard = 256;
HeardRadars listen_for_radars(const std::vector<Ear>& ears, Duration length,
                              const std::function<bool()>& go_on);

}  // namespace skerry::client::doctor
