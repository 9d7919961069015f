// skerry targets and skerry targets watch: what the plotter of a view tells.
#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "clients/cli/console.hpp"
#include "clients/cli/message_json.hpp"
#include "clients/cli/number_within.hpp"
#include "clients/cli/targets/target_words.hpp"
#include "clients/cli/targets/targets_link.hpp"

namespace skerry::client {
namespace {

struct ListOptions {
  bool json = false, csv = false;
  std::string by = "cpa";
  double wait_s = 0.0;
};

const std::map<std::string, TargetSort>& sorts() {
  static const std::map<std::string, TargetSort> all = {
      {"cpa", TargetSort::cpa}, {"range", TargetSort::range}, {"number", TargetSort::number}};
  return all;
}

// False: interrupted, and nothing is to be shown.
ClientResult<bool> await_target(TargetsLink& link, double wait_s) {
  const auto deadline = Clock::now() + seconds_as_duration(wait_s);
  Progress progress;
  while (link.list().targets().empty() && Clock::now() < deadline) {
    progress.show("no target yet");
    if (const auto came = link.renew(); !came) return Failure{came.error()};
    if (interrupted()) return false;
  }
  return true;
}

int show_targets(const TargetsPlace& place, const ListOptions& options) {
  auto link = TargetsLink::open(place);
  if (!link) return report_targets(link.error());
  const auto waited = await_target(*link, options.wait_s);
  if (!waited) return report_targets(waited.error());
  if (!*waited) return kExitOk;
  const wire::TargetList& list = link->list();
  const TargetSort sort = sorts().at(options.by);
  if (options.json) {
    write_out(json_text(list));
  } else if (options.csv) {
    write_out(targets_csv(list, sort));
  } else {
    write_out(targets_text(list, sort));
    if (list.targets().empty() && list.plots() == 0) {
      fmt::print(stderr,
                 "The plotter has seen no echo yet; it begins when somebody asks for its targets, "
                 "and needs some turns of the antenna: see --wait.\n");
    }
  }
  return kExitOk;
}

int watch_targets(const TargetsPlace& place, double for_s) {
  auto link = TargetsLink::open(place);
  if (!link) return report_targets(link.error());
  write_out(fmt::format("watching {} at {}: {} of {} targets\n", place.view_name(), link->name(),
                        link->list().tracked(), link->list().rules().capacity()));
  const auto begin = Clock::now();
  wire::TargetList before = link->list();
  while (!interrupted()) {
    if (for_s > 0.0 && Clock::now() - begin >= seconds_as_duration(for_s)) return kExitOk;
    const auto came = link->renew();
    if (!came) return report_targets(came.error());
    if (!*came) continue;
    for (const std::string& line : target_changes(before, link->list())) write_out(line + "\n");
    before = link->list();
  }
  return kExitOk;
}

}  // namespace

Command make_list_command(TargetsApp& targets) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App& app = *targets.app;
  targets.place->add_options(app);
  std::vector<std::string> names;
  for (const auto& [name, sort] : sorts()) names.push_back(name);
  auto* const json = app.add_flag("--json", options->json,
                                  "The TargetList message of targets.proto as JSON (64-bit counts "
                                  "are strings, as protobuf writes them)");
  auto* const csv = app.add_flag("--csv", options->csv, "A row for each target")->excludes(json);
  auto* const by =
      app.add_option("--by", options->by, "Which target comes first; CPAs that are past come last")
          ->check(CLI::IsMember(names))
          ->capture_default_str();
  auto* const wait =
      app.add_option("--wait", options->wait_s, "Seconds to wait for a target, if there is none")
          ->check(number_within(0.0, 3600.0))
          ->capture_default_str();
  targets.of_the_list = {json, csv, by, wait};
  return {&app, [place = targets.place, options] { return show_targets(*place, *options); }};
}

Command make_target_watch_command(const TargetsApp& targets) {
  const auto for_s = std::make_shared<double>(0.0);
  CLI::App* watch = targets.add_part(
      "watch", "Writes a line for each change: acquired, lost, alarms; until Ctrl-C");
  watch->add_option("--for", *for_s, "Ends after so many seconds; 0: never")
      ->check(number_within(0.0, 1e6))
      ->capture_default_str();
  return {watch, [place = targets.place, for_s] { return watch_targets(*place, *for_s); }};
}

}  // namespace skerry::client
