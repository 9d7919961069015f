#include <fmt/format.h>

#include <map>
#include <set>

#include "server/world/exercise_events.hpp"

namespace skerry::server {
namespace {

// What events may name.
struct EventNames {
  std::set<std::string> own_ships, targets, areas, events;
};

class EventChecker {
 public:
  EventChecker(const scenario::Scenario& scenario, YamlSource& source)
      : scenario_(scenario), source_(source) {
    for (const auto& ship : scenario.own_ships()) names_.own_ships.insert(ship.name());
    for (const auto& target : scenario.targets()) {
      if (target.kind() == scenario::Target::ship) names_.targets.insert(target.name());
    }
  }

  void check() {
    check_count(scenario_.areas_size(), kMaxAreas, "areas");
    for (int i = 0; i < scenario_.areas_size(); ++i) {
      check_area(scenario_.areas(i), fmt::format("areas[{}]", i));
    }
    check_count(scenario_.events_size(), kMaxEvents, "events");
    for (int i = 0; i < scenario_.events_size(); ++i) {
      check_event(scenario_.events(i), fmt::format("events[{}]", i));
    }
  }

 private:
  void check_count(int count, int most, const std::string& path) const {
    if (count <= most) return;
    source_.refuse(path, fmt::format("{} entries; allowed: at most {}", count, most));
  }

  void check_new(const std::string& name, const std::string& path, std::set<std::string>& names) {
    if (!source_.is_sound(path + ".name") || names.insert(name).second) return;
    source_.refuse(path + ".name", fmt::format("\"{}\" is there already; names must differ", name));
  }

  void check_area(const scenario::Area& area, const std::string& path) {
    check_new(area.name(), path, names_.areas);
    if (area.has_centre() != (area.corners_size() == 0)) {
      source_.refuse(path,
                     "an area is a centre with a radius_nm or a list of corners; allowed: "
                     "one of the two");
    } else if (!area.has_centre() &&
               (area.corners_size() < 3 || area.corners_size() > kMaxCorners)) {
      source_.refuse(path + ".corners",
                     fmt::format("{} corners; allowed: 3 to {}", area.corners_size(), kMaxCorners));
    }
  }

  void check_name(const std::string& name, const std::string& path, const char* what,
                  std::initializer_list<const std::set<std::string>*> allowed) const {
    if (!source_.is_sound(path)) return;
    std::string list;
    int count = 0;
    for (const auto* names : allowed) {
      if (names->contains(name)) return;
      for (const std::string& each : *names) {
        if (++count <= 20) list += (list.empty() ? "" : ", ") + each;
      }
    }
    if (count > 20) list += fmt::format(" and {} more", count - 20);
    source_.refuse(path, fmt::format("there is no {} \"{}\"; allowed: {}", what, printable(name),
                                     list.empty() ? "none is there" : list));
  }

  void check_event(const scenario::Event& event, const std::string& path) {
    if (event.has_after()) {
      check_name(event.after(), path + ".after", "event before this one called", {&names_.events});
    }
    check_new(event.name(), path, names_.events);
    if (!event.has_at_min() && !event.has_after() && !event.has_ship() && !event.has_collides() &&
        !event.has_grounds()) {
      source_.refuse(path, fmt::format("the event \"{}\" says not when; expected at_min, after, "
                                       "collides, grounds or ship with a condition",
                                       printable(event.name())));
    }
    const bool asks = event.has_within_of() || event.has_enters() || event.has_faster_than_kn() ||
                      event.has_slower_than_kn();
    if (event.has_ship()) {
      check_name(event.ship(), path + ".ship", "ship", {&names_.own_ships, &names_.targets});
      if (!asks) {
        source_.refuse(path + ".ship",
                       "given without a condition; expected within_of, enters, "
                       "faster_than_kn or slower_than_kn besides");
      }
    } else if (asks) {
      source_.refuse(path, "a condition without the ship it is about; expected ship besides");
    }
    if (event.has_within_of()) {
      check_name(event.within_of(), path + ".within_of", "ship",
                 {&names_.own_ships, &names_.targets});
    }
    if (event.has_collides()) {
      check_name(event.collides(), path + ".collides", "ship",
                 {&names_.own_ships, &names_.targets});
    }
    if (event.has_grounds()) {
      check_name(event.grounds(), path + ".grounds", "own ship", {&names_.own_ships});
    }
    if (event.has_enters()) check_name(event.enters(), path + ".enters", "area", {&names_.areas});
    for (int i = 0; i < event.targets_size(); ++i) {
      check_name(event.targets(i).target_name(), fmt::format("{}.targets[{}].target_name", path, i),
                 "ship among the targets called", {&names_.targets});
    }
    for (int i = 0; i < event.own_ships_size(); ++i) {
      check_name(event.own_ships(i).own_ship(), fmt::format("{}.own_ships[{}].own_ship", path, i),
                 "own ship", {&names_.own_ships});
    }
  }

  const scenario::Scenario& scenario_;
  YamlSource& source_;
  EventNames names_;
};

}  // namespace

void check_events(const scenario::Scenario& scenario, YamlSource& source) {
  EventChecker(scenario, source).check();
}

}  // namespace skerry::server
