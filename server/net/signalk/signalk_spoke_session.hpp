// SignalkSpokeSession: one display that takes a radar's spokes by WebSocket.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "server/net/common/net_context.hpp"
#include "server/net/common/peer_stream.hpp"
#include "server/net/signalk/signalk_site.hpp"
#include "server/net/signalk/stream_right.hpp"

namespace skerry::server {

// Sends messages of kMessageSpokes spokes or more, and what is left of them ten times a second; at
// most one is in flight.  What waits meanwhile waits in the ring, which overwrites it and counts.
// Bytes from the client are read and thrown away.  Thread: net-0.
class SignalkSpokeSession final : public Connection,
                                  public FeedReader,
                                  public SignalkListener,
                                  public std::enable_shared_from_this<SignalkSpokeSession> {
 public:
  static constexpr std::size_t kMessageSpokes = 32;
  static constexpr std::size_t kMostSpokes = 256;  // of one message to a display that fell behind

  // Requires a stream whose handshake is done.
  static void begin(NetContext& context, SignalkSite& site, std::uint32_t radar,
                    std::unique_ptr<WsStream> stream, ConnectionSlotPtr slot,
                    const StreamRight& right);

  SignalkSpokeSession(NetContext& context, std::uint32_t radar, std::unique_ptr<WsStream> stream,
                      ConnectionSlotPtr slot, const StreamRight& right);

  void close() override;
  void check(std::chrono::steady_clock::time_point now) override;
  void on_sector() override { pump(false); }
  void on_tick(std::chrono::steady_clock::time_point) override;

 private:
  void start();
  void read();
  void pump(bool all);  // sends what is there, unless it is too little and more may follow
  void on_written(error_code error, std::size_t size);

  NetContext& context_;
  std::unique_ptr<WsStream> stream_;
  ConnectionSlotPtr slot_;
  ClientPtr client_;
  std::uint32_t radar_;
  StreamRight right_;
  SpokeFeed* feed_ = nullptr;  // nullptr: closed
  Cursor cursor_;
  std::vector<EncodedSectorPtr> held_;  // for the next message, or of the one in flight
  std::vector<asio::const_buffer> buffers_;
  std::size_t held_spokes_ = 0;
  std::array<std::uint8_t, 512> unread_;
  bool writing_ = false;
  std::chrono::steady_clock::time_point write_began_{};
};

}  // namespace skerry::server
