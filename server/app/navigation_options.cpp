#include "server/app/navigation_options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace skerry::server {
namespace {

using app::Output;

// "hdt=0.1".
void add_sentence(const std::string& text, const std::string& name, NavigationPlan& plan) {
  const auto fail = [&](const std::string& why) -> std::runtime_error {
    return std::runtime_error(fmt::format(
        "{}: sentences: '{}': {}; expected a sentence and its period in seconds, as hdt=0.1, or "
        "vdm=0 for the periods of AIS itself",
        name, text, why));
  };
  const auto equals = text.find('=');
  const auto sentence = find_navigation_sentence(text.substr(0, equals));
  if (!sentence) throw fail("there is no such sentence");
  if (equals == std::string::npos) throw fail("no period");
  double seconds = 0.0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data() + equals + 1, end, seconds);
  // Longer ones than an hour are refused by the plan, naming its range.
  if (error != std::errc{} || next != end || !(seconds >= 0.0) || seconds > 1e6) {
    throw fail("the period is no number");
  }
  plan.periods[*sentence] = seconds_as_duration(seconds);
}

NavigationPlan plan_of(const Output& output, const std::string& name) {
  NavigationPlan plan;
  if (output.sentences_size() > 0) plan.periods.clear();
  for (const std::string& text : output.sentences()) add_sentence(text, name, plan);
  if (output.has_static_period_s()) {
    plan.static_period = seconds_as_duration(output.static_period_s());
  }
  plan.own_mmsi = output.own_mmsi();
  if (output.has_ais_range_nm()) plan.ais_range_nm = output.ais_range_nm();
  if (output.has_tracking_range_nm()) plan.tracking_range_nm = output.tracking_range_nm();
  if (output.has_tracked_targets()) plan.tracked_targets = output.tracked_targets();
  plan.says_simulated = output.says_simulated();
  if (const auto fault = fault_in(plan)) throw std::runtime_error(name + ": " + *fault);
  return plan;
}

}  // namespace

NavigationOutputConfig navigation_output_of(const Output& output, const std::string& name) {
  NavigationOutputConfig out;
  out.radar = output.radar();
  const bool iec450 = output.kind() == Output::iec61162_450;
  out.transport = iec450                              ? NavigationTransport::iec450
                  : output.transport() == Output::tcp ? NavigationTransport::tcp
                                                      : NavigationTransport::udp;
  if (iec450) out.address.clear();
  if (output.has_address()) out.address = output.address();
  if (output.has_port()) out.port = static_cast<std::uint16_t>(output.port());
  out.broadcast = output.broadcast();
  if (output.has_interface_address()) out.interface_address = output.interface_address();
  out.multicast_ttl = multicast_ttl(output);
  if (output.has_source()) out.source = output.source();
  out.plan = plan_of(output, name);
  return out;
}

NavigationInputConfig navigation_input_of(const app::Input& input) {
  NavigationInputConfig out;
  out.radar = input.radar();
  out.transport =
      input.transport() == app::Input::tcp ? NavigationTransport::tcp : NavigationTransport::udp;
  if (input.has_address()) out.address = input.address();
  out.port = static_cast<std::uint16_t>(input.port());
  if (input.has_interface_address()) out.interface_address = input.interface_address();
  for (const std::string& source : input.sources()) out.sources.push_back(source);
  return out;
}

}  // namespace skerry::server
