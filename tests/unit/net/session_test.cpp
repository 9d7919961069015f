// NativeSession on a transport made for tests: who may control, and failure at every operation.
#include "server/net/native/native_session.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "server/net/common/encoders.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

// The test's end of the line; outlives the transport.
struct Line {
  bool on_own_host = true;
  TcpPeer peer() const {
    const auto address = asio::ip::make_address(on_own_host ? "127.0.0.1" : "192.0.2.7");
    return {"far away", on_own_host ? PeerNet::own_host() : PeerNet(address), on_own_host};
  }
  std::deque<Bytes> incoming;  // one read each; when empty, a read waits
  Bytes outgoing;
  int operations = 0;
  std::optional<int> fail_at;  // this operation, counted from 0, ends with an error
  bool finished = false;
  bool closed = false;
  int transports = 0;  // alive
};

class FakeTransport final : public ByteTransport {
 public:
  FakeTransport(asio::io_context& io, Line& line) : io_(io), line_(line) { ++line_.transports; }
  ~FakeTransport() override { --line_.transports; }

  void read_some(std::span<std::uint8_t> into, Done done) override {
    if (fails()) return answer(std::move(done), asio::error::connection_reset, 0);
    if (line_.incoming.empty()) {
      waiting_read_ = std::move(done);
      return;
    }
    const Bytes bytes = line_.incoming.front();
    line_.incoming.pop_front();
    std::copy(bytes.begin(), bytes.end(), into.begin());
    answer(std::move(done), {}, bytes.size());
  }
  void write(const std::vector<asio::const_buffer>& buffers, Done done) override {
    if (fails()) return answer(std::move(done), asio::error::broken_pipe, 0);
    std::size_t size = 0;
    for (const auto& buffer : buffers) {
      const auto* data = static_cast<const std::uint8_t*>(buffer.data());
      line_.outgoing.insert(line_.outgoing.end(), data, data + buffer.size());
      size += buffer.size();
    }
    answer(std::move(done), {}, size);
  }
  void finish() override { line_.finished = true; }
  void close() override {
    line_.closed = true;
    if (waiting_read_)
      answer(std::exchange(waiting_read_, nullptr), asio::error::operation_aborted, 0);
  }
  void limit_send_buffer(std::size_t) override {}
  std::string name() const override { return "fake"; }

 private:
  bool fails() { return line_.operations++ == line_.fail_at; }
  void answer(Done done, error_code error, std::size_t size) {
    asio::post(io_, [done = std::move(done), error, size] { done(error, size); });
  }

  asio::io_context& io_;
  Line& line_;
  Done waiting_read_;
};

std::vector<wire::ServerMessage> messages_in(const Bytes& outgoing) {
  std::vector<wire::ServerMessage> messages;
  FrameReader reader(kMaxServerFrame);
  reader.feed(outgoing);
  for (auto frame = reader.next(); frame.ok() && frame->has_value(); frame = reader.next()) {
    wire::ServerMessage& message = messages.emplace_back();
    EXPECT_TRUE(message.ParseFromArray((*frame)->data(), static_cast<int>((*frame)->size())));
  }
  return messages;
}

std::vector<wire::Reply> replies_in(const Bytes& outgoing) {
  std::vector<wire::Reply> replies;
  for (const wire::ServerMessage& message : messages_in(outgoing)) {
    if (message.has_reply()) replies.push_back(message.reply());
  }
  return replies;
}

class Session : public testing::Test {
 protected:
  ~Session() override {  // a waiting read of FakeTransport owns the session, which owns it
    context_->connections.close_all();
    run();
    EXPECT_EQ(line_.transports, 0);
  }
  void begin(NetConfig config = test_config()) {
    host_.find_channel(0, 0)->add_format(kNativeFormat, native_encoder());
    context_ = std::make_unique<NetContext>(host_, std::move(config));
    NativeSession::begin(*context_, std::make_unique<FakeTransport>(context_->io, line_),
                         context_->connections.try_enter(line_.peer()));
    run();
  }
  void run() {
    context_->io.restart();
    context_->io.poll();
  }

  FakeHost host_;
  Line line_;
  std::unique_ptr<NetContext> context_;
};

wire::ClientMessage set_with_token(const std::string& token) {
  wire::ClientMessage message = set_gain_message(1, 0, 77);
  message.mutable_set()->set_token(token);
  return message;
}

TEST_F(Session, ControlFromAnotherHostIsRefusedWithoutAConfiguredToken) {
  line_.on_own_host = false;
  line_.incoming = {frame_of(set_with_token("guess"))};
  begin();
  const auto replies = replies_in(line_.outgoing);
  ASSERT_EQ(replies.size(), 1u);
  EXPECT_EQ(replies[0].code(), wire::Reply::REFUSED);
  EXPECT_EQ(host_.settings(0, 0).gain(), 50);
  EXPECT_FALSE(line_.closed) << "it may still look";
}

