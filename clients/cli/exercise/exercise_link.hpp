// What the subcommands of `skerry exercise` share: the server, and an instructor's order to it.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "clients/cli/command.hpp"
#include "protocol/wire/exercise.pb.h"

namespace skerry::client {

struct ExercisePlace {
  ServerPlace server;
  std::string token;

  void add_options(CLI::App& command);
  Duration timeout() const { return server.timeout(); }
};

// The exercise as it is now.  Error: as SpokeClient's.
ClientResult<wire::ExerciseState> exercise_now(SpokeClient& client, const ExercisePlace& place);

// Orders it, and says what the server said; gives the exit code.
int give_order(SpokeClient& client, const ExercisePlace& place, const wire::ExerciseOrder& order);
// The same over a connection of its own.
int give_order(const ExercisePlace& place, const wire::ExerciseOrder& order);

// The ship of that name, or else of that number in the list of own ships or of targets.
// Error: rejected, with the names there are.
ClientResult<const wire::ExerciseShip*> find_ship(const wire::ExerciseState& state,
                                                  const std::string& name, bool own);

// A subcommand with the options of the server's place.  `run` gets the place once it is parsed.
template <typename Run>
Command make_exercise_part(CLI::App& exercise, const std::string& name, const std::string& help,
                           const std::shared_ptr<ExercisePlace>& place, Run run) {
  CLI::App* command = exercise.add_subcommand(name, help);
  place->add_options(*command);
  return {command, [place, run] { return run(*place); }};
}

// Of all of them; `exercise` is the command they are subcommands of.
std::vector<Command> make_clock_commands(CLI::App& exercise);
std::vector<Command> make_keep_commands(CLI::App& exercise);
std::vector<Command> make_ship_commands(CLI::App& exercise);
std::vector<Command> make_fault_commands(CLI::App& exercise);
std::vector<Command> make_look_commands(CLI::App& exercise);

}  // namespace skerry::client
