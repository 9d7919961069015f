// NavigationOutput: own ship of a radar and what is around her, sent as NMEA 0183.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "protocol/nmea/udp450.hpp"
#include "server/navigation/navigation_talker.hpp"
#include "server/net/common/navigation_config.hpp"
#include "server/net/common/net_context.hpp"
#include "server/net/navigation/line_server.hpp"

namespace skerry::server {

// Never waits: a datagram that the socket does not take at once, and lines for a connection that
// does not read, are dropped and counted.  Thread: constructed anywhere, then net-0.
class NavigationOutput {
 public:
  // Error: std::runtime_error naming the output and the reason: no such radar, no literal address,
  // a value out of range, no such interface, a port in use.
  NavigationOutput(NetContext& context, const NavigationOutputConfig& config);

  void start();
  void close();

  // The address it sends to or listens on: "127.0.0.1:10110".
  std::string address() const;

 private:
  class World;

  void open();
  void tick();
  void send(const NavigationMessage& message);
  void send_datagram(const asio::ip::udp::endpoint& to, std::span<const std::uint8_t> bytes);
  asio::ip::udp::endpoint endpoint_for(NavigationSentence sentence) const;

  NetContext& context_;
  NavigationOutputConfig config_;
  std::shared_ptr<const World> world_;
  NavigationTalker talker_;
  nmea::Udp450Encoder encoder_;
  UdpSocket socket_;
  std::unique_ptr<LineServer> lines_;  // tcp
  std::optional<asio::ip::udp::endpoint> endpoint_;
  OutputPtr counters_;
  std::shared_ptr<const void> wanted_targets_;  // TargetPort::want()
  Timer timer_;
  bool closed_ = false;
};

}  // namespace skerry::server