TEST_F(Session, FromAnotherHostABoardIsReadFreelyAndStreamedAndChangedWithTheToken) {
  host_.board = std::make_shared<FakeBoard>();
  NetConfig config = test_config();
  config.control_token = "secret";
  line_.on_own_host = false;
  wire::ClientMessage read, write, fifo, ring, stream;
  read.mutable_board_access()->add_operations()->set_address(4);
  write.mutable_board_access()->add_operations()->set_write(1);
  fifo.mutable_board_fifo()->set_count(1);
  ring.mutable_board_ring();
  stream.mutable_board_stream()->set_kind(wire::BoardStream::RECORDS);
  for (const wire::ClientMessage& message : {read, stream, write, fifo, ring}) {
    line_.incoming.push_back(frame_of(message));
  }
  write.mutable_board_access()->set_token("secret");
  fifo.mutable_board_fifo()->set_token("secret");
  ring.mutable_board_ring()->set_token("secret");
  stream.mutable_board_stream()->set_token("secret");
  for (const wire::ClientMessage& message : {stream, write, fifo, ring}) {
    line_.incoming.push_back(frame_of(message));
  }
  begin(config);
  std::vector<wire::Reply::Code> codes;
  for (const wire::Reply& reply : replies_in(line_.outgoing)) codes.push_back(reply.code());
  const auto ok = wire::Reply::OK, refused = wire::Reply::REFUSED;
  EXPECT_EQ(codes, (std::vector{ok, refused, refused, refused, refused, ok, ok, ok, ok}));
  EXPECT_EQ(host_.board->writes, 1);
  EXPECT_GT(host_.board->lease.use_count(), 1);
}

TEST_F(Session, ControlFromAnotherHostNeedsTheToken) {
  NetConfig config = test_config();
  config.control_token = "secret";
  line_.on_own_host = false;
  line_.incoming = {frame_of(set_with_token("guess")), frame_of(set_with_token("secret"))};
  begin(config);
  const auto replies = replies_in(line_.outgoing);
  ASSERT_EQ(replies.size(), 2u);
  EXPECT_EQ(replies[0].code(), wire::Reply::REFUSED);
  EXPECT_EQ(replies[1].code(), wire::Reply::OK);
  EXPECT_EQ(host_.settings(0, 0).gain(), 77);
  EXPECT_EQ(host_.last_set().token(), "") << "the token goes no further";
}

TEST_F(Session, ControlFromTheServersOwnHostNeedsNone) {
  line_.incoming = {frame_of(set_with_token(""))};
  begin();
  ASSERT_EQ(replies_in(line_.outgoing).size(), 1u);
  EXPECT_EQ(host_.settings(0, 0).gain(), 77);
}

wire::ClientMessage new_view_message(std::uint32_t request, std::uint32_t like,
                                     const std::string& token = "") {
  wire::ClientMessage message = subscribe_message(request, 0);
  message.mutable_subscribe()->set_view(like);
  message.mutable_subscribe()->set_new_view(true);
  message.mutable_subscribe()->set_token(token);
  return message;
}

TEST_F(Session, AViewOfItsOwnIsNamedInTheReplyAndInWhatFollows) {
  line_.incoming = {frame_of(new_view_message(1, 0))};
  begin();
  host_.publish();
  run();
  const auto replies = replies_in(line_.outgoing);
  ASSERT_EQ(replies.size(), 1u);
  EXPECT_EQ(replies[0].code(), wire::Reply::OK);
  EXPECT_EQ(replies[0].view(), 1u);
  bool settings = false, world = false;
  int spokes = 0;
  for (const wire::ServerMessage& message : messages_in(line_.outgoing)) {
    if (message.has_settings()) settings = message.settings().view() == 1;
    if (message.has_world()) world = true;
    if (message.has_spoke() && message.spoke().view() == 1) ++spokes;
  }
  EXPECT_TRUE(settings);
  EXPECT_TRUE(world);
  EXPECT_EQ(spokes, 16);
}

TEST_F(Session, AViewOfItsOwnNeedsTheTokenFromAnotherHost) {
  NetConfig config = test_config();
  config.control_token = "secret";
  line_.on_own_host = false;
  line_.incoming = {frame_of(new_view_message(1, 0)), frame_of(new_view_message(2, 0, "secret"))};
  begin(config);
  const auto replies = replies_in(line_.outgoing);
  ASSERT_EQ(replies.size(), 2u);
  EXPECT_EQ(replies[0].code(), wire::Reply::REFUSED);
  EXPECT_EQ(replies[1].code(), wire::Reply::OK);
  EXPECT_EQ(host_.view_count(0), 2u);
}

