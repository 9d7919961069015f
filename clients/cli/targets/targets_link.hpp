// What the subcommands of `skerry targets` share: the view, its plotter's lists, orders to it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clients/cli/command.hpp"
#include "protocol/wire/targets.pb.h"

namespace skerry::client {

struct TargetsPlace {
  ServerPlace server;
  ViewChoice choice;
  std::string token;

  void add_options(CLI::App& command);
  Duration timeout() const { return server.timeout(); }
  std::string view_name() const;  // "radar 0 view 0"
};

// A connection that is told of a view's targets twice a second.
class TargetsLink {
 public:
  // Waits for the first list.  Error: as SpokeClient's; timed_out of a server without plotters.
  static ClientResult<TargetsLink> open(const TargetsPlace& place);

  const wire::TargetList& list() const { return list_; }
  const std::string& name() const { return client_.name(); }  // of the server

  // Takes the next list; false if none came within kLookAround.
  // Error: as SpokeClient's; timed_out once none has come for the place's time-out.
  ClientResult<bool> renew();
  // The order gets the view and the token.  Error: as SpokeClient::order_targets().
  ClientResult<wire::Reply> order(wire::TargetOrder order);

 private:
  TargetsLink(SpokeClient client, const TargetsPlace& place);

  SpokeClient client_;
  TargetsPlace place_;
  Clock::time_point heard_ = Clock::now();
  wire::TargetList list_;
};

// Says what the server refused and what to try; gives kExitFailure.
int report_targets(const ClientError& error);
// A command line that cannot be understood; gives kExitUsage.
int misuse_of_targets(const std::string& text);

// Orders the view's plotter, and writes what `tell` makes of the reply.  Gives the exit code.
int order_targets(
    const TargetsPlace& place, const wire::TargetOrder& order,
    const std::function<std::string(const wire::Reply&, const wire::TargetList&)>& tell);
// The same, with one text for what came of it.
int order_targets(const TargetsPlace& place, const wire::TargetOrder& order,
                  const std::string& done);

// `skerry targets`, of which the others are parts.  Where the view and the server are may be given
// before or after a part's name; the options of the list belong to the list alone.
struct TargetsApp {
  CLI::App* app = nullptr;
  std::shared_ptr<TargetsPlace> place = std::make_shared<TargetsPlace>();
  std::vector<CLI::Option*> of_the_list;

  CLI::App* add_part(CLI::App& to, const std::string& name, const std::string& help) const;
  CLI::App* add_part(const std::string& name, const std::string& help) const {
    return add_part(*app, name, help);
  }
};

// The list itself; its command is `targets.app`.
Command make_list_command(TargetsApp& targets);
Command make_target_watch_command(const TargetsApp& targets);
std::vector<Command> make_acquire_commands(const TargetsApp& targets);
std::vector<Command> make_rule_commands(const TargetsApp& targets);
std::vector<Command> make_alert_commands(const TargetsApp& targets);
Command make_trial_command(const TargetsApp& targets);

}  // namespace skerry::client
