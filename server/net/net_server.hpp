// NetServer: everything the server does on the network.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "server/core/radar_host.hpp"
#include "server/net/common/net_config.hpp"

namespace skerry::server {

// Owns one io_context, the thread "net-0" that runs it, and all listeners, sessions and senders.
//
// Use: construct before the radars start, as it adds the network's formats to every channel;
// start(); stop the radars and the server in any order; destroy it before the host.
class NetServer {
 public:
  // Binds all ports.  `web_files` must outlive the server.
  // Error: std::runtime_error naming protocol, address, port or value, and what to do.
  NetServer(RadarHost& host, NetConfig config, std::span<const WebFile> web_files);
  ~NetServer();  // stops
  NetServer(const NetServer&) = delete;
  NetServer& operator=(const NetServer&) = delete;

  void start();
  // Closes everything and returns when the thread has ended.  A stopped server stays stopped.
  // Thread: start() and stop() from one thread.
  void stop();

  // Reads the certificate and its key again, if there are any; a damaged one is told, and the one
  // from before holds.  Thread: any.
  void read_certificate();

  // How often net-0 has looked after its connections, ten times a second: it goes on.  Thread: any.
  std::uint64_t looks() const;

  // The answer to GetStatus.  Thread: any.
  wire::Status status() const;

  std::uint16_t tcp_port() const;
  std::uint16_t http_port() const;
  // HTTP ports of NetConfig::signalk.further_ships, in their order.
  std::vector<std::uint16_t> signalk_ports() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skerry::server