TEST_F(Session, MoreViewsThanThereMayBeAreRefusedAndTheOldSubscriptionStays) {
  line_.incoming = {frame_of(new_view_message(1, 0)), frame_of(new_view_message(2, 1)),
                    frame_of(new_view_message(3, 0)), frame_of(new_view_message(4, 99))};
  begin();
  const auto replies = replies_in(line_.outgoing);
  ASSERT_EQ(replies.size(), 4u);
  EXPECT_EQ(replies[1].view(), 2u);
  EXPECT_EQ(replies[2].code(), wire::Reply::REFUSED);
  EXPECT_EQ(replies[3].code(), wire::Reply::UNKNOWN);
  line_.outgoing.clear();
  host_.publish();
  run();
  for (const wire::ServerMessage& message : messages_in(line_.outgoing)) {
    if (message.has_spoke()) {
      EXPECT_EQ(message.spoke().view(), 2u);
    }
  }
  EXPECT_FALSE(line_.outgoing.empty());
}

TEST_F(Session, AViewWithoutNativeVideoIsNoneForAConsole) {
  ASSERT_EQ(host_.open_view(0, 0, false, [](VideoChannel&) {}), 1u);
  line_.incoming = {frame_of(new_view_message(1, 1)), frame_of(new_view_message(2, 0))};
  begin();
  const auto replies = replies_in(line_.outgoing);
  ASSERT_EQ(replies.size(), 2u);
  EXPECT_EQ(replies[0].code(), wire::Reply::UNKNOWN);
  EXPECT_EQ(replies[1].code(), wire::Reply::OK);
}

TEST_F(Session, AViewEndsSomeTimeAfterItsLastReaderHasLeft) {
  line_.incoming = {frame_of(new_view_message(1, 0))};
  begin();
  const auto now = std::chrono::steady_clock::now();
  context_->end_views(now + std::chrono::hours(1));
  EXPECT_EQ(host_.view_count(0), 2u) << "it is being read";
  context_->connections.close_all();
  context_->end_views(now + std::chrono::hours(1) + NetContext::kViewGrace / 2);
  EXPECT_EQ(host_.view_count(0), 2u);
  context_->end_views(now + std::chrono::hours(1) + NetContext::kViewGrace);
  EXPECT_EQ(host_.view_count(0), 1u);
  EXPECT_EQ(context_->find_feed(0, 1, kNativeFormat), nullptr);
  host_.publish();
  run();
}

TEST_F(Session, AViewThatEndsWithAWakeUpOnItsWayLeavesNothingBehind) {
  line_.incoming = {frame_of(new_view_message(1, 0))};
  begin();
  host_.publish();  // posts a wake-up that has not run
  context_->connections.close_all();
  context_->end_views(std::chrono::steady_clock::now() + std::chrono::hours(1));
  EXPECT_EQ(host_.view_count(0), 1u);
  run();
}

TEST_F(Session, TheWorldIsToldWhenItChanges) {
  line_.incoming = {frame_of(subscribe_message(1, 0))};
  begin();
  line_.outgoing.clear();
  context_->tell_settings();
  run();
  EXPECT_TRUE(line_.outgoing.empty()) << "nothing has changed";
  host_.change_world(4.0);
  context_->tell_settings();
  run();
  const auto messages = messages_in(line_.outgoing);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].world().sea_state(), 4.0);
}

wire::ClientMessage listen_message(std::uint32_t request, std::uint32_t own_ship_hz) {
  wire::ClientMessage message = subscribe_message(request, 0);
  message.mutable_subscribe()->set_own_ship_hz(own_ship_hz);
  message.mutable_subscribe()->set_no_spokes(true);
  return message;
}

TEST_F(Session, HelloNamesTheClientAsItsChangesAreNamed) {
  line_.incoming = {frame_of(set_gain_message(1, 0, 60))};
  begin();
  const auto messages = messages_in(line_.outgoing);
  ASSERT_FALSE(messages.empty());
  EXPECT_EQ(messages[0].hello().you(), "console far away");
  EXPECT_EQ(host_.origins(), std::vector{messages[0].hello().you()});
}

TEST_F(Session, OwnShipComesAsOftenAsIsAskedEvenlySpread) {
  begin();
  for (std::uint32_t hz = 0; hz <= kOwnShipMostHz; ++hz) {
    line_.incoming = {frame_of(listen_message(1, hz))};
    context_->connections.close_all();
    run();
    line_.closed = false;
    NativeSession::begin(*context_, std::make_unique<FakeTransport>(context_->io, line_),
                         context_->connections.try_enter(line_.peer()));
    run();
    const std::uint32_t wanted = std::max(hz, 1u);
    for (int second = 0; second < 3; ++second) {
      std::uint32_t came = 0;
      for (std::uint32_t tick = 1; tick <= kOwnShipMostHz; ++tick) {
        line_.outgoing.clear();
        context_->tell_own_ships();
        run();
        for (const auto& message : messages_in(line_.outgoing)) came += message.has_own_ship();
        EXPECT_EQ(came, tick * wanted / kOwnShipMostHz) << hz << " Hz, tick " << tick;
      }
    }
  }
}

