// NavigationInput: an outside simulator's NMEA 0183, which moves own ship of a radar.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/navigation/navigation_listener.hpp"
#include "server/net/common/navigation_config.hpp"
#include "server/net/common/net_context.hpp"
#include "server/net/navigation/line_server.hpp"

namespace skerry::server {

// Bounded whatever comes: in every kWindow at most kLines lines are looked at, and kDatagrams
// datagrams or connections' reads; what is more waits in the system's buffers, which drop the rest.
// Lines beyond kLines are dropped and counted.
// Thread: constructed anywhere, then net-0.
class NavigationInput {
 public:
  static constexpr std::chrono::milliseconds kWindow{100};
  static constexpr std::size_t kLines = 200;
  static constexpr std::size_t kDatagrams = 1000;

  // Error: std::runtime_error naming the input and the reason, as of NavigationOutput.
  NavigationInput(NetContext& context, const NavigationInputConfig& config);

  void start();
  void close();

  std::uint16_t port() const;

 private:
  void open();
  void tick();
  void wait_for_datagrams();
  void take_datagrams();
  void take_datagram(std::string_view bytes, const std::string& source);
  // False if this window has had its lines.
  bool take_line(std::string_view line, const std::string& source);
  void drive(const HeardLine& heard, const std::string& source);
  void command(const nmea::ConCommand& command, const std::string& source);
  void order_alerts(wire::TargetOrder order, const std::string& source);
  void refuse(std::string_view kind, const std::string& text);
  bool admits(const asio::ip::address& source) const;

  NetContext& context_;
  NavigationInputConfig config_;
  std::vector<asio::ip::network_v4> sources_;
  NavigationListener listener_;
  UdpSocket socket_;
  std::unique_ptr<LineServer> lines_server_;  // tcp
  OutputPtr counters_;
  Timer timer_;
  std::array<char, 65536> buffer_{};
  std::size_t lines_left_ = kLines, datagrams_left_ = kDatagrams;
  bool is_paused_ = false, is_driving_ = false, closed_ = false;
  std::uint64_t jumps_ = 0;
  std::chrono::steady_clock::time_point last_fix_{}, jump_told_{};
};

}  // namespace skerry::server
