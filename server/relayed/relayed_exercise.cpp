#include "server/relayed/relayed_exercise.hpp"

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/relayed/sailed_on.hpp"

namespace skerry::server {
namespace {

void renumber(wire::ExerciseShip& ship, const std::map<std::uint32_t, std::uint32_t>& radars) {
  std::vector<std::uint32_t> played;
  for (const std::uint32_t recorded : ship.radars()) {
    const auto found = radars.find(recorded);
    if (found != radars.end()) played.push_back(found->second);
  }
  ship.mutable_radars()->Assign(played.begin(), played.end());
}

void shorten(wire::ExerciseState& state) {
  if (state.ByteSizeLong() <= kMostExercise) return;
  for (wire::ExerciseShip& ship : *state.mutable_ships()) ship.clear_route();
  for (std::size_t bytes = state.ByteSizeLong(); bytes > kMostExercise && !state.ships().empty();) {
    bytes -= state.ships().rbegin()->ByteSizeLong();  // and some of its tag and length
    state.mutable_ships()->RemoveLast();
  }
}

bool is_ship(const TrafficItem& item) {
  return item.kind == TrafficKind::ship || item.kind == TrafficKind::boat;
}

void tell(const TrafficItem& item, wire::ExerciseShip& ship) {
  ship.set_number(item.number);
  ship.set_own(!item.radars.empty());
  ship.set_name(item.name);
  ship.set_latitude_deg(item.position.latitude_deg);
  ship.set_longitude_deg(item.position.longitude_deg);
  ship.set_heading_deg(item.heading_deg);
  ship.set_course_over_ground_deg(item.course_over_ground_deg);
  ship.set_speed_kn(item.speed_mps / kKnot);
  ship.set_rate_of_turn_deg_min(item.rate_of_turn_deg_min);
  ship.set_length_m(item.length_m);
  ship.set_beam_m(item.beam_m);
  ship.set_mmsi(item.mmsi);
  for (const std::uint32_t radar : item.radars) ship.add_radars(radar);
}

}  // namespace

void make_tellable(wire::ExerciseState& state,
                   const std::map<std::uint32_t, std::uint32_t>& radars) {
  state.clear_can_undo();
  state.clear_snapshots();
  state.clear_played_marks();
  for (wire::ExerciseShip& ship : *state.mutable_ships()) renumber(ship, radars);
  shorten(state);
}

void sail_on(wire::ExerciseState& state, double since_s) {
  if (state.frozen() || since_s <= 0.0) return;
  const double exercise_s = since_s * state.rate();
  state.set_exercise_s(state.exercise_s() + exercise_s);
  for (wire::ExerciseShip& ship : *state.mutable_ships()) {
    if (ship.removed()) continue;
    const GeoPoint place =
        moved({ship.latitude_deg(), ship.longitude_deg()}, ship.course_over_ground_deg(),
              ship.speed_kn() * kKnot * exercise_s);
    ship.set_latitude_deg(place.latitude_deg);
    ship.set_longitude_deg(place.longitude_deg);
    ship.set_heading_deg(
        wrapped_degrees(ship.heading_deg() + ship.rate_of_turn_deg_min() / 60.0 * exercise_s));
  }
}

wire::ExerciseState exercise_of_traffic(const std::vector<TrafficItem>& items, double position_s) {
  wire::ExerciseState state;
  state.set_exercise_s(position_s);
  state.set_rate(1.0);
  for (const bool own : {true, false}) {
    for (const TrafficItem& item : items) {
      if (is_ship(item) && item.radars.empty() != own) tell(item, *state.add_ships());
    }
  }
  shorten(state);
  return state;
}

}  // namespace skerry::server
