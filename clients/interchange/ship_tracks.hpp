// ShipTracks: where ships were of late, as GeoJSON.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/own_ship.pb.h"

namespace skerry::client {

// Memory: a point each 5 s of the last 6 min, for each ship heard of in that time; at most kMost
// ships, more are left out.
class ShipTracks {
 public:
  static constexpr std::size_t kMost = 10'000;

  explicit ShipTracks(std::uint32_t radar) : radar_(radar) {}

  // Those without a position are left out.
  void add(const wire::OwnShip& ship, UtcTime time);
  // Own ships of that radar are left out: they come by themselves.
  void add(const recording::Traffic& traffic, UtcTime time);

  bool empty() const { return ships_.empty(); }
  // A FeatureCollection (RFC 7946): for each ship a Point with its name, MMSI, heading and speed,
  // and a LineString once she has two positions.  Forgets those not heard of for 6 min.
  std::string geojson(UtcTime now);

 private:
  struct Fix {
    UtcTime time{};
    GeoPoint at;
  };
  struct Ship {
    bool own = false;
    std::string kind, name;
    std::uint32_t mmsi = 0;
    double heading_deg = 0.0, course_deg = 0.0, speed_kn = 0.0;
    bool has_heading = true, has_motion = true;
    Fix last;
    std::deque<Fix> past;  // 5 s apart
  };
  void move(Ship& ship, const Fix& fix);

  std::uint32_t radar_;
  std::map<std::uint64_t, Ship> ships_;  // by number in the traffic; own ship after all of them
};

}  // namespace skerry::client
