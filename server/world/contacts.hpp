// Contacts: own ships that touch other ships.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/world/traffic/traffic.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Looks at the outlines (hull_outline.hpp) of own ships and of all ships on the water, over the way
// that they make in a step: none is jumped over at any pace, but for what a ship turns in one step
// (2 deg).  A contact is told once until the two have parted, which is when their outlines are
// kClear_m apart.  A ship that is put somewhere (more than kMostStep_m in a step) has sailed no
// way.
//
// Only pairs that can come together before the next search, kSearch steps later, are looked at;
// what is found is the same, unless a target is put from afar by her route's end: up to 5 s later.
// A copy is a snapshot.  Thread: one at a time.
class Contacts {
 public:
  static constexpr double kClear_m = 10.0, kMostStep_m = 15.0;
  static constexpr std::int64_t kSearch = 50;  // steps of 0.1 s

  // After the step that ended at `now`.  New contacts, by own ship.
  std::vector<Contact> look(Duration now, Duration step, const std::vector<ShipState>& own_ships,
                            const Traffic& traffic);
  // A ship was put, ordered or taken away: pairs are searched for with the next look.
  void search_anew() { left_ = 0; }

 private:
  struct Pair {
    std::size_t own = 0;
    bool other_own = false;
    std::size_t other = 0;  // number in its list
    bool looked = false;    // `way` is that of the look before
    PlanePoint way;         // from the own ship to the other
    bool touching = false;
  };
  void search(const std::vector<ShipState>& own_ships, const std::vector<ShipState>& targets);
  static bool look(Pair& pair, const ShipState& own, const ShipState& other, double& share);

  std::vector<Pair> pairs_;  // by own ship, then by other
  std::int64_t left_ = 0;    // steps until the next search
};

}  // namespace skerry::server
