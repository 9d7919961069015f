#include "clients/cli/exercise/exercise_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <variant>

#include "clients/cli/console.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

constexpr std::uint32_t kTimesASecond = 4;  // so that the first comes soon

// What to try where the server has said no.
int report_exercise(const ClientError& error) {
  return report_refusal(error, "skerry exercise show tells what there is.");
}

}  // namespace

void ExercisePlace::add_options(CLI::App& command) {
  server.add_options(command);
  command.add_option("--token", token, "Needed from another host than the server's")
      ->envname("SKERRY_TOKEN");
}

ClientResult<wire::ExerciseState> exercise_now(SpokeClient& client, const ExercisePlace& place) {
  if (auto watched = client.watch_exercise(kTimesASecond, place.timeout(), place.token); !watched) {
    return Failure{watched.error()};
  }
  const auto deadline = Clock::now() + place.timeout();
  while (Clock::now() < deadline) {
    auto event = client.receive(kLookAround);
    if (!event) return Failure{event.error()};
    if (!*event) continue;
    if (auto* const state = std::get_if<wire::ExerciseState>(&**event)) return std::move(*state);
  }
  return failure(ClientErrorKind::timed_out,
                 fmt::format("{} told nothing of its exercise within {:g} s", client.name(),
                             place.server.timeout_s));
}

int give_order(SpokeClient& client, const ExercisePlace& place, const wire::ExerciseOrder& order) {
  wire::Set request;
  request.set_instructor(true);
  request.set_token(place.token);
  *request.mutable_exercise() = order;
  const auto reply = client.set(request, place.timeout());
  if (!reply) return report_exercise(reply.error());
  write_out(reply->text().empty() ? "OK\n" : fmt::format("OK: {}\n", printable(reply->text())));
  return kExitOk;
}

int give_order(const ExercisePlace& place, const wire::ExerciseOrder& order) {
  auto client = place.server.connect();
  if (!client) return report(client.error());
  return give_order(*client, place, order);
}

ClientResult<const wire::ExerciseShip*> find_ship(const wire::ExerciseState& state,
                                                  const std::string& name, bool own) {
  std::string names;
  const wire::ExerciseShip* by_number = nullptr;
  char* end = nullptr;
  const unsigned long number = std::strtoul(name.c_str(), &end, 10);
  const bool is_number = !name.empty() && *end == '\0';
  for (const wire::ExerciseShip& ship : state.ships()) {
    if (ship.own() != own) continue;
    if (ship.name() == name) return &ship;
    if (is_number && ship.number() == number) by_number = &ship;
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", ship.number(), ship.name());
  }
  if (by_number != nullptr) return by_number;
  return failure(
      ClientErrorKind::rejected,
      fmt::format("there is no {} '{}'; there {}", own ? "own ship" : "target", printable(name, 64),
                  names.empty() ? "is none" : "are " + printable(names, 2000)));
}

}  // namespace skerry::client
