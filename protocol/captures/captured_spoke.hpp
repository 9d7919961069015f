// Pictures and spokes of a capture of a real radar, as its packets tell them.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/length.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"

namespace skerry::captures {

enum class Family : std::uint8_t { navico, garmin, quantum, rd, furuno, cat240, native };

constexpr std::string_view name_of(Family family) {
  switch (family) {
    case Family::navico:
      return "Navico";
    case Family::garmin:
      return "Garmin xHD";
    case Family::quantum:
      return "Raymarine Quantum";
    case Family::rd:
      return "Raymarine RD";
    case Family::furuno:
      return "Furuno";
    case Family::cat240:
      return "CAT240";
    case Family::native:
      return "Skerry";
  }
  return "";
}

// A stream of spokes in a capture: one becomes one radar of the recording.  A radar that sends two
// ranges at once has two.
struct PictureKey {
  Family family = Family::navico;
  std::uint32_t from = 0;    // IPv4 address of the sender
  Ipv4Endpoint to;           // its picture's group
  std::uint16_t source = 0;  // CAT240: SAC and SIC; Furuno: 1 of range B; native: radar, view
  friend constexpr auto operator<=>(const PictureKey&, const PictureKey&) = default;
};

struct CapturedSpoke {
  UtcTime time{};
  std::uint32_t spokes_per_turn = 0;
  std::uint32_t index = 0;  // clockwise from the bow, or from north where `from_north`
  bool from_north = false;
  Angle beyond{};  // of the spoke's middle from that index, where `from_north`
  std::uint32_t bits = 8;
  Length reach{};             // far end of the last cell; 0: the packets do not say
  Length nominal{};           // the range the radar is set to; 0: not known
  std::uint32_t missing = 0;  // spokes just before it that are not in the capture
  std::optional<TrueBearing> heading;
  bool heading_magnetic = false;
  std::vector<std::uint8_t> cells;    // nearest first
  std::vector<DopplerClass> doppler;  // of all cells, or empty
};

}  // namespace skerry::captures
