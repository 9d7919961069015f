// OtherServer: what a relay's talk is answered by in tests, message by message, without sockets.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/video/range_scale.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/net/common/encoders.hpp"
#include "server/relay/upstream_talk.hpp"

namespace skerry::server {

inline wire::Hello hello_of(std::uint32_t radars, const std::string& identity = "first run") {
  wire::Hello hello;
  hello.set_protocol_version(1);
  hello.set_server("skerryd test");
  hello.set_scenario("Bergen");
  hello.set_identity(identity);
  hello.set_you("console 127.0.0.1:4711");
  for (std::uint32_t radar = 0; radar < radars; ++radar) {
    wire::RadarInfo& info = *hello.add_radars();
    info.set_radar(radar);
    info.set_name("radar " + std::to_string(radar));
    info.set_own_ship("Tern");
    info.set_spokes_per_turn(2048);
    info.set_cells(512);
    info.set_bits(8);
    info.set_rpm(24);
  }
  for (const double nm : RangeScale::kNauticalMiles) hello.add_range_scales_nm(nm);
  return hello;
}

inline Spoke spoke_of(std::uint32_t radar, std::uint32_t view, std::uint64_t sequence) {
  Spoke spoke;
  spoke.header.radar = radar;
  spoke.header.view = view;
  spoke.header.sequence = sequence;
  spoke.header.scan = static_cast<std::uint32_t>(sequence / 2048);
  spoke.header.index = static_cast<std::uint32_t>(sequence % 2048);
  spoke.header.geometry = {2048, 512, 8};
  spoke.header.own_ship = {60.4, 5.1};
  spoke.header.utc = UtcTime(std::chrono::seconds(1'795'000'000));
  spoke.cells.resize(512);
  for (std::size_t i = 0; i < spoke.cells.size(); ++i) {
    spoke.cells[i] = static_cast<std::uint8_t>(sequence * 7 + i);
  }
  return spoke;
}

// A relay's host and talk, with the test in the place of the sockets and of the other server.
class RelayUnderTest {
 public:
  using LineId = UpstreamTalk::LineId;

  explicit RelayUnderTest(const wire::Hello& hello = hello_of(1), std::string token = {},
                          std::optional<std::uint32_t> thin = 0)
      : greeting(hello),
        host(hello, {"192.0.2.7:7410", "skerryd relay", "the relay", kNativeFormat}),
        talk(host, std::move(token), now, thin) {
    for (std::uint32_t radar = 0; radar < host.radar_count(); ++radar) {
      prepare(*host.find_channel(radar, 0));
    }
  }

  static void prepare(VideoChannel& channel) {
    channel.add_format(kNativeFormat, native_encoder());
  }

  // Lets time go by, and begins what is to be begun.
  void pass(std::chrono::milliseconds time) {
    now += time;
    talk.tick(now);
    step();
  }
  void step() {
    talk.take_orders(now);
    for (const LineId id : talk.to_end()) {
      ended.push_back(id);
      begun.erase(id);
    }
    for (const LineId id : talk.to_begin(now)) {
      attempts.push_back(now);
      begun.insert_or_assign(id, FrameReader(kMaxClientFrame));
    }
  }

  // A connection ends, or could not be made.
  void cut(LineId id, const std::string& why) {
    begun.erase(id);
    talk.ended(id, why, now);
  }

  // What the relay has said on a line since it was last asked.
  std::vector<wire::ClientMessage> said(LineId id) {
    talk.take_orders(now);
    FrameReader& frames = begun.at(id);
    frames.feed(talk.take_output(id));
    std::vector<wire::ClientMessage> messages;
    for (auto body = frames.next(); body.ok() && *body; body = frames.next()) {
      messages.emplace_back();
      EXPECT_TRUE(
          messages.back().ParseFromArray((*body)->data(), static_cast<int>((*body)->size())));
    }
    return messages;
  }
  void say(LineId id, const wire::ServerMessage& message) {
    Bytes bytes;
    append_frame(bytes, message);
    say(id, bytes);
  }
  void say(LineId id, const Bytes& bytes) {
    talk.take(id, bytes, now);
    talk.flush(id, now);
    step();
  }
  void say_hello(LineId id) {
    wire::ServerMessage message;
    *message.mutable_hello() = greeting;
    say(id, message);
  }
  void reply(LineId id, std::uint32_t request, wire::Reply::Code code = wire::Reply::OK,
             const std::string& text = {}, std::uint32_t view = 0) {
    wire::ServerMessage message;
    message.mutable_reply()->set_request(request);
    message.mutable_reply()->set_code(code);
    message.mutable_reply()->set_text(text);
    message.mutable_reply()->set_view(view);
    say(id, message);
  }
  // Connects a line that has begun, and grants its subscription; gives that.
  wire::Subscribe accept(LineId id, std::uint32_t view = 0) {
    talk.connected(id, now);
    say_hello(id);
    const auto asked = said(id);
    if (asked.size() != 1 || !asked[0].has_subscribe()) {
      ADD_FAILURE() << "it has not subscribed";
      return {};
    }
    reply(id, asked[0].request(), wire::Reply::OK, {}, view);
    return asked[0].subscribe();
  }
  // All lines that have begun and are not there yet.
  void accept_all() {
    step();
    accept(1);
    step();
    for (LineId id = 2; id <= host.radar_count(); ++id) accept(id);
  }
  void send_spokes(LineId id, std::uint32_t radar, std::uint32_t view, std::uint64_t first,
                   std::uint64_t count) {
    Bytes bytes;
    for (std::uint64_t i = 0; i < count; ++i) {
      append_spoke_frame(bytes, spoke_of(radar, view, first + i));
    }
    say(id, bytes);
  }
  wire::Settings settings_from(LineId id, std::uint32_t radar, std::uint32_t view, double gain) {
    wire::ServerMessage message;
    wire::Settings& settings = *message.mutable_settings();
    settings.set_radar(radar);
    settings.set_view(view);
    settings.set_range_nm(6);
    settings.set_gain(gain);
    say(id, message);
    return settings;
  }

  SteadyTime now = std::chrono::steady_clock::now();  // moved by the test alone
  wire::Hello greeting;
  UpstreamHost host;
  UpstreamTalk talk;
  std::map<LineId, FrameReader> begun;  // those that are to be there
  std::vector<LineId> ended;
  std::vector<SteadyTime> attempts;
};

// What a console here would take.
class Console {
 public:
  explicit Console(VideoChannelPtr channel)
      : channel_(std::move(channel)),
        registered_(channel_->format(kNativeFormat).on_publish([] {})),
        cursor_(channel_->format(kNativeFormat).cursor_at_end()) {}
  Bytes take() {
    Bytes bytes;
    while (const auto sector = channel_->format(kNativeFormat).take(cursor_)) {
      bytes.insert(bytes.end(), sector->bytes.begin(), sector->bytes.end());
    }
    return bytes;
  }

 private:
  VideoChannelPtr channel_;
  FormatRing::Registration registered_;
  Cursor cursor_;
};

inline std::vector<wire::Spoke> spokes_in(const Bytes& bytes) {
  FrameReader frames(kMaxServerFrame);
  frames.feed(bytes);
  std::vector<wire::Spoke> spokes;
  for (auto body = frames.next(); body.ok() && *body; body = frames.next()) {
    wire::ServerMessage message;
    EXPECT_TRUE(message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size())));
    spokes.push_back(message.spoke());
  }
  return spokes;
}

}  // namespace skerry::server
