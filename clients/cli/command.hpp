// Parts that the commands of `skerry` share: how they are made, the server's address, how they end.
#pragma once

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "clients/common/client_error.hpp"
#include "clients/common/spoke_client.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::client {

using Clock = std::chrono::steady_clock;  // of deadlines

inline constexpr int kExitOk = 0;
inline constexpr int kExitFailure = 1;  // it could not be done
inline constexpr int kExitUsage = 2;    // the command line cannot be understood

// A subcommand and what it does once it has been parsed; run() returns the exit code.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

// Runs the one of these subcommands that was given.
int run_parsed(const std::vector<Command>& commands);

// A subcommand that is another program beside this one: it gets `before` and what follows.
Command hand_over(CLI::App& app, const char* name, const std::string& description,
                  const char* program, std::vector<std::string> before);

Command make_status_command(CLI::App& app);
Command make_cluster_command(CLI::App& app);
Command make_doctor_command(CLI::App& app);
Command make_snapshot_command(CLI::App& app);
Command make_dump_command(CLI::App& app);
Command make_set_command(CLI::App& app);
Command make_play_command(CLI::App& app);
Command make_record_command(CLI::App& app);
Command make_coast_command(CLI::App& app);
Command make_picture_command(CLI::App& app);
Command make_radar_command(CLI::App& app);
Command make_scenario_command(CLI::App& app);
Command make_exercise_command(CLI::App& app);
Command make_targets_command(CLI::App& app);
Command make_track_command(CLI::App& app);
Command make_token_command(CLI::App& app);
Command make_user_command(CLI::App& app);
Command make_tls_command(CLI::App& app);
Command make_class_command(CLI::App& app);
Command make_audit_command(CLI::App& app);
Command make_traffic_command(CLI::App& app);
Command make_board_command(CLI::App& app);
Command make_recording_command(CLI::App& app);

// The server's address, and how long it may be silent.
struct ServerPlace {
  std::string host = kDefaultHost;
  std::uint16_t port = kDefaultTcpPort;
  double timeout_s = 5.0;
  std::string user;  // who signs in; empty: nobody

  Duration timeout() const { return seconds_as_duration(timeout_s); }
  void add_options(CLI::App& command);
  // Signs in: the user, whose password is asked for; otherwise with the token in the environment's
  // SKERRY_TOKEN, if there is one.
  ClientResult<SpokeClient> connect() const;
};

// Which video is wanted.
struct ViewChoice {
  std::uint32_t radar = 0;
  std::uint32_t view = 0;
};

// Writes the error and what to try to stderr; gives kExitFailure.
int report(const ClientError& error);
int report(const std::string& text, const std::string& advice = {});
// The same of what a server has refused: what to try, unless it is to say who one is.
int report_refusal(const ClientError& error, const std::string& advice);

}  // namespace skerry::client
