// ShipTrack: own ship, as the navigation data in a capture say it.
#pragma once

#include <optional>
#include <string_view>

#include "protocol/pcap/capture_reader.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::captures {

// Where a ship is and how she moves; only what is known.
struct ShipFix {
  std::optional<GeoPoint> position;
  std::optional<double> heading_deg, course_deg;  // true, [0, 360)
  std::optional<double> speed_kn;                 // over ground
  std::optional<double> rate_deg_min;             // of turn, starboard positive
};

// NMEA 0183 in datagrams (bare, or IEC 61162-450) and the heading, navigation and speed packets of
// a HALO's network.  What was said last counts, however long ago.  Thread: one at a time.
class ShipTrack {
 public:
  // What is there of it counts as said last.
  void put(const ShipFix& fix);
  // Whether something was said.
  bool hear(const pcap::Datagram& datagram);

  bool known() const { return position_ || heading_deg_ || course_deg_ || speed_kn_; }
  std::optional<GeoPoint> position() const { return position_; }
  std::optional<TrueBearing> heading() const;

  wire::OwnShip own_ship(std::uint32_t radar, UtcTime time) const;

 private:
  bool read_line(std::string_view line);

  std::optional<GeoPoint> position_;
  std::optional<double> heading_deg_, course_deg_, speed_kn_, rate_deg_min_;  // true, over ground
};

}  // namespace skerry::captures