TEST_F(Session, OwnShipOftenerThanItComesIsRefusedAndTheSubscriptionStays) {
  line_.incoming = {frame_of(listen_message(1, 2)), frame_of(listen_message(2, 11))};
  begin();
  const auto replies = replies_in(line_.outgoing);
  ASSERT_EQ(replies.size(), 2u);
  EXPECT_EQ(replies[1].code(), wire::Reply::OUT_OF_RANGE);
  EXPECT_EQ(replies[1].text(), "own_ship_hz: 11 is out of range; allowed: 1 to 10");
  line_.outgoing.clear();
  for (int tick = 0; tick < 10; ++tick) {
    context_->tell_own_ships();
    run();
  }
  EXPECT_EQ(messages_in(line_.outgoing).size(), 2u);
}

TEST_F(Session, WithoutSpokesEverythingElseComesAndNothingIsEncoded) {
  line_.incoming = {frame_of(listen_message(1, 1))};
  begin();
  int settings = 0, ships = 0, worlds = 0;
  for (const auto& message : messages_in(line_.outgoing)) {
    settings += message.has_settings();
    ships += message.has_own_ship();
    worlds += message.has_world();
  }
  EXPECT_EQ(settings, 1);
  EXPECT_EQ(ships, 1);
  EXPECT_EQ(worlds, 1);
  line_.outgoing.clear();
  host_.publish();
  run();
  EXPECT_TRUE(line_.outgoing.empty());
  EXPECT_EQ(host_.encoded(kNativeFormat), 0u);
  host_.change_world(4.0);
  context_->tell_settings();
  run();
  ASSERT_EQ(messages_in(line_.outgoing).size(), 1u);

  // Beside one that takes them.
  Line other;
  other.incoming = {frame_of(subscribe_message(1, 0))};
  NativeSession::begin(*context_, std::make_unique<FakeTransport>(context_->io, other),
                       context_->connections.try_enter(line_.peer()));
  run();
  line_.outgoing.clear();
  other.outgoing.clear();
  host_.publish();
  run();
  EXPECT_TRUE(line_.outgoing.empty());
  EXPECT_EQ(messages_in(other.outgoing).size(), FakeHost::kSectorSpokes);
  context_->connections.close_all();
  run();
}

TEST_F(Session, AViewLastsForOneWhoListensToItWithoutSpokes) {
  wire::ClientMessage message = new_view_message(1, 0);
  message.mutable_subscribe()->set_no_spokes(true);
  line_.incoming = {frame_of(message)};
  begin();
  ASSERT_EQ(host_.view_count(0), 2u);
  context_->end_views(std::chrono::steady_clock::now() + std::chrono::hours(1));
  EXPECT_EQ(host_.view_count(0), 2u);
}

// Runs a whole conversation, failing its first operation, then its second, and so on until it gets
// through: each time the session is gone afterwards and holds no registration.
TEST(SessionFaults, AFailureAtAnyOperationEndsTheSessionAndNothingElse) {
  bool got_through = false;
  int operations = 0;
  for (int fail_at = 0; !got_through; ++fail_at) {
    FakeHost host;
    Line line;
    line.fail_at = fail_at;
    line.incoming = {frame_of(subscribe_message(1, 0)), frame_of(get_status_message(2)),
                     frame_of(set_gain_message(3, 0, 9))};
    host.find_channel(0, 0)->add_format(kNativeFormat, native_encoder());
    NetContext context(host, test_config());
    NativeSession::begin(context, std::make_unique<FakeTransport>(context.io, line),
                         context.connections.try_enter(line.peer()));
    context.io.poll();
    for (int i = 0; i < 3; ++i) {
      host.publish();
      context.io.restart();
      context.io.poll();
    }
    operations = line.operations;
    got_through = operations <= fail_at;
    EXPECT_EQ(line.closed, !got_through);
    EXPECT_EQ(line.transports, got_through ? 1 : 0) << "operation " << fail_at;
    const std::uint64_t encoded = host.encoded(kNativeFormat);
    host.publish();
    EXPECT_EQ(host.encoded(kNativeFormat) - encoded, got_through ? 16u : 0u);
    context.connections.close_all();
    context.io.restart();
    context.io.poll();
    EXPECT_EQ(line.transports, 0);
    ASSERT_LT(fail_at, 100);
  }
  EXPECT_GT(operations, 8) << "three requests with their answers, and three sectors";
}

}  // namespace
}  // namespace skerry::server
