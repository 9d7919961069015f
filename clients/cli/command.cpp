#include "clients/cli/command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "clients/cli/number_within.hpp"

namespace skerry::client {
namespace {

std::string advice_for(ClientErrorKind kind) {
  switch (kind) {
    case ClientErrorKind::refused:
    case ClientErrorKind::timed_out:
      return "Is skerryd running? Start it with server/run, or say where it is with --host and "
             "--port.";
    case ClientErrorKind::unreachable:
      return "Check the address and the port; skerryd is started with server/run.";
    case ClientErrorKind::closed:
      return "The server stopped or dropped this client; see its log, start it with server/run and "
             "try again.";
    case ClientErrorKind::rejected:
      return "skerry status shows the radars and their settings.";
    case ClientErrorKind::malformed:
      return fmt::format("Is that the native port of skerryd? Usually it is {}.", kDefaultTcpPort);
  }
  return {};
}

}  // namespace

void ServerPlace::add_options(CLI::App& command) {
  command.add_option("--host", host, "Where skerryd runs; tls://HOST for one with a certificate")
      ->capture_default_str();
  command.add_option("--port", port, "Its native TCP port")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  command
      .add_option("--timeout", timeout_s, "Seconds without an answer or a spoke to give up after")
      ->check(number_within(0.1, 3600.0))
      ->capture_default_str();
}

ClientResult<SpokeClient> ServerPlace::connect() const {
  auto client = SpokeClient::connect(host, port, timeout());
  const char* token = std::getenv("SKERRY_TOKEN");
  if (!client || token == nullptr || *token == '\0') return client;
  if (auto known = client->sign_in(token, timeout()); !known) return Failure{known.error()};
  return client;
}

int run_parsed(const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return kExitUsage;
}

int report(const std::string& text, const std::string& advice) {
  fmt::print(stderr, "skerry: {}\n", text);
  if (!advice.empty()) fmt::print(stderr, "{}\n", advice);
  return kExitFailure;
}

int report(const ClientError& error) { return report(error.text, advice_for(error.kind)); }

}  // namespace skerry::client
