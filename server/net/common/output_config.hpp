// Outputs besides consoles: streams of datagrams, plots and tracks, and emulated radars of other
// makers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "protocol/asterix/cat240_stream.hpp"
#include "protocol/asterix/report_parts.hpp"
#include "protocol/quantity/time.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

// A receiver of datagrams of one radar, for as long as the server runs.
struct UdpDestination {
  std::uint32_t radar = 0;
  std::string address = "127.0.0.1";  // IPv4 or IPv6 literal, unicast or multicast
  std::uint16_t port = 0;             // 1 .. 65535
  std::size_t max_datagram = 0;       // bytes; 0: 65507 on loopback, 1472 elsewhere
  int multicast_ttl = 0;              // 0 .. 255; 0: this host, 1: this network
  // Multicast: address of the interface to send from, empty: the system's choice.  IPv4 only.
  std::string interface_address = {};
};

// Whose picture an output shows.
struct OutputSource {
  std::uint32_t radar = 0;
  // A view of its own, with controls of its own; otherwise the one that all consoles share.
  bool own_view = false;
};

// Spokes of the native protocol in another shape; 0: as the radar has them.  Peaks are kept.
struct NativeShape {
  std::uint32_t turn_spokes = 0;  // ScanGeometry::kMinSpokes .. kMaxSpokes
  std::uint32_t cells = 0;        // ScanGeometry::kMinCells .. kMaxCells
  std::uint32_t bits = 0;         // 4 or 8
  friend bool operator==(const NativeShape&, const NativeShape&) = default;
};

// The records of the radar's interface board, one in a body.
struct BoardRecords {
  friend bool operator==(const BoardRecords&, const BoardRecords&) = default;
};

// A stream of datagrams: spokes in some shape, or records.
struct StreamOutputConfig {
  UdpDestination to;
  bool own_view = false;  // otherwise the view that all consoles share; not of records
  std::variant<NativeShape, Cat240StreamShape, BoardRecords> shape;
};

// What a plotter's plots and tracks are sent as.
enum class TargetCategory : std::uint8_t { cat048, cat062, cat010 };

// The plots and tracks of a radar's shared view.
struct TargetOutputConfig {
  UdpDestination to;  // max_datagram 0: 1472
  TargetCategory category = TargetCategory::cat048;
  AsterixSource source = {};
};

// A radar of another maker, at an address of this host.
struct DisplayOutputConfig {
  std::string name;  // "navico_4g", for status and log
  // Makes the emulation; it may throw std::invalid_argument.
  std::function<std::unique_ptr<RadarEmulation>()> make;
  EmulationIdentity identity;
  // The radar's own IPv4 address: where it sends from, and whose interface it is on.
  std::string interface_address = "127.0.0.1";
  int ttl = 0;  // 0 .. 255; 0: this host, 1: this network
  // Sources of range A, then of B; the last one stands for those not given.
  std::vector<OutputSource> sources = {{}};
  bool obeys = true;  // otherwise displays only look: their commands are refused
  // The radar's spokes leave it together in bursts so long apart; 0: each when it is complete.
  Duration burst{};
};

}  // namespace skerry::server
