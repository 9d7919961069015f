#include "clients/cli/targets/targets_link.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "clients/cli/console.hpp"

namespace skerry::client {
namespace {

constexpr std::uint32_t kListsASecond = 2;

}  // namespace

void TargetsPlace::add_options(CLI::App& command) {
  server.add_options(command);
  command.add_option("--radar", choice.radar, "Index of the radar")->capture_default_str();
  command.add_option("--view", choice.view, "Number of the view; 0 is shared by all")
      ->capture_default_str();
  command.add_option("--token", token, "Needed to give orders from another host than the server's")
      ->envname("SKERRY_TOKEN");
}

std::string TargetsPlace::view_name() const {
  return fmt::format("radar {} view {}", choice.radar, choice.view);
}

TargetsLink::TargetsLink(SpokeClient client, const TargetsPlace& place)
    : client_(std::move(client)), place_(place) {}

ClientResult<TargetsLink> TargetsLink::open(const TargetsPlace& place) {
  auto client = place.server.connect();
  if (!client) return Failure{client.error()};
  auto watched =
      client->watch_targets(place.choice.radar, place.choice.view, kListsASecond, place.timeout());
  if (!watched) return Failure{watched.error()};
  TargetsLink link(std::move(*client), place);
  Progress progress;
  for (;;) {
    const auto came = link.renew();
    if (!came) return Failure{came.error()};
    if (*came) return link;
    progress.show("waiting for the plotter of " + place.view_name());
  }
}

ClientResult<bool> TargetsLink::renew() {
  auto event = client_.receive(kLookAround);
  if (!event) return Failure{event.error()};
  if (*event) {
    if (auto* const list = std::get_if<wire::TargetList>(&**event)) {
      list_ = std::move(*list);
      heard_ = Clock::now();
      return true;
    }
  }
  if (Clock::now() - heard_ <= place_.timeout()) return false;
  return failure(ClientErrorKind::timed_out,
                 fmt::format("{} told no targets of {} for {:g} s: it has no plotter for it, or "
                             "the view has ended",
                             client_.name(), place_.view_name(), place_.server.timeout_s));
}

ClientResult<wire::Reply> TargetsLink::order(wire::TargetOrder order) {
  order.set_radar(place_.choice.radar);
  order.set_view(place_.choice.view);
  order.set_token(place_.token);
  return client_.order_targets(order, place_.timeout());
}

int report_targets(const ClientError& error) {
  return report_refusal(error, "skerry targets shows what is plotted, skerry status the radars.");
}

int misuse_of_targets(const std::string& text) {
  report(text);
  return kExitUsage;
}

int order_targets(
    const TargetsPlace& place, const wire::TargetOrder& order,
    const std::function<std::string(const wire::Reply&, const wire::TargetList&)>& tell) {
  auto link = TargetsLink::open(place);
  if (!link) return report_targets(link.error());
  const auto reply = link->order(order);
  if (!reply) return report_targets(reply.error());
  write_out(tell(*reply, link->list()));
  return kExitOk;
}

int order_targets(const TargetsPlace& place, const wire::TargetOrder& order,
                  const std::string& done) {
  return order_targets(place, order, [&](const auto&, const auto&) { return done + "\n"; });
}

CLI::App* TargetsApp::add_part(CLI::App& to, const std::string& name,
                               const std::string& help) const {
  CLI::App* part = to.add_subcommand(name, help);
  place->add_options(*part);
  if (&to == app) {
    for (CLI::Option* option : of_the_list) part->excludes(option);
  }
  return part;
}

}  // namespace skerry::client
