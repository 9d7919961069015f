#include "server/app/options/inputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

#include "server/app/options/outputs.hpp"
#include "server/displays/emulated_radars.hpp"

namespace skerry::server {
namespace {

using Keys = std::vector<std::string_view>;

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

std::string input_name(const app::Input& input, int index) {
  return fmt::format("inputs[{}], {}", index, app::Input::Kind_Name(input.kind()));
}

// Error: std::runtime_error for a key that the kind does not take.
void require_keys(const app::Input& input, const std::string& name, const Keys& keys) {
  std::vector<const google::protobuf::FieldDescriptor*> given;
  input.GetReflection()->ListFields(input, &given);
  for (const auto* field : given) {
    if (std::find(keys.begin(), keys.end(), field->name()) != keys.end()) continue;
    throw std::runtime_error(fmt::format("{}: unknown key '{}'; an input of this kind takes {}",
                                         name, field->name(), fmt::join(keys, ", ")));
  }
}

// Of datagrams with a place that must be told.
std::uint16_t port_of(std::string_view kind) {
  return kind == "native" ? kNativePort : kCat240Port;
}

LiveSource live_source_of(const app::Input& input, const std::string& name) {
  LiveSource source;
  source.kind = find_live_kind(app::Input::Kind_Name(input.kind()));
  if (source.kind == nullptr) throw std::runtime_error(name + ": no such radar is known");
  Keys keys = {"kind", "radar", "interface_address", "from", "simulated"};
  if (source.kind->has_commands) keys.push_back("commands");
  if (source.kind->has_second_range) keys.push_back("second_range");
  if (source.kind->has_address) keys.insert(keys.end(), {"address", "port"});
  require_keys(input, name, keys);
  source.radar = input.radar();
  source.second_range = input.second_range();
  source.commands = input.commands();
  source.simulated = input.simulated();
  if (input.has_interface_address()) source.interface_address = input.interface_address();
  if (input.has_from()) {
    const auto from = ipv4_endpoint(input.from() + ":0");
    if (!from) {
      throw std::runtime_error(
          fmt::format("{}: from: '{}' is not an IPv4 address, as 192.0.2.7", name, input.from()));
    }
    source.from = from->address;
  }
  if (source.kind->has_address) {
    // Without an address: what comes to that port of the interface.
    const std::string address = input.has_address() ? input.address() : source.interface_address;
    const std::uint32_t port = input.has_port() ? input.port() : port_of(source.kind->name);
    source.at = ipv4_endpoint(fmt::format("{}:{}", address, port));
    if (!source.at) {
      throw std::runtime_error(
          fmt::format("{}: address: '{}' is not an IPv4 address, as 239.192.43.78", name, address));
    }
  }
  return source;
}

// Whether this server sends just there what it listens for.
bool hears_its_datagrams(const app::ServerConfig& file, const LiveSource& source) {
  return source.at &&
         std::any_of(file.outputs().begin(), file.outputs().end(), [&](const app::Output& output) {
           if (app::Output::Kind_Name(output.kind()) != source.kind->name) return false;
           const std::string address = output.has_address()
                                           ? output.address()
                                           : std::string(LiveSource{}.interface_address);
           const std::uint32_t port =
               output.has_port() ? output.port() : port_of(source.kind->name);
           return ipv4_endpoint(fmt::format("{}:{}", address, port)) == source.at;
         });
}

// Whether an output of this server would be taken for the radar that is listened for.
bool hears_itself(const app::ServerConfig& file, const LiveSource& source) {
  const auto maker_of = [](std::string_view name) { return name.substr(0, name.find('_')); };
  return std::any_of(file.outputs().begin(), file.outputs().end(), [&](const app::Output& output) {
    const std::string kind = app::Output::Kind_Name(output.kind());
    const std::string at = output.interface_address().empty() ? LiveSource{}.interface_address
                                                              : output.interface_address();
    const bool both_loopback =
        at.starts_with("127.") && source.interface_address.starts_with("127.");
    return find_emulated_radar(kind) != nullptr && maker_of(kind) == maker_of(source.kind->name) &&
           (at == source.interface_address || both_loopback);
  });
}

}  // namespace

void add_inputs(const app::ServerConfig& file, NetConfig& net) {
  for (int i = 0; i < file.inputs_size(); ++i) {
    const app::Input& input = file.inputs(i);
    if (input.kind() != app::Input::nmea0183) continue;
    const std::string name = input_name(input, i);
    require_keys(input, name,
                 {"kind", "radar", "transport", "address", "port", "interface_address", "sources"});
    if (!input.has_port()) {
      throw std::runtime_error(name + ": port is missing: where sentences come in, 1 to 65535");
    }
    net.navigation_inputs.push_back(navigation_input_of(input));
  }
}

std::vector<LiveSource> live_sources(const app::ServerConfig& file) {
  std::vector<LiveSource> sources;
  for (int i = 0; i < file.inputs_size(); ++i) {
    const app::Input& input = file.inputs(i);
    if (input.kind() == app::Input::nmea0183) continue;
    const std::string name = input_name(input, i);
    const LiveSource source = live_source_of(input, name);
    for (const LiveSource& other : sources) {
      if (other.radar == source.radar) {
        throw std::runtime_error(fmt::format(
            "{}: radar {} has an input already; give each its own radar=", name, source.radar));
      }
    }
    if (!source.from && hears_its_datagrams(file, source)) {
      throw std::runtime_error(fmt::format(
          "{}: this server sends such datagrams to {} itself; give the input another address or "
          "port, or leave that output out ({})",
          name, text_of(*source.at), source.kind->name == "native" ? "--no-udp" : "--no-cat240"));
    }
    if (!source.from && hears_itself(file, source)) {
      throw std::runtime_error(fmt::format(
          "{}: an output of this server is a radar of the same make on {}; say which radar to "
          "listen to, by from=ADDRESS",
          name, source.interface_address));
    }
    sources.push_back(source);
  }
  return sources;
}

}  // namespace skerry::server
