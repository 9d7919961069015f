#include "server/app/options/relay_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "protocol/thin/thin_shape.hpp"
#include "server/app/config.pb.h"
#include "server/app/options/field_options.hpp"
#include "server/net/common/net_config.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kLongestToken = 1024;

std::string token_in(const std::string& file) {
  std::ifstream in(file);
  std::string token;
  if (!in || !std::getline(in, token)) {
    throw std::runtime_error(
        fmt::format("--relay-token-file: {}: cannot be read; expected a file whose first line is "
                    "the token",
                    file));
  }
  if (token.ends_with('\r')) token.pop_back();
  if (token.empty() || token.size() > kLongestToken) {
    throw std::runtime_error(fmt::format(
        "--relay-token-file: {}: its first line has {} characters; expected a token, of at most {}",
        file, token.size(), kLongestToken));
  }
  return token;
}

void refuse_beside_relay(bool given, const char* what, const char* why) {
  if (given)
    throw std::runtime_error(fmt::format("{} and --relay exclude each other: {}", what, why));
}

std::optional<std::uint32_t> thin_of(const std::string& text) {
  if (text.empty() || text == "off") return 0;
  if (text == "auto") return std::nullopt;
  if (text.size() == 1 && text[0] >= '1' && text[0] <= static_cast<char>('0' + kThinLevels)) {
    return text[0] - '0';
  }
  throw std::runtime_error(
      fmt::format("--relay-thin {}: expected off, auto, or a level of 1 to {}", text, kThinLevels));
}

// Whether the other server's port would be this one's own.
bool is_own_port(const UpstreamPlace& place, const NetConfig& net) {
  if (net.tcp_port == 0 || place.port != net.tcp_port) return false;
  boost::system::error_code error;
  const auto address = asio::ip::make_address(place.host, error);
  if (error) return place.host == "localhost";
  return is_loopback(address) || place.host == net.bind;
}

}  // namespace

void add_relay_options(CLI::App& cli, app::Relay& line) {
  FieldOptions add(cli, "Relay");
  add.text("--relay", line, &app::Relay::mutable_server,
           "serve another server's radars: one stream from it, any number of consoles here")
      ->type_name("HOST:PORT");
  add.text("--relay-token-file", line, &app::Relay::mutable_token_file,
           "file whose first line is the token that the other server knows this one by "
           "(SKERRY_TOKEN of the environment)")
      ->type_name("FILE");
  add.text("--relay-thin", line, &app::Relay::mutable_thin,
           "fewer spokes and cells for a slow link: off, 1 .. 4 (the thinnest), or auto, as the "
           "link needs (off)")
      ->type_name("LEVEL");
}

RelayOptions relay_options(const app::ServerConfig& config, const NetConfig& net) {
  RelayOptions options;
  if (!config.has_relay()) return options;
  const auto place = upstream_place(config.relay().server());
  if (!place) throw std::runtime_error("--relay: " + place.error());
  refuse_beside_relay(config.has_scenario(), "--scenario",
                      "radars of its own, or another server's");
  refuse_beside_relay(config.playback().has_file(), "--play",
                      "a recording, or another server's radars");
  refuse_beside_relay(!config.charts().empty() || config.has_elevation(), "--chart or --elevation",
                      "the chart is the other server's");
  refuse_beside_relay(!config.inputs().empty(), "--input",
                      "own ships and radars are the other server's; give the input to that one");
  const bool has_sweeps =
      !config.sweeps().empty() ||
      std::any_of(config.outputs().begin(), config.outputs().end(),
                  [](const auto& output) { return output.kind() == app::Output::sweeps; });
  refuse_beside_relay(has_sweeps, "--sweeps",
                      "interface boards are not relayed; have them of the other server");
  refuse_beside_relay(config.workers() > 0, "--workers", "a relay makes no video");
  options.place = *place;
  options.thin = thin_of(config.relay().thin());
  if (is_own_port(options.place, net)) {
    throw std::runtime_error(fmt::format(
        "--relay {}: that is this server's own port; give --tcp-port another number, or --relay "
        "another server",
        options.place.name()));
  }
  if (config.relay().has_token_file()) {
    options.token = token_in(config.relay().token_file());
  } else if (const char* token = std::getenv("SKERRY_TOKEN")) {
    options.token = std::string(token).substr(0, kLongestToken);
  }
  return options;
}

}  // namespace skerry::server
