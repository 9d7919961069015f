// skerry targets rules and zone: what the plotter acquires and warns of.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "clients/cli/console.hpp"
#include "clients/cli/message_options.hpp"
#include "clients/cli/targets/target_words.hpp"
#include "clients/cli/targets/targets_link.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::client {
namespace {

int show_rules(const TargetsPlace& place) {
  auto link = TargetsLink::open(place);
  if (!link) return report_targets(link.error());
  write_out(rules_text(link->list().rules()));
  return kExitOk;
}

Command make_rules_command(const TargetsApp& targets) {
  const auto back = std::make_shared<bool>(false);
  const auto rules = std::make_shared<wire::TargetRules>();
  CLI::App* part =
      targets.add_part("rules", "Changes how the plotter works; without options: shows its rules");
  add_message_options(*part, *rules);
  part->add_flag("--default", *back,
                 "First all of them as they are at the start, and no zones any more");
  part->footer(
      "Examples:\n"
      "  skerry targets rules\n"
      "  skerry targets rules --cpa 0.5 --tcpa 15\n"
      "  skerry targets rules --default --acquire all\n");
  return {part, [place = targets.place, rules, back] {
            if (!*back && rules->ByteSizeLong() == 0) return show_rules(*place);
            wire::TargetOrder order;
            order.set_default_rules(*back);
            if (rules->ByteSizeLong() > 0) *order.mutable_rules() = *rules;
            std::string done = *back ? "all as at the start" : "";
            const std::string changed = rules_in_words(*rules);
            if (!changed.empty()) done += (done.empty() ? "" : "; ") + changed;
            return order_targets(*place, order, done);
          }};
}

Command make_zone_command(const TargetsApp& targets) {
  struct Request {
    wire::TargetZone zone;
    bool excludes = false, remove = false;
  };
  const auto request = std::make_shared<Request>();
  CLI::App* part = targets.add_part(
      "zone", "Lays a zone around own ship, in which targets are acquired and warned of");
  part->add_option_function<std::uint32_t>(
          "NUMBER", [request](std::uint32_t number) { request->zone.set_number(number); },
          wire::allowed_by(
              wire::rule_of(*wire::TargetZone::descriptor()->FindFieldByName("number"))) +
              "; the zone that has the number goes")
      ->required();
  add_message_options(*part, request->zone, {"number", "kind", "relative"});
  auto* const outer = part->get_option("--outer");
  part->add_flag_callback(
      "--relative", [request] { request->zone.set_relative(true); },
      "--from and --to are from the bow, not from north");
  part->add_flag_callback(
      "--excludes", [request] { request->zone.set_kind(wire::TargetZone::EXCLUDES); },
      "In it nothing is acquired by itself");
  part->add_flag("--remove", request->remove, "Takes the zone away")->excludes(outer);
  part->footer(
      "Examples:\n"
      "  skerry targets zone 1 --inner 2 --outer 3                      (a ring)\n"
      "  skerry targets zone 2 --inner 1 --outer 4 --from 300 --to 60 --relative\n"
      "  skerry targets zone 3 --outer 12 --from 60 --to 200 --excludes\n"
      "  skerry targets zone 1 --remove\n");
  return {part, [place = targets.place, request, outer] {
            wire::TargetOrder order;
            if (request->remove) {
              order.add_remove_zones(request->zone.number());
              return order_targets(*place, order,
                                   fmt::format("zone {}: removed", request->zone.number()));
            }
            if (outer->count() == 0) {
              return misuse_of_targets("zone: where does it end? Give --outer, or --remove");
            }
            *order.add_zones() = request->zone;
            return order_targets(*place, order, zone_in_words(request->zone));
          }};
}

}  // namespace

std::vector<Command> make_rule_commands(const TargetsApp& targets) {
  return {make_rules_command(targets), make_zone_command(targets)};
}

}  // namespace skerry::client
