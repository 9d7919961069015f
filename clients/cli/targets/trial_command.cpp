// skerry targets trial: what would come of a manoeuvre.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "clients/cli/console.hpp"
#include "clients/cli/message_options.hpp"
#include "clients/cli/targets/target_words.hpp"
#include "clients/cli/targets/targets_link.hpp"

namespace skerry::client {
namespace {

// The outcomes come with a list that is made after the order.
int try_manoeuvre(const TargetsPlace& place, const wire::TrialOrder& trial) {
  auto link = TargetsLink::open(place);
  if (!link) return report_targets(link.error());
  wire::TargetOrder order;
  *order.mutable_trial() = trial;
  if (const auto reply = link->order(order); !reply) return report_targets(reply.error());
  const auto deadline = Clock::now() + place.timeout();
  const std::string ordered = trial.SerializeAsString();
  while (!interrupted() && Clock::now() < deadline) {
    const auto came = link->renew();
    if (!came) return report_targets(came.error());
    const wire::TargetList& list = link->list();
    if (!*came || !list.has_trial() || list.trial().order().SerializeAsString() != ordered) {
      continue;
    }
    write_out(trial_text(list));
    return kExitOk;
  }
  return report(fmt::format("{} took the trial, but told nothing of it", link->name()),
                "Has another display ordered a trial since?");
}

}  // namespace

Command make_trial_command(const TargetsApp& targets) {
  const auto trial = std::make_shared<wire::TrialOrder>();
  const auto end = std::make_shared<bool>(false);
  CLI::App* part = targets.add_part(
      "trial", "Shows how close targets would come if own ship manoeuvred; she does not");
  add_message_options(*part, *trial);
  CLI::Option* const course = part->get_option("--course");
  CLI::Option* const speed = part->get_option("--speed");
  part->add_flag("--end", *end, "Ends the trial")->excludes(course)->excludes(speed);
  part->footer(
      "Examples:\n"
      "  skerry targets trial --course 90 --speed 12\n"
      "  skerry targets trial --course 90 --speed 12 --delay 5 --turn-rate 60 --acceleration 2\n"
      "  skerry targets trial --end\n"
      "Course and speed are through the water where there is a log.  The trial goes on in all\n"
      "displays of the view until it is ended.\n");
  return {part, [place = targets.place, trial, end, course, speed] {
            if (*end) {
              wire::TargetOrder order;
              order.set_end_trial(true);
              return order_targets(*place, order, "the trial has ended");
            }
            if (course->count() == 0 || speed->count() == 0) {
              return misuse_of_targets("trial: give --course and --speed, or --end");
            }
            return try_manoeuvre(*place, *trial);
          }};
}

}  // namespace skerry::client
