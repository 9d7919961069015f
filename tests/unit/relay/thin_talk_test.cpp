// A relay that asks for thinner and finer spokes, and what its consoles have of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/thin/thin_encoder.hpp"
#include "tests/unit/relay/other_server.hpp"

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

std::vector<std::uint64_t> numbers_in(const Bytes& bytes) {
  std::vector<std::uint64_t> numbers;
  for (const wire::Spoke& spoke : spokes_in(bytes)) numbers.push_back(spoke.sequence());
  return numbers;
}

bool have_no_gap(const std::vector<std::uint64_t>& numbers) {
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] != numbers[i - 1] + 1) return false;
  }
  return true;
}

// Thin spokes, as the other server sends them.
Bytes thin_spokes(ThinEncoder& encoder, std::uint64_t first, std::uint64_t count) {
  Bytes bytes;
  for (std::uint64_t i = 0; i < count; ++i) {
    encoder.add(spoke_of(0, 0, first + i), [&](const wire::ThinSpokes& block) {
      wire::ServerMessage message;
      *message.mutable_thin_spokes() = block;
      append_frame(bytes, message);
    });
  }
  return bytes;
}

// What a console has of a turn: it takes sooner than its ring is full.
std::vector<std::uint64_t> thin_turn(RelayUnderTest& relay, Console& console, ThinEncoder& encoder,
                                     std::uint64_t first) {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = 0; i < 2048; i += 64) {
    relay.say(1, thin_spokes(encoder, first + i, 64));
    for (const std::uint64_t number : numbers_in(console.take())) numbers.push_back(number);
  }
  return numbers;
}

// The Subscribe that the relay has just said on a line that is there.
wire::ClientMessage new_subscription(RelayUnderTest& relay, RelayUnderTest::LineId id) {
  for (const wire::ClientMessage& message : relay.said(id)) {
    if (message.has_subscribe()) return message;
  }
  return {};
}

TEST(ThinTalk, NumbersGoOnWhenTheLevelChanges) {
  RelayUnderTest relay(hello_of(1), {}, std::nullopt);
  relay.step();
  EXPECT_EQ(relay.accept(1).thin(), 4u);
  Console console(relay.host.find_channel(0, 0));
  std::vector<std::uint64_t> numbers;
  // Sends every `each`-th block until the relay asks for something else; which it then gets.
  std::uint64_t next = 0;
  const auto until_asked = [&](ThinEncoder& encoder, std::uint64_t each) {
    wire::ClientMessage asked;
    for (int i = 0; i < 60 && !asked.has_subscribe(); ++i, next += 64) {
      const Bytes block = thin_spokes(encoder, next, 64);
      if (next / 64 % each == 0) relay.say(1, block);
      relay.pass(milliseconds(100));
      for (const std::uint64_t number : numbers_in(console.take())) numbers.push_back(number);
      asked = new_subscription(relay, 1);
    }
    EXPECT_FALSE(asked.subscribe().new_view());
    // Until it is answered, spokes come as they were.
    relay.say(1, thin_spokes(encoder, next, 64));
    relay.reply(1, asked.request());
    return asked.subscribe().thin();
  };
  ThinEncoder four(4), three(3), four_again(4);
  EXPECT_EQ(until_asked(four, 1), 3u);
  EXPECT_EQ(relay.host.hops().at(0).thin(), 3u);
  for (const std::uint64_t number : thin_turn(relay, console, three, 64 * 2048)) {
    numbers.push_back(number);
  }
  EXPECT_GT(numbers.size(), 1500u);
  EXPECT_TRUE(have_no_gap(numbers));
  // Half of the blocks are lost: that level was too much.
  EXPECT_EQ(until_asked(three, 2), 4u);
  EXPECT_FALSE(have_no_gap(numbers));
  numbers.clear();
  for (const std::uint64_t number : thin_turn(relay, console, four_again, 0)) {
    numbers.push_back(number);
  }
  EXPECT_GT(numbers.size(), 512u);
  EXPECT_TRUE(have_no_gap(numbers));
  EXPECT_GT(numbers.front(), 1500u);
}

TEST(ThinTalk, NumbersGoOnOverAConnectionThatEnds) {
  RelayUnderTest relay(hello_of(1), {}, 2);
  relay.step();
  EXPECT_EQ(relay.accept(1).thin(), 2u);
  Console console(relay.host.find_channel(0, 0));
  ThinEncoder encoder(2);
  auto numbers = thin_turn(relay, console, encoder, 2048);
  ASSERT_EQ(numbers.size(), 2048u);
  relay.cut(1, "gone");
  relay.pass(seconds(5));
  relay.accept(1);
  ThinEncoder anew(2);
  for (const std::uint64_t number : thin_turn(relay, console, anew, 4096))
    numbers.push_back(number);
  EXPECT_EQ(numbers.size(), 4096u);
  EXPECT_TRUE(have_no_gap(numbers));
}

TEST(ThinTalk, WhatIsNoThinSpokesEndsTheLine) {
  RelayUnderTest relay(hello_of(1), {}, 2);
  relay.step();
  relay.accept(1);
  wire::ServerMessage message;
  message.mutable_thin_spokes()->set_count(7);
  relay.say(1, message);
  EXPECT_THAT(relay.ended, testing::ElementsAre(1));
  EXPECT_THAT(relay.host.hops().at(0).problem(), HasSubstr("thin_spokes"));
}

}  // namespace
}  // namespace skerry::server
