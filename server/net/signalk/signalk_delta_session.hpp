// SignalkDeltaSession: one client of the Signal K stream: own ship, controls and targets as deltas.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>

#include "protocol/signalk/subscription.hpp"
#include "server/net/common/net_context.hpp"
#include "server/net/common/peer_stream.hpp"
#include "server/net/signalk/signalk_site.hpp"
#include "server/net/signalk/stream_right.hpp"

namespace skerry::server {

// Says hello, takes subscriptions and changes of controls, and sends what has changed of what was
// subscribed to; nothing is made for a client while a message to it is in flight.  Once kMostQueued
// replies wait, no further request is read.  Thread: net-0.
class SignalkDeltaSession final : public Connection,
                                  public SignalkListener,
                                  public std::enable_shared_from_this<SignalkDeltaSession> {
 public:
  static constexpr std::size_t kMostQueued = 64;
  static constexpr std::size_t kLongestRequest = 16 * 1024;

  struct Client {
    std::string query;  // of the request: subscribe=none, self or all
    StreamRight right;
  };
  // Requires a stream whose handshake is done.
  static void begin(NetContext& context, SignalkSite& site, std::unique_ptr<WsStream> stream,
                    ConnectionSlotPtr slot, const Client& client);

  SignalkDeltaSession(NetContext& context, SignalkSite& site, std::unique_ptr<WsStream> stream,
                      ConnectionSlotPtr slot, const Client& client);

  void close() override;
  void check(std::chrono::steady_clock::time_point now) override;
  void on_tick(std::chrono::steady_clock::time_point now) override;

 private:
  struct Sent {
    std::shared_ptr<const signalk::Json> value;
    std::chrono::steady_clock::time_point at;
  };

  void start();
  void read();
  void on_read(error_code error);
  void handle(const std::string& text);
  void set_control(const signalk::StreamRequest& request, const std::string& token);
  void send(const signalk::Json& document);
  void send_news(std::chrono::steady_clock::time_point now);
  void send_others(std::chrono::steady_clock::time_point now);
  void write();

  NetContext& context_;
  SignalkSite& site_;
  std::unique_ptr<WsStream> stream_;
  ConnectionSlotPtr slot_;
  ClientPtr client_;
  StreamRight right_;
  signalk::Subscriptions subscriptions_;
  std::map<std::string, Sent> sent_;  // by path
  signalk::Subscriptions of_others_;
  std::map<std::string, std::map<std::string, signalk::Json>> others_sent_;  // by key and path
  std::chrono::steady_clock::time_point others_due_{};
  std::deque<std::string> queue_;  // the first is in flight
  std::chrono::steady_clock::time_point write_began_{};
  beast::flat_buffer request_{kLongestRequest};
  bool reading_ = false;
  bool closed_ = false;
};

}  // namespace skerry::server
