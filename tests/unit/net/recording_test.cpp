// Recorder and playback as the network serves them, without either.
#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "server/net/common/recording_news.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

using std::chrono::milliseconds;

// Thread: any.
class FakeRecorder final : public RecordingPort {
 public:
  wire::Reply record(const wire::Record& record, const std::string& origin) override {
    const std::lock_guard lock(mutex_);
    asked_ = record;
    origin_ = origin;
    wire::Reply reply;
    if (record.action() == wire::Record::MARK && phase_ == wire::RecorderState::OFF) {
      reply.set_code(wire::Reply::REFUSED);
      reply.set_text("nothing is being recorded");
    } else {
      phase_ = record.action() == wire::Record::STOP ? wire::RecorderState::OFF
                                                     : wire::RecorderState::RECORDING;
      ++version_;
    }
    return reply;
  }
  wire::RecorderState state() const override {
    const std::lock_guard lock(mutex_);
    wire::RecorderState state;
    state.set_phase(phase_);
    state.set_folder("/recordings");
    return state;
  }
  std::uint64_t version() const override {
    const std::lock_guard lock(mutex_);
    return version_;
  }
  wire::Record asked() const {
    const std::lock_guard lock(mutex_);
    return asked_;
  }
  std::string origin() const {
    const std::lock_guard lock(mutex_);
    return origin_;
  }

 private:
  mutable std::mutex mutex_;
  wire::Record asked_;
  std::string origin_;
  wire::RecorderState::Phase phase_ = wire::RecorderState::OFF;
  std::uint64_t version_ = 1;
};

class FakePlayer final : public PlaybackPort {
 public:
  wire::Reply control(const wire::Playback& playback, const std::string&) override {
    const std::lock_guard lock(mutex_);
    if (playback.has_playing()) playing_ = playback.playing();
    ++version_;
    return {};
  }
  wire::PlaybackState state() const override {
    const std::lock_guard lock(mutex_);
    wire::PlaybackState state;
    state.set_file("storm.mcap");
    state.set_playing(playing_);
    return state;
  }
  std::uint64_t version() const override {
    const std::lock_guard lock(mutex_);
    return version_;
  }

 private:
  mutable std::mutex mutex_;
  bool playing_ = false;
  std::uint64_t version_ = 1;
};

wire::ClientMessage record_message(std::uint32_t request, wire::Record::Action action) {
  wire::ClientMessage message;
  message.set_request(request);
  message.mutable_record()->set_action(action);
  message.mutable_record()->set_name("watch 3");
  message.mutable_record()->set_token("of no use here");
  return message;
}

wire::ClientMessage playing_message(std::uint32_t request, bool playing) {
  wire::ClientMessage message;
  message.set_request(request);
  message.mutable_playback()->set_playing(playing);
  return message;
}

class Recordings : public testing::Test {
 protected:
  void start() {
    server_.emplace(host_, test_config(), std::span<const WebFile>{});
    server_->start();
  }
  ~Recordings() override {
    if (server_) server_->stop();
  }
  // The next message for which `wanted`.
  template <typename Wanted>
  wire::ServerMessage next(TestClient& client, Wanted&& wanted) {
    auto message = client.receive();
    while (message && !wanted(*message)) message = client.receive();
    EXPECT_TRUE(message.has_value());
    return message.value_or(wire::ServerMessage{});
  }

  FakeHost host_;
  FakeRecorder recorder_;
  FakePlayer player_;
  std::optional<NetServer> server_;
};

TEST_F(Recordings, AHostWithoutThemSaysSoAndRefuses) {
  start();
  TestClient client(server_->tcp_port());
  const wire::Hello hello = client.receive_hello();
  EXPECT_FALSE(hello.can_record());
  EXPECT_FALSE(hello.playback());
  client.send(record_message(4, wire::Record::START));
  wire::Reply reply = client.receive_reply();
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_EQ(reply.request(), 4u);
  client.send(playing_message(5, true));
  reply = client.receive_reply();
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_EQ(reply.request(), 5u);
  const wire::Status status = client.get_status();
  EXPECT_FALSE(status.has_recorder());
  EXPECT_FALSE(status.has_playback());
}

