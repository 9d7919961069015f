#include "server/app/fleet/world_digest.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>

#include "protocol/digest/digest.hpp"

namespace skerry::server {
namespace {

class WorldBytes {
 public:
  void add(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8)
      bytes_.push_back(static_cast<char>(value >> shift & 0xFF));
  }
  void add(std::initializer_list<double> values) {
    for (const double value : values) add(std::bit_cast<std::uint64_t>(value));
  }
  void add(const GeoPoint& at) { add({at.latitude_deg, at.longitude_deg}); }
  void add(const ShipState& ship) {
    add(ship.position);
    add({ship.heading_deg, ship.course_over_ground_deg, ship.speed_mps, ship.rate_of_turn_deg_s,
         ship.ordered_course_deg, ship.ordered_speed_mps, ship.pace});
    add(std::uint64_t{ship.aground} | std::uint64_t{ship.sart} << 1 |
        std::uint64_t{ship.ais_off} << 2);
    if (!ship.con) return;
    const ConState& con = *ship.con;
    add({con.rudder_deg, con.rudder_order_deg, con.shaft_rps, con.engine_percent, con.bow_percent,
         con.stern_percent, con.heading_order_deg, con.depth_below_keel_m});
    add(std::uint64_t{con.waypoint});
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace

fleet::WorldDigest world_digest(const WorldState& state) {
  WorldBytes bytes;
  bytes.add(static_cast<std::uint64_t>(state.time.time_since_epoch().count()));
  bytes.add(static_cast<std::uint64_t>(state.exercise.count()));
  bytes.add({state.pace, state.rate, state.water_level_m});
  bytes.add(state.log->orders);
  for (const ShipState& ship : state.own_ships) bytes.add(ship);
  for (const ShipState& ship : state.targets) bytes.add(ship);
  for (const SmallTargetState& small : state.adrift) bytes.add(small.position);
  for (const SartState& sart : state.sarts) bytes.add(sart.position);
  for (const RainState& rain : state.rain) bytes.add(rain.centre);
  Sha256 sha;
  sha.add(std::string_view(bytes.bytes()));
  const std::string digest = sha.take();
  fleet::WorldDigest out{};
  std::copy_n(digest.begin(), std::min(digest.size(), out.size()), out.begin());
  return out;
}

}  // namespace skerry::server
