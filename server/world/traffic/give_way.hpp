// Rules of the road: whom a ship has to keep clear of, and how she does.
//
// Source: COLREG 1972, part B.  Rule 13: who comes up on another from more than 22.5 deg abaft her
// beam keeps out of her way.  Rule 14: on reciprocal courses both alter to starboard.  Rule 15: of
// two that cross, the one that has the other on her starboard side keeps out of the way, and does
// not cross ahead.  Rule 16: early, and by much.  Rule 17: the other keeps course and speed.  Rule
// 18: power gives way to sail, and both to who fishes.  Those not in sight of one another go by
// rule 19 instead (restricted_visibility.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/wire/exercise.pb.h"
#include "server/world/traffic/restricted_visibility.hpp"

namespace skerry::server {

// Rule 18, as far as it is looked at: who comes later keeps clear less.
enum class Privilege : std::uint8_t { power, sail, fishing };

// A ship as others see her.
struct SeenShip {
  std::size_t number = 0;
  bool own = false;
  GeoPoint position;
  PlanePoint way;  // velocity over ground, m/s
  double course_deg = 0.0;
  double speed_mps = 0.0;
  double length_m = 0.0;
  Privilege privilege = Privilege::power;
};

enum class Encounter : std::uint8_t {
  none,        // of no concern to her: stands on, or is clear
  overtaking,  // she overtakes
  head_on,
  crossing,    // with the other on her starboard side
  privileged,  // rule 18, or a ship without way
};

// What `ship`, on `course_deg` at her speed, is to do about `other`, whatever the distance.
// `to_other`: the way from her to the other.
Encounter encounter_of(const SeenShip& ship, double course_deg, const SeenShip& other,
                       PlanePoint to_other);

// Nearest point of approach of two that keep their ways.
struct Passing {
  double distance_m = 0.0;
  double time_s = 0.0;  // negative: they have passed
};
Passing passing_of(PlanePoint to_other, PlanePoint own_way, PlanePoint other_way);

// What she does for others, until she looks again.
struct Evasion {
  double alteration_deg = 0.0;  // to starboard of the course of her leg; to port in fog alone
  double share_of_speed = 1.0;
  std::size_t for_number = 0;  // of the ship that she gives way to
  bool for_own = false;
  PlanePoint way_then;  // of that ship, when she began: she may come back to it
};

// Looks round.  `course_deg` and `speed_mps`: what she would do alone; `now`: what she does
// already. Early: nearest point under 0.5 NM and a length of each, within 12 minutes; late: 0.25 NM
// and 3 minutes.  She takes the least alteration by 15 deg, up to 90, that passes clear by a
// margin, of others as well; where none does she slows down, or else takes what is best.  She
// returns when the old course is clear.  She acts for all that she cannot see for fog, by 30 deg or
// more, and to port where rule 19 leaves her no other side or starboard does not pass clear.
std::optional<Evasion> look_round(const SeenShip& ship, double course_deg, double speed_mps,
                                  wire::GiveWay manners, const std::optional<Evasion>& now,
                                  std::span<const SeenShip> others,
                                  const Visibility& visibility = {});

}  // namespace skerry::server
