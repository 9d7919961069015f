// Listener: accepts TCP connections on one address and port.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "server/net/common/net_context.hpp"

namespace skerry::server {

struct ListenAddress {
  std::string protocol;    // "native TCP": for messages
  std::string address;     // IPv4 or IPv6 literal
  std::uint16_t port = 0;  // 0: any free one
  std::string option;      // "--tcp-port": what to change if the port is in use
};

// Thread: constructed anywhere, then net-0.
class Listener {
 public:
  using Accepted = std::function<void(TcpSocket, ConnectionSlotPtr)>;
  // What a connection is told for which there is no slot, as bytes of the protocol, given the
  // reason.
  using LastWord = std::function<std::string(const std::string&)>;

  // Binds and listens.  `last_word` may be empty: such connections are just closed.
  // Error: std::runtime_error naming protocol, address, port and what to do.
  Listener(NetContext& context, const ListenAddress& where, Accepted accepted,
           LastWord last_word = {});

  void start() { accept(); }
  void close();
  std::uint16_t port() const { return port_; }

 private:
  void accept();
  void turn_away(TcpSocket socket, const TcpPeer& peer);

  NetContext& context_;
  std::string protocol_;
  Accepted accepted_;
  LastWord last_word_;
  TcpAcceptor acceptor_;
  TcpSocket socket_;
  Timer retry_;
  std::uint16_t port_ = 0;
};

}  // namespace skerry::server
