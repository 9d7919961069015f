// Collisions and groundings, as the world tells them.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "server/world/handling/ship_class.hpp"
#include "server/world/hull_outline.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

std::string mishap_text(const Contact& contact) {
  const std::string place =
      fmt::format("at {:.5f}, {:.5f}, {:.1f} kn", contact.position.latitude_deg,
                  contact.position.longitude_deg, contact.relative_mps / knots_in_mps(1.0));
  return contact.kind == Contact::Kind::collision
             ? fmt::format("{} and {} {}", contact.own_name, contact.other_name, place)
             : fmt::format("{} {}: {}", contact.own_name, place, contact.why);
}

Contact grounding_of(const ShipState& ship, std::size_t number, Duration when, std::string why) {
  Contact contact;
  contact.kind = Contact::Kind::grounding;
  contact.when = when;
  contact.own_ship = number;
  contact.own_name = ship.name;
  contact.position = ship.position;
  contact.relative_mps = std::fabs(ship.speed_mps);
  contact.why = std::move(why);
  return contact;
}

// Empty: she floats.
std::string why_aground(const ShipState& ship, const Environment& environment) {
  if (ship.con->depth_below_keel_m <= 0.0) {
    const double draught_m = ship.con->ship_class->hull->draught_m();
    return fmt::format("{:.1f} m of water, draught {:.1f} m",
                       ship.con->depth_below_keel_m + draught_m, draught_m);
  }
  if (!environment.banks) return {};
  const HullOutline outline = hull_outline(ship.length_m, ship.beam_m, ship.heading_deg);
  const std::string* const bank = environment.banks->touched_by(ship.position, outline);
  return bank == nullptr ? "" : *bank;
}

}  // namespace

bool World::record(Contact contact) {
  const bool collision = contact.kind == Contact::Kind::collision;
  part_.contacts.search_anew();
  if (collision) {
    part_.events.collided(contact.own_name);
    part_.events.collided(contact.other_name);
  } else {
    part_.events.grounded(contact.own_name);
  }
  mark(collision ? "collision" : "grounding", mishap_text(contact), contact.when);
  bool stops = false;
  for (const int mishap : part_.scenario->exercise().freeze_on()) {
    stops = stops || mishap == (collision ? scenario::ExerciseSheet::collision
                                          : scenario::ExerciseSheet::grounding);
  }
  ExerciseLog& log = this->log();
  if (log.contacts.size() >= ExerciseLog::kMaxMarks) log.contacts.erase(log.contacts.begin());
  log.contacts.push_back(std::move(contact));
  if (stops) part_.clock.frozen = true;
  return stops;
}

void World::look_for_mishaps(Duration now) {
  std::vector<ShipState> ships;
  ships.reserve(part_.own_ships.size());
  for (const OwnShip& ship : part_.own_ships) ships.push_back(ship.state());
  bool stops = false;
  for (Contact& contact : part_.contacts.look(now, kTick, ships, part_.traffic)) {
    stops = record(std::move(contact)) || stops;
  }
  for (std::size_t i = 0; i < ships.size(); ++i) {
    const ShipState& ship = ships[i];
    if (!ship.con || ship.driven || ship.aground) continue;
    const std::string why = why_aground(ship, *part_.environment);
    if (why.empty()) continue;
    stops = record(grounding_of(ship, i, now, why)) || stops;
    part_.own_ships[i].run_aground(ship);
  }
  // The clock stops where this step ended, not where the tick on the air does.
  if (stops) part_.clock.now = now;
}

std::string World::ground(std::size_t own_ship) {
  const ShipState ship = own_ship_at(own_ship);
  std::string what = fmt::format("{} aground", ship.name);
  if (ship.aground) return what;
  record(grounding_of(ship, own_ship, part_.clock.now, "the shore"));
  if (!ship.driven) part_.own_ships[own_ship].run_aground(ship);
  return what;
}

}  // namespace skerry::server