TEST_F(Recordings, ARequestGoesToTheRecorderAndItsStateToSubscribedClients) {
  host_.recorder = &recorder_;
  start();
  TestClient watches = TestClient::over_websocket(server_->http_port());
  EXPECT_TRUE(watches.receive_hello().can_record());
  watches.subscribe();
  const auto is_state = [](const wire::ServerMessage& message) { return message.has_recorder(); };
  EXPECT_EQ(next(watches, is_state).recorder().phase(), wire::RecorderState::OFF);

  TestClient asks(server_->tcp_port());
  asks.receive_hello();
  asks.send(record_message(1, wire::Record::MARK));
  wire::Reply reply = asks.receive_reply();
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_EQ(reply.text(), "nothing is being recorded");
  asks.send(record_message(2, wire::Record::START));
  reply = asks.receive_reply();
  EXPECT_EQ(reply.code(), wire::Reply::OK);
  EXPECT_EQ(reply.request(), 2u);
  EXPECT_EQ(recorder_.asked().name(), "watch 3");
  EXPECT_EQ(recorder_.origin().rfind("console 127.0.0.1:", 0), 0u) << recorder_.origin();
  const auto records = [](const wire::ServerMessage& message) {
    return message.has_recorder() && message.recorder().phase() == wire::RecorderState::RECORDING;
  };
  EXPECT_EQ(next(watches, records).recorder().folder(), "/recordings");
  EXPECT_EQ(asks.get_status().recorder().phase(), wire::RecorderState::RECORDING);
}

TEST_F(Recordings, APlaybackIsControlledAndItsStateSent) {
  host_.player = &player_;
  start();
  TestClient client(server_->tcp_port());
  const wire::Hello hello = client.receive_hello();
  EXPECT_TRUE(hello.playback());
  EXPECT_FALSE(hello.can_record());
  client.subscribe();
  client.send(playing_message(7, true));
  const auto plays = [](const wire::ServerMessage& message) {
    return message.has_playback() && message.playback().playing();
  };
  EXPECT_EQ(next(client, plays).playback().file(), "storm.mcap");
  EXPECT_TRUE(client.get_status().playback().playing());
}

TEST(RecordingNews, TellsChangesAtOnceAndWhatGoesOnAtItsPace) {
  FakeHost host;
  FakeRecorder recorder;
  FakePlayer player;
  host.recorder = &recorder;
  host.player = &player;
  RecordingNews news(host);
  std::chrono::steady_clock::time_point now{};
  struct Count {
    int recorder = 0, playback = 0;
  };
  // Counts the answers to calls ten times a second.
  const auto told_in = [&](int calls) {
    Count count;
    for (int i = 0; i < calls; ++i) {
      const RecordingNews::Frames due = news.due(now);
      count.recorder += due.whole.recorder != nullptr;
      count.playback += due.whole.playback != nullptr;
      now += milliseconds(100);
    }
    return count;
  };
  Count told = told_in(50);
  EXPECT_EQ(told.recorder, 1);
  EXPECT_EQ(told.playback, 1);
  wire::Record start;
  recorder.record(start, "");
  wire::Playback play;
  play.set_playing(true);
  player.control(play, "");
  told = told_in(1);
  EXPECT_EQ(told.recorder, 1);
  EXPECT_EQ(told.playback, 1);
  told = told_in(50);
  EXPECT_EQ(told.recorder, 5);
  EXPECT_EQ(told.playback, 10);
}

TEST(RecordingNews, HasNothingOfAHostThatDoesNeither) {
  FakeHost host;
  RecordingNews news(host);
  const RecordingNews::Frames due = news.due({});
  EXPECT_EQ(due.whole.recorder, nullptr);
  EXPECT_EQ(due.whole.playback, nullptr);
  EXPECT_EQ(news.all().whole.recorder, nullptr);
}

}  // namespace
}  // namespace skerry::server
