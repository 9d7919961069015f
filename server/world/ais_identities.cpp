#include "server/world/ais_identities.hpp"

#include <cstdint>
#include <set>

namespace skerry::server {
namespace {

constexpr std::uint32_t kShips = 257'000'001, kOwnShips = 257'900'001;
constexpr std::uint32_t kAids = 992'570'001, kRacons = 992'576'001;

// Hands out numbers upwards from the first, but for those that are taken.
class Numbers {
 public:
  explicit Numbers(std::set<std::uint32_t>& taken) : taken_(taken) {}

  template <typename Bearer>
  void give(Bearer& bearer, std::uint32_t number) {
    if (bearer.has_mmsi()) return;
    while (!taken_.insert(number).second) ++number;
    bearer.set_mmsi(number);
  }

 private:
  std::set<std::uint32_t>& taken_;
};

}  // namespace

bool is_aid(scenario::Target::Kind kind) {
  return kind == scenario::Target::buoy || kind == scenario::Target::reflector_buoy ||
         kind == scenario::Target::channel_marker || kind == scenario::Target::reflector;
}

void fill_in_mmsi(scenario::Scenario& scenario) {
  std::set<std::uint32_t> taken;
  const auto take = [&](const auto& bearers) {
    for (const auto& bearer : bearers) {
      if (bearer.has_mmsi()) taken.insert(bearer.mmsi());
    }
  };
  take(scenario.own_ships());
  take(scenario.targets());
  take(scenario.racons());
  Numbers numbers(taken);
  // Numbered by place in the list, so that a ship keeps her number when another is added behind.
  std::uint32_t place = 0;
  for (auto& ship : *scenario.mutable_own_ships()) numbers.give(ship, kOwnShips + place++);
  place = 0;
  for (auto& target : *scenario.mutable_targets()) {
    numbers.give(target, (is_aid(target.kind()) ? kAids : kShips) + place++);
  }
  place = 0;
  for (auto& racon : *scenario.mutable_racons()) numbers.give(racon, kRacons + place++);
}

}  // namespace skerry::server
