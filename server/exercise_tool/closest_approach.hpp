// How near ships came to each other.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "server/world/world_state.hpp"

namespace skerry::server {

struct ClosestApproach {
  std::string own_ship, other;
  double closest_m = 0.0;  // between the ships' middles
  Duration when{};         // on the exercise's clock
};

// Of each own ship with every other ship, looked at whenever look() is called.
class ClosestApproaches {
 public:
  void look(const WorldState& state);
  // Nearest first.
  std::vector<ClosestApproach> nearest() const;

 private:
  void look(const ShipState& own, const ShipState& other, Duration now);

  std::map<std::pair<std::string, std::string>, ClosestApproach> approaches_;
};

// Metres between the middles of two ships.
double metres_apart(const ShipState& a, const ShipState& b);

}  // namespace skerry::server
