// skerry exercise target and put: ships that are added, ordered, removed and put elsewhere.
#include <fmt/format.h>

#include "clients/cli/exercise/exercise_link.hpp"
#include "clients/cli/exercise/waypoint_option.hpp"
#include "clients/cli/message_options.hpp"

namespace skerry::client {
namespace {

// What a command has been given of one ship.
template <typename Change>
struct ShipRequest {
  std::string ship;
  Change change;
  std::vector<std::string> waypoints;
};

int refuse_ship_request(const std::string& text) {
  report(text);
  return kExitUsage;
}

// The first fault of the texts, if they have one.
template <typename Change>
std::optional<std::string> add_waypoints(const std::vector<std::string>& texts, Change& change) {
  for (const std::string& text : texts) {
    if (auto wrong = read_waypoint(text, *change.add_route())) return wrong;
  }
  return std::nullopt;
}

// `put` lays the change, whose ship has this number, into the order.
template <typename Put>
int order_ship(const ExercisePlace& place, const std::string& ship, bool own, Put put) {
  auto client = place.server.connect();
  if (!client) return report(client.error());
  const auto state = exercise_now(*client, place);
  if (!state) return report(state.error());
  const auto found = find_ship(*state, ship, own);
  if (!found) return report(found.error());
  wire::ExerciseOrder order;
  put(order, (*found)->number());
  return give_order(*client, place, order);
}

Command make_add_command(CLI::App& target) {
  const auto place = std::make_shared<ExercisePlace>();
  const auto request = std::make_shared<ShipRequest<wire::NewTarget>>();
  const Command made = make_exercise_part(
      target, "add", "Adds a ship to the targets", place, [request](const ExercisePlace& at) {
        wire::ExerciseOrder order;
        *order.mutable_new_target() = request->change;
        if (const auto wrong = add_waypoints(request->waypoints, *order.mutable_new_target())) {
          return refuse_ship_request(*wrong);
        }
        return give_order(at, order);
      });
  add_message_options(*made.app, request->change);
  made.app->get_option("--latitude")->required();
  made.app->get_option("--longitude")->required();
  add_waypoint_option(*made.app, request->waypoints);
  made.app->footer(
      "Example:\n"
      "  skerry exercise target add --name Foe --ship-class coaster --latitude 60.4 --longitude "
      "5.1 "
      "--course 270 --speed 12\n");
  return made;
}

Command make_order_command(CLI::App& target) {
  const auto place = std::make_shared<ExercisePlace>();
  const auto request = std::make_shared<ShipRequest<wire::TargetChange>>();
  const Command made = make_exercise_part(
      target, "order", "Orders a target", place, [request](const ExercisePlace& at) {
        wire::TargetChange change = request->change;
        if (const auto wrong = add_waypoints(request->waypoints, change)) {
          return refuse_ship_request(*wrong);
        }
        if (change.ByteSizeLong() == 0) {
          return refuse_ship_request(
              "target order: nothing is ordered; give at least one option, see --help");
        }
        return order_ship(at, request->ship, false,
                          [&](wire::ExerciseOrder& order, std::uint32_t number) {
                            change.set_target(number);
                            *order.mutable_target() = change;
                          });
      });
  made.app->add_option("SHIP", request->ship, "Her name or number")->required();
  add_message_options(*made.app, request->change, {"target"});
  add_waypoint_option(*made.app, request->waypoints);
  made.app->footer(
      "Examples:\n"
      "  skerry exercise target order Foe --course 045 --speed 8\n"
      "  skerry exercise target order Foe --waypoint 60.4,5.1,speed=10 --waypoint "
      "60.5,5.1,stop-min=20 "
      "--route-end back\n"
      "  skerry exercise target order Foe --resume on\n");
  return made;
}

Command make_remove_command(CLI::App& target) {
  const auto place = std::make_shared<ExercisePlace>();
  const auto ship = std::make_shared<std::string>();
  const Command made = make_exercise_part(
      target, "remove", "Takes a target off the water; order --removed off puts her back", place,
      [ship](const ExercisePlace& at) {
        return order_ship(at, *ship, false, [](wire::ExerciseOrder& order, std::uint32_t number) {
          order.mutable_target()->set_target(number);
          order.mutable_target()->set_removed(true);
        });
      });
  made.app->add_option("SHIP", *ship, "Her name or number")->required();
  return made;
}

Command make_target_command(CLI::App& exercise) {
  CLI::App* target = exercise.add_subcommand("target", "Adds, orders and removes targets");
  target->require_subcommand(1);
  const std::vector<Command> parts = {make_add_command(*target), make_order_command(*target),
                                      make_remove_command(*target)};
  return {target, [parts] { return run_parsed(parts); }};
}

Command make_put_command(CLI::App& exercise) {
  const auto place = std::make_shared<ExercisePlace>();
  const auto request = std::make_shared<ShipRequest<wire::OwnShipPut>>();
  const Command made =
      make_exercise_part(exercise, "put", "Puts an own ship elsewhere, at once", place,
                         [request](const ExercisePlace& at) {
                           return order_ship(at, request->ship, true,
                                             [&](wire::ExerciseOrder& order, std::uint32_t number) {
                                               *order.mutable_own_ship() = request->change;
                                               order.mutable_own_ship()->set_own_ship(number);
                                             });
                         });
  made.app->add_option("SHIP", request->ship, "Her name or number")->required();
  add_message_options(*made.app, request->change, {"own_ship"});
  return made;
}

}  // namespace

std::vector<Command> make_ship_commands(CLI::App& exercise) {
  return {make_target_command(exercise), make_put_command(exercise)};
}

}  // namespace skerry::client
