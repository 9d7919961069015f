// LineServer: lines of text over TCP, to and from whoever connects.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/net/common/listener.hpp"

namespace skerry::server {

class LineSession;

// A line longer than kMostLine is left out up to its end; a connection with more than kMostQueued
// bytes unsent loses whole lines.  Thread: constructed anywhere, then net-0.
class LineServer {
 public:
  static constexpr std::size_t kMostLine = 1024;
  static constexpr std::size_t kMostQueued = 64 * 1024;

  struct Handlers {
    // Whether that peer may connect; one that may not is closed without a word.
    std::function<bool(const asio::ip::address&)> admits;
    // A line without its end; false: no more are wanted for a moment, and reading pauses.
    // Empty: what comes is thrown away.
    std::function<bool(std::string_view line, const std::string& peer)> on_line;
    // Lines that went to, or could not be queued for, one connection.
    std::function<void(std::size_t lines, std::size_t bytes, bool sent)> on_sent;
    std::function<void()> on_overlong;
  };

  // Error: as Listener.
  LineServer(NetContext& context, const ListenAddress& where, std::size_t most_connections,
             Handlers handlers);

  void start() { listener_.start(); }
  void close();
  std::uint16_t port() const { return listener_.port(); }

  void send(const std::vector<std::string>& lines);

 private:
  void accept(TcpSocket socket, ConnectionSlotPtr slot);

  NetContext& context_;
  std::string protocol_;
  std::size_t most_connections_;
  std::shared_ptr<const Handlers> handlers_;
  std::vector<std::weak_ptr<LineSession>> sessions_;
  Listener listener_;
};

}  // namespace skerry::server
