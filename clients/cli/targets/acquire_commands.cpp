// skerry targets acquire, cancel, reference, test and ais: which targets are looked after.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "clients/cli/console.hpp"
#include "clients/cli/message_options.hpp"
#include "clients/cli/number_within.hpp"
#include "clients/cli/targets/targets_link.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using Numbers = std::vector<std::uint32_t>;

std::string in_words(const Numbers& numbers) { return fmt::format("{}", fmt::join(numbers, ", ")); }

// While there is no echo it is asked again with each list.
int acquire(const TargetsPlace& place, const wire::TargetOrder& order, double wait_s) {
  auto link = TargetsLink::open(place);
  if (!link) return report_targets(link.error());
  const auto deadline = Clock::now() + seconds_as_duration(wait_s);
  Progress progress;
  for (;;) {
    const auto reply = link->order(order);
    if (reply) {
      progress.clear();
      write_out(fmt::format("target {} is tracked\n", printable(reply->text(), 20)));
      return kExitOk;
    }
    const bool no_echo = reply.error().kind == ClientErrorKind::rejected &&
                         reply.error().code == wire::Reply::UNKNOWN;
    if (!no_echo || Clock::now() >= deadline || interrupted()) {
      progress.clear();
      return report_targets(reply.error());
    }
    progress.show("no echo there yet");
    for (bool came = false; !came && !interrupted();) {
      const auto next = link->renew();
      if (!next) return report_targets(next.error());
      came = *next;
    }
  }
}

Command make_acquire_command(const TargetsApp& targets) {
  struct Request {
    wire::TargetOrder order;
    double wait_s = 10.0;
  };
  const auto request = std::make_shared<Request>();
  CLI::App* part = targets.add_part("acquire", "Has the echo at a place tracked");
  add_message_options(*part, *request->order.mutable_acquire());
  const auto pair = [part](const char* one, const char* other) {
    part->get_option(one)->needs(part->get_option(other));
    part->get_option(other)->needs(part->get_option(one));
  };
  pair("--range", "--bearing");
  pair("--lat", "--lon");
  part->get_option("--range")->excludes(part->get_option("--lat"));
  part->add_option(
          "--wait", request->wait_s,
          "Seconds to look for it: an echo must have been seen in two turns of the antenna")
      ->check(number_within(0.0, 3600.0))
      ->capture_default_str();
  part->footer(
      "Examples:\n"
      "  skerry targets acquire --range 3.2 --bearing 45        (true, from own ship)\n"
      "  skerry targets acquire --lat 60.445 --lon 5.02\n");
  return {part, [place = targets.place, request] {
            if (request->order.acquire().ByteSizeLong() == 0) {
              return misuse_of_targets(
                  "acquire: where? Give --range and --bearing, or --lat and --lon");
            }
            return acquire(*place, request->order, request->wait_s);
          }};
}

Command make_cancel_command(const TargetsApp& targets) {
  struct Request {
    Numbers numbers;
    bool all = false;
  };
  const auto request = std::make_shared<Request>();
  CLI::App* part = targets.add_part("cancel", "Ends the tracking of targets");
  auto* const numbers = part->add_option("NUMBER", request->numbers, "As skerry targets has them");
  part->add_flag("--all", request->all, "All of them")->excludes(numbers);
  return {part, [place = targets.place, request] {
            if (request->numbers.empty() && !request->all) {
              return misuse_of_targets("cancel: which targets? Give their numbers, or --all");
            }
            wire::TargetOrder order;
            for (const std::uint32_t number : request->numbers) order.add_cancel(number);
            order.set_cancel_all(request->all);
            return order_targets(*place, order, [&](const auto&, const wire::TargetList& list) {
              if (!request->all) return fmt::format("cancelled: {}\n", in_words(request->numbers));
              return fmt::format("cancelled: all {}\n", list.tracked());
            });
          }};
}

Command make_reference_command(const TargetsApp& targets) {
  struct Request {
    std::uint32_t number = 0;
    bool none = false;
  };
  const auto request = std::make_shared<Request>();
  CLI::App* part = targets.add_part(
      "reference", "Takes a target to lie still over ground: others' motions follow from it");
  auto* const number = part->add_option("NUMBER", request->number, "As skerry targets has it")
                           ->check(CLI::Range(1u, 4294967295u));
  part->add_flag("--none", request->none, "No target from now on")->excludes(number);
  return {part, [place = targets.place, request] {
            if (request->number == 0 && !request->none) {
              return misuse_of_targets("reference: which target? Give its number, or --none");
            }
            wire::TargetOrder order;
            order.set_reference(request->number);
            return order_targets(*place, order,
                                 request->none
                                     ? std::string("no target is the reference")
                                     : fmt::format("target {} is the reference", request->number));
          }};
}

Command make_test_command(const TargetsApp& targets) {
  const auto word = std::make_shared<std::string>();
  CLI::App* part = targets.add_part(
      "test", "Eight targets whose motions are known, to test a display with; they have no echo");
  part->add_option("WORD", *word, "on or off")->required()->check(CLI::IsMember({"on", "off"}));
  return {part, [place = targets.place, word] {
            wire::TargetOrder order;
            order.set_test_targets(*word == "on");
            return order_targets(*place, order, "test targets " + *word);
          }};
}

Command make_ais_part(const TargetsApp& targets, CLI::App& ais, const char* name, const char* help,
                      const char* done, void (wire::TargetOrder::*put)(std::uint32_t)) {
  const auto numbers = std::make_shared<Numbers>();
  CLI::App* part = targets.add_part(ais, name, help);
  part->add_option("MMSI", *numbers, "Of AIS targets, as skerry targets has them")->required();
  return {part, [place = targets.place, numbers, done, put] {
            wire::TargetOrder order;
            for (const std::uint32_t number : *numbers) (order.*put)(number);
            return order_targets(*place, order, fmt::format("{}: {}", done, in_words(*numbers)));
          }};
}

Command make_ais_command(const TargetsApp& targets) {
  CLI::App* ais = targets.add_part("ais", "Activates AIS targets, or lets them sleep");
  ais->require_subcommand(1);
  const std::vector<Command> parts = {
      make_ais_part(targets, *ais, "activate", "Shows all of them and their CPA", "activated",
                    &wire::TargetOrder::add_activate),
      make_ais_part(targets, *ais, "sleep", "Shows no more than where they are", "asleep",
                    &wire::TargetOrder::add_let_sleep)};
  return {ais, [parts] { return run_parsed(parts); }};
}

}  // namespace

std::vector<Command> make_acquire_commands(const TargetsApp& targets) {
  return {make_acquire_command(targets), make_cancel_command(targets),
          make_reference_command(targets), make_test_command(targets), make_ais_command(targets)};
}

}  // namespace skerry::client
