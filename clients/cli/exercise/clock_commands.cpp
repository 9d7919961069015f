// skerry exercise freeze, run, pace, snapshot, restore, undo, mark and text: the exercise as a
// whole.
#include <fmt/format.h>

#include "clients/cli/exercise/exercise_link.hpp"
#include "clients/cli/field_words.hpp"
#include "clients/cli/number_within.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::client {
namespace {

const wire::FieldDescriptor& clock_field(const char* name) {
  return *wire::ClockChange::descriptor()->FindFieldByName(name);
}

Command make_clock_command(CLI::App& exercise, const char* name, const char* help, bool frozen) {
  const auto place = std::make_shared<ExercisePlace>();
  return make_exercise_part(exercise, name, help, place, [frozen](const ExercisePlace& at) {
    wire::ExerciseOrder order;
    order.mutable_clock()->set_frozen(frozen);
    return give_order(at, order);
  });
}

Command make_pace_command(CLI::App& exercise) {
  const auto place = std::make_shared<ExercisePlace>();
  const auto rate = std::make_shared<double>(1.0);
  const Command made = make_exercise_part(exercise, "pace", help_of(clock_field("rate")), place,
                                          [rate](const ExercisePlace& at) {
                                            wire::ExerciseOrder order;
                                            order.mutable_clock()->set_rate(*rate);
                                            return give_order(at, order);
                                          });
  made.app->add_option("RATE", *rate, "Seconds of the exercise a second")
      ->check(CLI::Number)
      ->required();
  return made;
}

// A command that takes one text.
Command make_text_command(CLI::App& exercise, const char* name, const char* help, const char* what,
                          void (wire::ExerciseOrder::*put)(const std::string&)) {
  const auto place = std::make_shared<ExercisePlace>();
  const auto text = std::make_shared<std::string>();
  const Command made =
      make_exercise_part(exercise, name, help, place, [text, put](const ExercisePlace& at) {
        wire::ExerciseOrder order;
        (order.*put)(*text);
        return give_order(at, order);
      });
  made.app->add_option(what, *text)->required();
  return made;
}

Command make_undo_command(CLI::App& exercise) {
  const auto place = std::make_shared<ExercisePlace>();
  return make_exercise_part(
      exercise, "undo",
      "Takes back the last change of targets, faults, own ships' places and weather", place,
      [](const ExercisePlace& at) {
        wire::ExerciseOrder order;
        order.set_undo(true);
        return give_order(at, order);
      });
}

int send_text(const ExercisePlace& place, const std::string& ship, const std::string& text) {
  auto client = place.server.connect();
  if (!client) return report(client.error());
  wire::ExerciseOrder order;
  order.mutable_text()->set_text(text);
  if (ship != "all") {
    const auto state = exercise_now(*client, place);
    if (!state) return report(state.error());
    const auto found = find_ship(*state, ship, true);
    if (!found) return report(found.error());
    order.mutable_text()->set_own_ship((*found)->number());
  }
  return give_order(*client, place, order);
}

Command make_con_text_command(CLI::App& exercise) {
  const auto place = std::make_shared<ExercisePlace>();
  const auto words = std::make_shared<std::pair<std::string, std::string>>();
  const Command made = make_exercise_part(
      exercise, "text", "Shows a text at the con of an own ship, or of all", place,
      [words](const ExercisePlace& at) { return send_text(at, words->first, words->second); });
  made.app->add_option("SHIP", words->first, "Her name or number, or all")->required();
  made.app->add_option("TEXT", words->second)->required();
  return made;
}

}  // namespace

std::vector<Command> make_clock_commands(CLI::App& exercise) {
  return {make_clock_command(exercise, "freeze", "Stops the exercise's clock; radars go on turning",
                             true),
          make_clock_command(exercise, "run", "Lets the exercise's clock go on", false),
          make_pace_command(exercise)};
}

std::vector<Command> make_keep_commands(CLI::App& exercise) {
  return {make_text_command(exercise, "snapshot", "Keeps the whole exercise under a name", "NAME",
                            &wire::ExerciseOrder::set_snapshot),
          make_text_command(exercise, "restore", "Goes back to a snapshot", "NAME",
                            &wire::ExerciseOrder::set_restore),
          make_undo_command(exercise),
          make_text_command(exercise, "mark", "Notes a text on the exercise's time line", "TEXT",
                            &wire::ExerciseOrder::set_mark),
          make_con_text_command(exercise)};
}

}  // namespace skerry::client
