// NativeSession: one client of the native protocol, on whatever transport.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/wire/frame.hpp"
#include "server/access/asked.hpp"
#include "server/net/common/net_context.hpp"
#include "server/net/common/signing_in.hpp"
#include "server/net/native/board_requests.hpp"
#include "server/net/native/byte_transport.hpp"

namespace skerry::server {

// The one message of a server that has no connection left, as a frame.
std::string native_refusal(const std::string& reason);

// Says Hello, answers requests in their order, and once subscribed sends spokes by whole sectors,
// and records of a board by blocks.
//
// Never holds more than it must for a client that does not read: spokes and records stay in the
// ring, which
// overwrites them and counts; of Settings, OwnShip, World and the states of recorder and playback
// only the newest waits; when kMaxReplies replies wait, no further request is read, and after
// NetConfig::reply_timeout the client is closed.  Ends a client that asks for nothing, or takes
// nothing, for as long as PeerLimits says.
//
// Alive as long as an operation of its own is in flight: nearly always a read, which also notices
// that the client has gone.
// Thread: net-0.
class NativeSession final : public Connection,
                            public FeedReader,
                            public std::enable_shared_from_this<NativeSession> {
 public:
  static constexpr std::size_t kMaxReplies = 64;
  static constexpr std::size_t kMaxReplyBytes = 64 * 1024;  // queued; one more reply may exceed it
  static constexpr std::size_t kBatchBytes = 64 * 1024;  // one write; one more sector may exceed it

  // `token`: what the client has shown already, good or not, as if it had signed in; empty:
  // nothing.
  static void begin(NetContext& context, std::unique_ptr<ByteTransport> transport,
                    ConnectionSlotPtr slot, std::string token = {});

  NativeSession(NetContext& context, std::unique_ptr<ByteTransport> transport,
                ConnectionSlotPtr slot, std::string token);

  void close() override;
  void check(std::chrono::steady_clock::time_point now) override;
  void on_sector() override { pump(); }
  bool is_trusted() const override { return slot_->is_trusted(); }
  std::uint32_t own_ship_hz() const override { return own_ship_hz_; }
  std::uint32_t exercise_hz() const override { return exercise_hz_; }
  void on_exercise(const SharedBytes& frame) override;
  std::uint32_t targets_hz() const override { return targets_hz_; }
  void on_targets(const SharedBytes& frame) override;
  void on_settings(const SharedBytes& frame) override;
  void on_own_ship(const SharedBytes& frame) override;
  void on_world(const SharedBytes& frame) override;
  void on_recorder(const SharedBytes& frame) override;
  void on_playback(const SharedBytes& frame) override;
  void on_fleet(const SharedBytes& frame) override;
  void on_send_buffer(std::size_t bytes) override;

 private:
  void start();
  void read();
  void on_read(error_code error, std::size_t size);
  void process();      // answers what was read, until the replies are too many
  bool handle_next();  // false: no whole request is left
  void handle(std::span<const std::uint8_t> body);
  void subscribe(std::uint32_t request, const wire::Subscribe& subscribe);
  // With the view it asks for, a new one among them.
  void subscribe_to(std::uint32_t request, const wire::Subscribe& subscribe,
                    const RadarHost::OpenedView& view);
  // A callback on net-0: `then` with the answer, unless the session has ended meanwhile, and then
  // the requests that have waited.
  template <typename Answer, typename Then>
  std::function<void(Answer)> when_answered(Then then);
  void set(std::uint32_t request, const wire::Set& set);
  void get_hops(std::uint32_t request);
  void get_coastline(std::uint32_t request, const wire::GetCoastline& place);
  void get_chart_objects(std::uint32_t request, const wire::GetChartObjects& place);
  // A chart that came, or did not, as message and reply.
  template <typename Chart, typename Put>
  void tell_chart(std::uint32_t request, ChartAnswer<Chart> chart, const Put& put);
  void order_targets(std::uint32_t request, const wire::TargetOrder& order);
  void record(std::uint32_t request, const wire::Record& record);
  void control_playback(std::uint32_t request, const wire::Playback& playback);
  // One of the board's kinds.
  void ask_board(const wire::ClientMessage& message);
  // Whether who sends it may ask for all that it asks for; if not, it has been answered.
  bool may(const wire::ClientMessage& message);
  std::optional<std::string> why_not_allowed(const Who& who, const Asked& asked) const;
  // Keeps what was asked for and this answer.
  void audit(const wire::Reply& answer);
  void sign_in(std::uint32_t request, const wire::SignIn& wanted);
  // By name and password, or class code: what comes meanwhile waits.
  void sign_in_by(std::uint32_t request, Credentials credentials);
  void signed_in(std::uint32_t request, SignInOutcome outcome);
  void tell_sign_in() const;  // to the audit
  // From now on what it asks for is asked with this token; empty: by nobody.
  void become(std::string token);
  void order_class(std::uint32_t request, const wire::ClassOrder& order);
  // Ends the connection of a client who may have no longer what it gets: its token was revoked or
  // has ended.
  void look_at_rights();
  // False: the connection was on trial and has failed, or this request is one change too many.
  bool admits(const wire::ClientMessage& message);
  void reply(std::uint32_t request, wire::Reply::Code code, std::string text,
             std::uint32_t view = 0);
  void reply(std::uint32_t request, wire::Reply answer);
  void send(const wire::ServerMessage& message);
  // Sends an error and ends the connection once the client has it.
  void fail(wire::Reply::Code code, std::string_view kind, std::string text);
  void unsubscribe();
  void limit_send_buffer();

  // Writes what there is to send, unless a write is in flight: what the kernel takes at once, and
  // then starts a write of the rest.  Handles no request.
  void pump();
  void gather_batch();
  void drop_written(std::size_t bytes);  // from the batch's begin
  void end_batch(bool whole);            // it was sent, or its connection has failed
  void add_to_batch(SharedBytes frame);
  void add_sectors_to_batch();
  void add_to_batch(EncodedSectorPtr sector);
  void on_written(error_code error, std::size_t size);

  bool replies_full() const {
    return replies_.size() >= kMaxReplies || reply_bytes_ >= kMaxReplyBytes;
  }
  void end_after(std::chrono::milliseconds time, std::string_view kind);

  NetContext& context_;
  std::unique_ptr<ByteTransport> transport_;
  ConnectionSlotPtr slot_;
  ClientPtr client_;
  Timer deadline_;  // for unread replies, or for the client to end a failed connection

  std::array<std::uint8_t, 4096> read_buffer_;
  FrameReader reader_{kMaxClientFrame};

  SpokeFeed* feed_ = nullptr;  // nullptr: not subscribed
  bool takes_spokes_ = false;
  Cursor cursor_;
  std::uint32_t own_ship_hz_ = kOwnShipLeastHz, exercise_hz_ = 0, targets_hz_ = 0;
  std::shared_ptr<const void> wanted_targets_;  // TargetPort::want()
  bool coastline_asked_ = false;                // and not yet told; the same of the next
  bool chart_asked_ = false;
  std::uint64_t lost_before_ = 0;  // by earlier subscriptions

  // As the log and other consoles name it.
  std::string origin() const { return "console " + client_->peer; }

  std::chrono::steady_clock::time_point began_{}, write_began_{};
  bool has_asked_ = false;  // for anything

  std::size_t spoke_buffer_ = 0;  // of the kernel's, for spokes

  BoardRequests boards_;

  std::string token_;            // signed in with
  bool has_made_token_ = false;  // it was made for this connection, and ends with it
  // A password is tried, or another server asked: until then nothing is handled.
  bool answer_pending_ = false;
  std::string who_;      // asked for what is handled, for the audit
  std::string audited_;  // what that is, until it is answered
  Asked asked_;          // by the message that is handled; its token is the one it was allowed by
  std::optional<Asked> subscribed_, streamed_;  // by the Subscribe and the BoardStream that hold
  std::uint64_t looked_at_ = 0;                 // Gate::generation() when these were looked at

  std::deque<SharedBytes> replies_;
  std::size_t reply_bytes_ = 0;
  // The newest not yet sent, of each kind.
  enum News : std::size_t {
    kSettings,
    kOwnShip,
    kWorld,
    kRecorder,
    kPlayback,
    kFleet,
    kExercise,
    kTargets,
    kKindsOfNews
  };
  void tell(News kind, const SharedBytes& frame);
  std::array<SharedBytes, kKindsOfNews> news_;

  std::vector<std::shared_ptr<const void>> batch_owners_;  // keep what the write in flight sends
  std::vector<asio::const_buffer> batch_;
  std::size_t batch_bytes_ = 0;
  std::uint64_t batch_spokes_ = 0;

  bool reading_ = false;
  bool writing_ = false;
  bool waiting_for_replies_ = false;  // requests are not read until replies have gone
  bool failed_ = false;               // only what is in replies_ is still sent
  bool finished_ = false;             // told the client that nothing more comes
  bool closed_ = false;
};

}  // namespace skerry::server
