#include "server/exercise_tool/new_scenario.hpp"

#include <fmt/format.h>

#include "server/world/rhumb_step.hpp"

namespace skerry::server {
namespace {

std::string at(GeoPoint from, double bearing_deg, double range_nm) {
  const GeoPoint place = advanced(from, bearing_deg, range_nm * 1852.0).position;
  return fmt::format("{{lat: {:.5f}, lon: {:.5f}}}", place.latitude_deg, place.longitude_deg);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string head(const std::string& name, const char* what, double state, GeoPoint place) {
  return fmt::format(
      "# {}\n"
      "# All keys: server/world/SCENARIO.md.  Try it: skerry scenario check, skerry scenario run.\n"
      "name: {}\n"
      "seed: 1                      # everything random follows from it\n"
      "\n"
      "sea: {{state: {}, wind_from_deg: 240}}\n"
      "\n"
      "own_ships:\n"
      "  - name: Alfa\n"
      "    ship_class: coaster      # she answers rudder, engine, wind and current like one\n"
      "    position: {}\n"
      "    course_deg: 0\n"
      "    speed_kn: 10\n"
      "    radars: [{{name: Alfa X, range_nm: 6}}]\n"
      "\n",
      what, quoted(name), state, at(place, 0.0, 0.0));
}

std::string sheet(const char* goal, const char* answer, const std::string& checks) {
  return fmt::format(
      "\n"
      "exercise:\n"
      "  goal: {}\n"
      "  briefing: You have the watch on Alfa.  Say what you see, and what you do.\n"
      "  answers:                   # what the instructor expects to hear\n"
      "    - \"{}\"\n"
      "  length_min: 20\n"
      "  checks:                    # what skerry scenario run --checks looks at\n{}",
      goal, answer, checks);
}

std::string open_sea(const std::string& name, GeoPoint p) {
  return head(name, "The open sea: a ship crosses from starboard.", 2, p) +
         fmt::format(
             "targets:\n"
             "  - name: Bravo              # on a steady bearing\n"
             "    ship_class: container\n"
             "    position: {}\n"
             "    course_deg: 270\n"
             "    speed_kn: 10\n"
             "  - {{name: Charlie, ship_class: fishing, position: {}, fishes_within_nm: 1}}\n"
             "\n"
             "events:\n"
             "  - {{name: wind rises, at_min: 10, weather: {{wind_kn: 20}}, mark: The wind "
             "rises}}\n",
             at(p, 45.0, 4.5), at(p, 300.0, 4.0)) +
         sheet("See the ship that crosses and keep clear of her.",
               "Bravo comes from starboard on a steady bearing: Alfa gives way.",
               "    - {at_min: 1, says: both are seen, sees: [Bravo, Charlie]}\n"
               "    - {at_min: 12, event: wind rises}\n");
}

std::string fairway(const std::string& name, GeoPoint p) {
  std::string marks;
  for (int i = 0; i < 4; ++i) {
    marks += fmt::format(
        "  - {{name: Green {}, kind: reflector_buoy, position: {}}}\n"
        "  - {{name: Red {}, kind: reflector_buoy, position: {}}}\n",
        2 * i + 1, at(advanced(p, 0.0, 1852.0 * (1.0 + i)).position, 90.0, 0.2), 2 * i + 2,
        at(advanced(p, 0.0, 1852.0 * (1.0 + i)).position, 270.0, 0.2));
  }
  return head(name, "A buoyed fairway to the north, with a ship that comes out of it.", 1, p) +
         fmt::format(
             "targets:\n"
             "  - name: Bravo              # outward bound\n"
             "    ship_class: coaster\n"
             "    position: {}\n"
             "    waypoints: [{}]\n"
             "    speed_kn: 9\n"
             "{}"
             "\n"
             "racons: [{{name: Landfall, position: {}, code: K}}]\n",
             at(advanced(p, 0.0, 1852.0 * 5.5).position, 270.0, 0.08),
             at(advanced(p, 180.0, 1852.0 * 2.0).position, 270.0, 0.15), marks, at(p, 0.0, 4.6)) +
         sheet("Keep to the starboard side of the fairway.", "Bravo is met port to port.",
               "    - {at_min: 1, says: ship and buoys are seen, range_nm: 3, sees: [Green 3, Red "
               "4]}\n"
               "    - {at_min: 2, sees: [Bravo]}\n");
}

std::string anchorage(const std::string& name, GeoPoint p) {
  return head(name, "A ship makes for an anchorage.", 1, p) +
         fmt::format(
             "targets:\n"
             "  - {{name: Bravo, ship_class: tanker, position: {}, anchored: true}}\n"
             "  - {{name: Charlie, ship_class: coaster, position: {}, anchored: true}}\n"
             "\n"
             "traffic:                     # more ships, laid out by chance\n"
             "  - {{name: Anchored, kind: anchorage, count: 8, from: {}, radius_nm: 1.5}}\n",
             at(p, 20.0, 3.0), at(p, 340.0, 3.5), at(p, 0.0, 5.5)) +
         sheet("Find a free berth among the ships at anchor.", "Bravo and Charlie lie still.",
               "    - {at_min: 1, says: the nearest are seen, sees: [Bravo, Charlie]}\n");
}

}  // namespace

std::vector<std::string> scenario_templates() { return {"open", "fairway", "anchorage"}; }

std::optional<std::string> new_scenario(const std::string& scheme, const std::string& name,
                                        GeoPoint place) {
  if (scheme == "open") return open_sea(name, place);
  if (scheme == "fairway") return fairway(name, place);
  if (scheme == "anchorage") return anchorage(name, place);
  return std::nullopt;
}

}  // namespace skerry::server
