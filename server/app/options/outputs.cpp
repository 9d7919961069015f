#include "server/app/options/outputs.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "server/displays/emulated_radars.hpp"

namespace skerry::server {
namespace {

using app::Output;
using Keys = std::vector<std::string_view>;

constexpr const char* kLoopback = "127.0.0.1";

// The output's own TTL, or the usual one: 0 on loopback, 1 on another interface.
int multicast_ttl(const Output& output) {
  if (output.has_ttl()) return static_cast<int>(output.ttl());
  const std::string& interface = output.interface_address();
  return interface.empty() || interface.starts_with("127.") ? 0 : 1;
}

// Where datagrams of a kind go unless a port is given.
constexpr std::array<std::pair<Output::Kind, std::uint16_t>, 5> kDefaultPorts = {{
    {Output::native, kNativePort},
    {Output::cat240, kCat240Port},
    {Output::cat048, std::uint16_t{8602}},
    {Output::cat062, std::uint16_t{8603}},
    {Output::cat010, std::uint16_t{8604}},
}};

// 0: the kind has none.
std::uint16_t default_port(Output::Kind kind) {
  for (const auto& [of, port] : kDefaultPorts) {
    if (of == kind) return port;
  }
  return 0;
}

// SAC 0 and the radar's number modulo 256 unless others are given.
AsterixSource asterix_source(const Output& output) {
  AsterixSource source{.sic = static_cast<std::uint8_t>(output.radar())};
  if (output.has_sac()) source.sac = static_cast<std::uint8_t>(output.sac());
  if (output.has_sic()) source.sic = static_cast<std::uint8_t>(output.sic());
  return source;
}

UdpDestination udp_destination(const Output& output, const std::string& name) {
  UdpDestination to;
  to.radar = output.radar();
  if (output.has_address()) to.address = output.address();
  to.port = default_port(output.kind());
  if (output.has_port()) to.port = static_cast<std::uint16_t>(output.port());
  if (to.port == 0) throw std::runtime_error(name + ": port 0 cannot be sent to");
  to.max_datagram = output.max_datagram();
  to.interface_address = output.interface_address();
  to.multicast_ttl = multicast_ttl(output);
  return to;
}

StreamOutputConfig stream_of(const Output& output, const std::string& name) {
  StreamOutputConfig stream;
  stream.to = udp_destination(output, name);
  stream.own_view = output.view() == Output::own;
  if (output.kind() == Output::native) {
    stream.shape = NativeShape{output.spokes(), output.cells(), output.bits()};
    return stream;
  }
  if (output.kind() == Output::sweeps) {
    stream.shape = BoardRecords{};
    return stream;
  }
  Cat240StreamShape shape;
  shape.options.source = asterix_source(output);
  if (output.has_bits()) shape.options.bits = static_cast<std::uint8_t>(output.bits());
  shape.options.nanoseconds = output.nanoseconds();
  shape.options.blocks = static_cast<Cat240Blocks>(output.blocks());
  shape.options.compressed = output.compressed();
  if (output.has_time_of_day()) shape.options.time_of_day = output.time_of_day();
  shape.options.start_range = output.start_range();
  if (output.has_summaries()) shape.summaries = output.summaries();
  if (output.has_records()) shape.records = output.records();
  shape.turn_spokes = output.spokes();
  shape.cells = output.cells();
  stream.shape = shape;
  return stream;
}

Ipv4Endpoint endpoint_of(const std::string& text, const std::string& name) {
  const auto endpoint = ipv4_endpoint(text);
  if (endpoint) return *endpoint;
  throw std::runtime_error(
      fmt::format("{}: '{}' is not an IPv4 address and a port, as 236.6.7.8:6678", name, text));
}

DisplayOutputConfig display_of(const Output& output, const EmulatedRadar& radar,
                               const std::string& name, std::uint32_t number) {
  EmulationSpec spec;
  spec.number = number;
  spec.serial = output.serial();
  spec.dual_range = output.dual_range();
  if (output.has_standby_after_s())
    spec.standby_after = seconds_as_duration(output.standby_after_s());
  for (const std::string& text : output.addresses()) {
    spec.addresses.push_back(endpoint_of(text, name + ": addresses"));
  }
  if (const auto fault = radar.fault(spec)) throw std::runtime_error(name + ": " + *fault);
  if (!spec.dual_range && (output.has_radar_b() || output.has_view_b())) {
    throw std::runtime_error(name + ": radar_b and view_b are of range B; add dual_range: true");
  }
  DisplayOutputConfig display;
  display.name = radar.name;
  display.make = [&radar, spec] { return radar.make(spec); };
  display.identity = radar.identity(spec);
  display.interface_address =
      output.interface_address().empty() ? kLoopback : output.interface_address();
  display.ttl = multicast_ttl(output);
  display.sources = {{output.radar(), output.view() == Output::own}};
  if (spec.dual_range) {
    display.sources.push_back({output.has_radar_b() ? output.radar_b() : output.radar(),
                               !output.has_view_b() || output.view_b() == Output::own});
  }
  // Displays cannot show who they are: whoever is on that network can command such a radar.
  if (!display.interface_address.starts_with("127.") && !output.has_obeys()) {
    throw std::runtime_error(fmt::format(
        "{0}: other hosts reach it on {1}: add obeys: true if every display there may "
        "change its range, gain and transmission, or obeys: false if they may only look",
        name, display.interface_address));
  }
  display.obeys = !output.has_obeys() || output.obeys();
  display.burst = radar.burst;
  return display;
}

const EmulatedRadar* radar_of(const Output& output) {
  return find_emulated_radar(Output::Kind_Name(output.kind()));
}

// EmulationSpec::number of entry `index`, a `radar`.  The first radar of a model has 0.  Radars of
// one maker that announce their addresses are counted together, and leave 0 to those of that maker
// whose addresses are fixed.
std::uint32_t number_of(const app::ServerConfig& file, int index, const EmulatedRadar& radar) {
  std::uint32_t before = 0;
  bool beside_fixed = false;
  for (int i = 0; i < file.outputs_size(); ++i) {
    const EmulatedRadar* const other = radar_of(file.outputs(i));
    if (other == nullptr || other->maker != radar.maker) continue;
    beside_fixed = beside_fixed || other->fixed_addresses;
    const bool counts = radar.fixed_addresses ? other == &radar : !other->fixed_addresses;
    if (i < index && counts) ++before;
  }
  return before + (!radar.fixed_addresses && beside_fixed ? 1 : 0);
}

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
  plan.targets = output.targets() == Output::truth ? TargetSource::truth : TargetSource::plotted;
  plan.says_simulated = output.says_simulated();
  if (const auto fault = fault_in(plan)) throw std::runtime_error(name + ": " + *fault);
  return plan;
}

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

using Add = decltype(OutputKind::add);

constexpr Add kAddStream = [](const app::ServerConfig& file, int index, const std::string& name,
                              NetConfig& net) {
  net.streams.push_back(stream_of(file.outputs(index), name));
};
// One for each category: that of the kind.
template <TargetCategory category>
constexpr Add kAddTargets =
    [](const app::ServerConfig& file, int index, const std::string& name, NetConfig& net) {
      const Output& output = file.outputs(index);
      net.target_outputs.push_back({.to = udp_destination(output, name),
                                    .category = category,
                                    .source = asterix_source(output)});
    };
constexpr Add kAddRadar = [](const app::ServerConfig& file, int index, const std::string& name,
                             NetConfig& net) {
  const Output& output = file.outputs(index);
  const EmulatedRadar& radar = *radar_of(output);
  net.displays.push_back(display_of(output, radar, name, number_of(file, index, radar)));
};
constexpr Add kAddSentences = [](const app::ServerConfig& file, int index, const std::string& name,
                                 NetConfig& net) {
  net.navigation_outputs.push_back(navigation_output_of(file.outputs(index), name));
};

std::vector<OutputKind> make_kinds() {
  const Keys common = {"kind", "radar", "interface_address", "ttl"};
  const Keys datagrams = {"address", "port", "max_datagram"};
  const Keys shape = {"view", "spokes", "cells", "bits"};
  const Keys source = {"sac", "sic"};
  const Keys cat240 = {"nanoseconds", "blocks",      "compressed", "time_of_day",
                       "summaries",   "start_range", "records"};
  const Keys sentences = {"address",         "port",         "sentences",
                          "own_mmsi",        "ais_range_nm", "tracking_range_nm",
                          "tracked_targets", "targets",      "static_period_s",
                          "says_simulated"};
  std::vector<OutputKind> kinds;
  const auto add = [&](std::string_view name, Add how, std::initializer_list<Keys> further) {
    kinds.push_back({name, common, how});
    for (const Keys& keys : further) {
      kinds.back().keys.insert(kinds.back().keys.end(), keys.begin(), keys.end());
    }
  };
  add("native", kAddStream, {datagrams, shape});
  add("cat240", kAddStream, {datagrams, shape, source, cat240});
  add("sweeps", kAddStream, {datagrams});
  for (const EmulatedRadar& radar : emulated_radars()) {
    add(radar.name, kAddRadar, {{"view", "obeys"}, radar.keys});
  }
  add("nmea0183", kAddSentences, {sentences, {"transport", "broadcast"}});
  add("iec61162_450", kAddSentences, {sentences, {"source"}});
  add("cat048", kAddTargets<TargetCategory::cat048>, {datagrams, source});
  add("cat062", kAddTargets<TargetCategory::cat062>, {datagrams, source});
  add("cat010", kAddTargets<TargetCategory::cat010>, {datagrams, source});
  return kinds;
}

bool takes(const OutputKind& kind, std::string_view key) {
  return std::find(kind.keys.begin(), kind.keys.end(), key) != kind.keys.end();
}

const OutputKind& kind_of(const Output& output) {
  const std::string& name = Output::Kind_Name(output.kind());
  for (const OutputKind& kind : output_kinds()) {
    if (kind.name == name) return kind;
  }
  throw std::logic_error("output_kinds() has no row for " + name);
}

void check_keys(const Output& output, const OutputKind& kind, const std::string& name) {
  std::vector<const google::protobuf::FieldDescriptor*> given;
  output.GetReflection()->ListFields(output, &given);
  for (const auto* field : given) {
    if (takes(kind, field->name())) continue;
    Keys takers;
    for (const OutputKind& other : output_kinds()) {
      if (takes(other, field->name())) takers.push_back(other.name);
    }
    throw std::runtime_error(fmt::format(
        "{}: '{}' is not a key of this kind; it takes {}. '{}' is a key of {}", name, field->name(),
        fmt::join(kind.keys, ", "), field->name(), fmt::join(takers, ", ")));
  }
}

}  // namespace

const std::vector<OutputKind>& output_kinds() {
  static const std::vector<OutputKind> kinds = make_kinds();
  return kinds;
}

void add_outputs(const app::ServerConfig& file, NetConfig& net) {
  for (int i = 0; i < file.outputs_size(); ++i) {
    const OutputKind& kind = kind_of(file.outputs(i));
    const std::string name = fmt::format("outputs[{}] ({})", i, kind.name);
    check_keys(file.outputs(i), kind, name);
    kind.add(file, i, name, net);
  }
}

void check_outputs(const app::ServerConfig& file, YamlSource& source) {
  NetConfig unused;
  for (int i = 0; i < file.outputs_size(); ++i) {
    const std::string path = fmt::format("outputs[{}]", i);
    if (!source.is_sound(path)) continue;
    const OutputKind& kind = kind_of(file.outputs(i));
    try {
      check_keys(file.outputs(i), kind, std::string(kind.name));
      kind.add(file, i, std::string(kind.name), unused);
    } catch (const std::runtime_error& wrong) {
      source.refuse(path, wrong.what());
    }
  }
}

}  // namespace skerry::server
