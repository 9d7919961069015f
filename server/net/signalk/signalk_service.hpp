// SignalkService: everything of Signal K that one server offers: a site per own ship, and mDNS.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "server/net/common/listener.hpp"
#include "server/net/signalk/mdns_advertiser.hpp"
#include "server/net/signalk/signalk_encoder.hpp"
#include "server/net/signalk/signalk_site.hpp"

namespace skerry::server {

// Thread: constructed anywhere, then net-0 but for advertise().
class SignalkService {
 public:
  // Serves an HTTP connection that came to the port of a site.
  using ServeHttp = std::function<void(SignalkSite&, TcpSocket, ConnectionSlotPtr)>;

  // Adds its format to the default view of every radar, and binds the ports of further ships.
  // Error: std::runtime_error as Listener's, or for a radar that is not there.
  SignalkService(NetContext& context, const ServeHttp& serve);

  // The site on the server's HTTP port; nullptr if none is served.
  SignalkSite* first() { return sites_.empty() ? nullptr : sites_.front().get(); }

  void start();
  void close();
  // Call it every 100 ms.
  void tick(std::chrono::steady_clock::time_point now);

  // Tells other hosts, if they can reach the server and the configuration has it so.
  void advertise(std::uint16_t http_port);
  void end_advertising() { advertiser_.reset(); }

  // HTTP ports of the further ships, in their order.
  std::vector<std::uint16_t> further_ports() const;

 private:
  NetContext& context_;
  std::vector<std::unique_ptr<SignalkSite>> sites_;
  std::vector<std::unique_ptr<Listener>> listeners_;
  std::unique_ptr<MdnsAdvertiser> advertiser_;
};

}  // namespace skerry::server
