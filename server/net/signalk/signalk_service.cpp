#include "server/net/signalk/signalk_service.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <string>
#include <utility>

#include "server/net/common/tcp_peer.hpp"
#include "server/net/http/web_answer.hpp"

namespace skerry::server {
namespace {

std::string host_label() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "this host";
  const std::string whole = name.data();
  return whole.substr(0, whole.find('.'));
}

}  // namespace

SignalkService::SignalkService(NetContext& context, const ServeHttp& serve) : context_(context) {
  const SignalkConfig& config = context.config.signalk;
  if (!config.serve || context.host.radar_count() == 0) return;
  for (std::uint32_t radar = 0; radar < context.host.radar_count(); ++radar) {
    if (const VideoChannelPtr channel = context.host.find_channel(radar, 0)) {
      channel->add_format(kSignalkFormat, signalk_encoder());
    }
  }
  sites_.push_back(std::make_unique<SignalkSite>(context, 0));
  for (const SignalkConfig::Ship& ship : config.further_ships) {
    sites_.push_back(std::make_unique<SignalkSite>(context, ship.radar));
    listeners_.push_back(std::make_unique<Listener>(
        context,
        ListenAddress{.protocol = "Signal K",
                      .address = context.config.bind,
                      .port = ship.port,
                      .option = "the port of that ship in signalk"},
        [serve, site = sites_.back().get()](TcpSocket socket, ConnectionSlotPtr slot) {
          serve(*site, std::move(socket), std::move(slot));
        },
        http_refusal));
  }
}

void SignalkService::start() {
  for (const auto& listener : listeners_) listener->start();
}

void SignalkService::close() {
  for (const auto& listener : listeners_) listener->close();
}

void SignalkService::tick(std::chrono::steady_clock::time_point now) {
  for (const auto& site : sites_) site->tick(now);
}

void SignalkService::advertise(std::uint16_t http_port) {
  error_code error;
  const auto bound = asio::ip::make_address(context_.config.bind, error);
  if (sites_.empty() || !context_.config.signalk.advertise || error || is_loopback(bound)) return;
  const std::string& server = sites_.front()->server();
  const auto space = server.find(' ');
  const std::vector<std::string> texts = {
      "txtvers=1", "roles=master, main", fmt::format("self={}", signalk::kSelf),
      "swname=" + server.substr(0, space),
      "swvers=" + (space == std::string::npos ? std::string() : server.substr(space + 1))};
  std::vector<MdnsService> services;
  using Types = std::vector<const char*>;
  const Types types = context_.tls
                          ? Types{"_signalk-https._tcp", "_signalk-wss._tcp"}
                          : Types{"_signalk-http._tcp", "_signalk-ws._tcp", "_mayara-http._tcp"};
  for (const char* type : types) {
    services.push_back({.type = type, .port = http_port, .texts = texts});
  }
  advertiser_ = std::make_unique<MdnsAdvertiser>("Skerry on " + host_label(), context_.config.bind,
                                                 std::move(services));
}

std::vector<std::uint16_t> SignalkService::further_ports() const {
  std::vector<std::uint16_t> ports;
  for (const auto& listener : listeners_) ports.push_back(listener->port());
  return ports;
}

}  // namespace skerry::server
