#include "clients/cli/command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "clients/cli/number_within.hpp"
#include "clients/cli/password_entry.hpp"

namespace skerry::client {
namespace {

// A server with users or tokens says who may; who one is is said here.
std::string advice_for_refusal(const std::string& text, const std::string& otherwise) {
  const auto says = [&](const char* part) { return text.find(part) != std::string::npos; };
  if (says("too many")) return {};  // the server says what to do
  if (says("name and password")) {
    return "skerry user list, beside the server's file of users, has the names; skerry user passwd "
           "gives another password.";
  }
  if (says("token") || says("sign in")) {
    return "Say who you are: --user NAME asks for a password, SKERRY_TOKEN has a token.";
  }
  return otherwise;
}

std::string advice_for(ClientErrorKind kind, const std::string& text) {
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
      return advice_for_refusal(text, "skerry status shows the radars and their settings.");
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
      .add_option("--user", user,
                  "Signs in by this name; the password is asked for, or the first line of a pipe")
      ->envname("SKERRY_USER");
  command
      .add_option("--timeout", timeout_s, "Seconds without an answer or a spoke to give up after")
      ->check(number_within(0.1, 3600.0))
      ->capture_default_str();
}

ClientResult<SpokeClient> ServerPlace::connect() const {
  wire::SignIn who;
  if (!user.empty()) {
    // Before there is a connection: a server ends one that asks for nothing.
    who.set_password(enter_password(user, fmt::format("{}:{}", host, port)));
    who.set_name(user);
  } else if (const char* token = std::getenv("SKERRY_TOKEN")) {
    who.set_token(token);
  }
  auto client = SpokeClient::connect(host, port, timeout());
  if (!client || (user.empty() && who.token().empty())) return client;
  if (auto known = client->sign_in(who, timeout()); !known) return Failure{known.error()};
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

int report_refusal(const ClientError& error, const std::string& advice) {
  if (error.kind != ClientErrorKind::rejected) return report(error);
  return report(error.text, advice_for_refusal(error.text, advice));
}

int report(const ClientError& error) {
  return report(error.text, advice_for(error.kind, error.text));
}

}  // namespace skerry::client
