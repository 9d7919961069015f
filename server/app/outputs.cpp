#include "server/app/outputs.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "server/app/navigation_options.hpp"
#include "server/app/output_keys.hpp"
#include "server/config/yaml_message.hpp"
#include "server/displays/make_emulation.hpp"

namespace skerry::server {
namespace {

using app::Output;

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::uint16_t kCat240Port = 8600, kNativePort = 7411;

// A value as YAML: text in quotes, anything else as it stands.
std::string as_yaml(const std::string& value, bool text) {
  if (!text) return value;
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

// The text as the YAML of a message of that schema.
void parse_entry(const std::string& text, const char* option, google::protobuf::Message& out) {
  const auto colon = text.find(':');
  const std::string name = std::string(option) + " " + text;
  std::vector<std::pair<std::string, std::vector<std::string>>> keys = {
      {"kind", {text.substr(0, colon)}}};
  std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  while (!rest.empty()) {
    const auto comma = std::min(rest.find(','), rest.size());
    const std::string part = rest.substr(0, comma);
    rest.erase(0, comma + 1);
    const auto equals = part.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw std::runtime_error(
          fmt::format("{}: '{}' is not key=value; expected KIND:key=value,key=value", name, part));
    }
    const std::string key = part.substr(0, equals);
    auto known =
        std::find_if(keys.begin(), keys.end(), [&](const auto& k) { return k.first == key; });
    if (known == keys.end()) known = keys.insert(keys.end(), {key, {}});
    known->second.push_back(part.substr(equals + 1));
  }
  std::string yaml;
  for (const auto& [key, values] : keys) {
    const auto* field = out.GetDescriptor()->FindFieldByName(key);
    const bool is_text =
        field != nullptr && field->type() == google::protobuf::FieldDescriptor::TYPE_STRING;
    const bool is_list = field != nullptr && field->is_repeated();
    if (!is_list && values.size() > 1) {
      throw std::runtime_error(fmt::format("{}: '{}' is given twice", name, key));
    }
    yaml += fmt::format("{}: ", as_yaml(key, true));
    if (is_list) yaml += "[";
    for (std::size_t i = 0; i < values.size(); ++i) {
      yaml += (i == 0 ? "" : ", ") + as_yaml(values[i], is_text);
    }
    yaml += is_list ? "]\n" : "\n";
  }
  load_yaml(yaml, name, out);
}

bool is_stream(const Output& output) {
  return output.kind() == Output::native || output.kind() == Output::cat240;
}
bool is_navigation(const Output& output) {
  return output.kind() == Output::nmea0183 || output.kind() == Output::iec61162_450;
}

UdpDestination udp_destination(const Output& output, const std::string& name) {
  UdpDestination to;
  to.radar = output.radar();
  if (output.has_address()) to.address = output.address();
  to.port = output.kind() == Output::cat240 ? kCat240Port : kNativePort;
  if (output.has_port()) to.port = static_cast<std::uint16_t>(output.port());
  if (to.port == 0) throw std::runtime_error(name + ": port 0 cannot be sent to");
  to.max_datagram = output.max_datagram();
  to.interface_address = output.interface_address();
  to.multicast_ttl = multicast_ttl(output);
  return to;
}

StreamOutputConfig stream_of(const Output& output, const std::string& name, Cat240Source source) {
  StreamOutputConfig stream;
  stream.to = udp_destination(output, name);
  stream.own_view = output.view() == Output::own;
  if (output.kind() == Output::native) {
    stream.shape = NativeShape{output.spokes(), output.cells(), output.bits()};
    return stream;
  }
  Cat240StreamShape shape;
  shape.options.source = {source.sac, static_cast<std::uint8_t>(source.sic + output.radar())};
  if (output.has_sac()) shape.options.source.sac = static_cast<std::uint8_t>(output.sac());
  if (output.has_sic()) shape.options.source.sic = static_cast<std::uint8_t>(output.sic());
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
  const auto fail = [&] {
    return std::runtime_error(
        fmt::format("{}: '{}' is not an IPv4 address and a port, as 236.6.7.8:6678", name, text));
  };
  Ipv4Endpoint out;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  const auto number = [&](unsigned most, char then) {
    unsigned value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool closed = then == '\0' ? next == end : next != end && *next == then;
    if (error != std::errc{} || value > most || !closed) throw fail();
    at = then == '\0' ? next : next + 1;
    return value;
  };
  for (const char then : {'.', '.', '.', ':'}) out.address = out.address << 8 | number(255, then);
  out.port = static_cast<std::uint16_t>(number(65535, '\0'));
  return out;
}

DisplayOutputConfig display_of(const Output& output, const std::string& name,
                               std::uint32_t number) {
  EmulationSpec spec;
  spec.kind = static_cast<EmulationKind>(output.kind() - Output::navico_br24);
  spec.number = number;
  spec.serial = output.serial();
  spec.dual_range = output.dual_range();
  if (output.has_standby_after_s())
    spec.standby_after = seconds_as_duration(output.standby_after_s());
  for (const std::string& text : output.addresses()) {
    spec.addresses.push_back(endpoint_of(text, name + ": addresses"));
  }
  if (const auto fault = fault_of(spec)) throw std::runtime_error(name + ": " + *fault);
  if (!spec.dual_range && (output.has_radar_b() || output.has_view_b())) {
    throw std::runtime_error(name + ": radar_b and view_b are of range B; add dual_range: true");
  }
  DisplayOutputConfig display;
  display.name = Output::Kind_Name(output.kind());
  display.make = [spec] { return make_emulation(spec); };
  display.identity = identity_of(spec);
  display.interface_address =
      output.interface_address().empty() ? kLoopback : output.interface_address();
  display.ttl = multicast_ttl(output);
  display.sources = {{output.radar(), output.view() == Output::own}};
  if (spec.dual_range) {
    display.sources.push_back({output.has_radar_b() ? output.radar_b() : output.radar(),
                               !output.has_view_b() || output.view_b() == Output::own});
  }
  display.obeys = !output.has_obeys() || output.obeys();
  display.burst = burst_of(spec.kind);
  return display;
}

// The first radar has what is usual for its kind.  A HALO, whose displays ask it for its addresses,
// keeps away from what other Navico radars have fixed.
std::uint32_t number_of(const app::ServerConfig& file, int index) {
  const auto fixed = [](const Output& output) {
    return output.kind() >= Output::navico_br24 && output.kind() <= Output::navico_4g;
  };
  const bool beside_fixed = std::any_of(file.outputs().begin(), file.outputs().end(), fixed);
  const Output::Kind kind = file.outputs(index).kind();
  const bool halo = kind == Output::navico_halo || kind == Output::navico_halo20;
  const auto kin = [&](const Output& output) {
    return halo ? output.kind() == Output::navico_halo || output.kind() == Output::navico_halo20
                : output.kind() == kind;
  };
  const auto before = std::count_if(file.outputs().begin(), file.outputs().begin() + index, kin);
  return static_cast<std::uint32_t>(before) + (halo && beside_fixed ? 1 : 0);
}

}  // namespace

int multicast_ttl(const Output& output) {
  if (output.has_ttl()) return static_cast<int>(output.ttl());
  const std::string& interface = output.interface_address();
  return interface.empty() || interface.starts_with("127.") ? 0 : 1;
}

Output parse_output(const std::string& text) {
  Output output;
  parse_entry(text, "--output", output);
  return output;
}

app::Input parse_input(const std::string& text) {
  app::Input input;
  parse_entry(text, "--input", input);
  return input;
}

void add_outputs(const app::ServerConfig& file, NetConfig& net) {
  for (int i = 0; i < file.outputs_size(); ++i) {
    const Output& output = file.outputs(i);
    const std::string name = name_of(output, i);
    check_keys(output, name);
    if (is_stream(output)) {
      net.streams.push_back(stream_of(output, name, net.cat240_source));
    } else if (is_navigation(output)) {
      net.navigation_outputs.push_back(navigation_output_of(output, name));
    } else {
      net.displays.push_back(display_of(output, name, number_of(file, i)));
    }
  }
}

void add_inputs(const app::ServerConfig& file, NetConfig& net) {
  for (int i = 0; i < file.inputs_size(); ++i) {
    net.navigation_inputs.push_back(navigation_input_of(file.inputs(i)));
  }
}

}  // namespace skerry::server
