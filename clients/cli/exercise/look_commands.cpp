// skerry exercise show and watch: the exercise as it really is.
#include <fmt/format.h>

#include <variant>

#include "clients/cli/console.hpp"
#include "clients/cli/exercise/exercise_link.hpp"
#include "clients/cli/exercise/exercise_words.hpp"
#include "clients/cli/message_json.hpp"

namespace skerry::client {
namespace {

int show_exercise(const ExercisePlace& place, bool as_json) {
  auto client = place.server.connect();
  if (!client) return report(client.error());
  const auto state = exercise_now(*client, place);
  if (!state) return report(state.error());
  write_out(as_json ? json_text(*state) : exercise_text(*state));
  return kExitOk;
}

int watch_exercise(const ExercisePlace& place, std::uint64_t most) {
  auto client = place.server.connect();
  if (!client) return report(client.error());
  auto before = exercise_now(*client, place);
  if (!before) return report(before.error());
  // What there is, so that a reader knows from when on changes are told.
  write_out(fmt::format("watching {}\n", client->name()));
  auto heard = Clock::now();
  std::uint64_t lines = 0;
  while (!interrupted()) {
    auto event = client->receive(kLookAround);
    if (!event) return report(event.error());
    if (Clock::now() - heard > place.timeout()) {
      return report(fmt::format("{} told nothing of its exercise for {:g} s", client->name(),
                                place.server.timeout_s));
    }
    if (!*event) continue;
    auto* const state = std::get_if<wire::ExerciseState>(&**event);
    if (state == nullptr) continue;
    heard = Clock::now();
    for (const std::string& line : exercise_changes(*before, *state)) {
      write_out(line + "\n");
      if (++lines == most) return kExitOk;
    }
    *before = std::move(*state);
  }
  return kExitOk;
}

}  // namespace

std::vector<Command> make_look_commands(CLI::App& exercise) {
  const auto show_place = std::make_shared<ExercisePlace>();
  const auto as_json = std::make_shared<bool>(false);
  const Command show = make_exercise_part(
      exercise, "show", "Shows the clock, ships, faults, snapshots and what has happened",
      show_place, [as_json](const ExercisePlace& place) { return show_exercise(place, *as_json); });
  show.app->add_flag("--json", *as_json,
                     "The ExerciseState message of exercise.proto as JSON (64-bit counts are "
                     "strings, as protobuf writes them)");

  const auto watch_place = std::make_shared<ExercisePlace>();
  const auto most = std::make_shared<std::uint64_t>(0);
  const Command watch = make_exercise_part(
      exercise, "watch", "Writes a line for each change, until Ctrl-C", watch_place,
      [most](const ExercisePlace& place) { return watch_exercise(place, *most); });
  watch.app->add_option("--count", *most, "Ends after so many lines; 0: never")
      ->capture_default_str();
  return {show, watch};
}

}  // namespace skerry::client
