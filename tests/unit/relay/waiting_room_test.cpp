#include "server/relay/waiting_room.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <deque>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "clients/common/asio.hpp"
#include "server/relay/radars_told.hpp"
#include "server/relay/upstream_place.hpp"

namespace skerry::server {
namespace {

using boost::asio::ip::tcp;
using testing::HasSubstr;

const std::string kHere = "127.0.0.1";

std::vector<std::uint16_t> free_ports(std::size_t count) {
  boost::asio::io_context io;
  std::deque<tcp::acceptor> taken;
  std::vector<std::uint16_t> ports;
  for (std::size_t i = 0; i < count; ++i) {
    taken.emplace_back(io, tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0));
    ports.push_back(taken.back().local_endpoint().port());
  }
  return ports;
}

wire::Hello hello_of_waiting(const std::string& identity) {
  wire::Hello hello;
  hello.set_protocol_version(1);
  hello.set_server("skerryd test");
  hello.set_identity(identity);
  return hello;
}

// Gives up after ten seconds.
std::optional<wire::Hello> wait_at(std::uint16_t port, WaitingRoom* room,
                                   std::vector<std::string>* told = nullptr) {
  const auto began = std::chrono::steady_clock::now();
  return first_hello(
      {kHere, port}, Tries::until_it_is_there,
      [began](std::chrono::milliseconds time) {
        std::this_thread::sleep_for(std::min(time, std::chrono::milliseconds(20)));
        return std::chrono::steady_clock::now() - began > std::chrono::seconds(10);
      },
      [told](const std::string& why) {
        if (told != nullptr) told->push_back(why);
      },
      room);
}

// Each relays the next, and the last the first: nobody serves.
TEST(WaitingRoom, RelaysThatWaitForEachOtherFindTheLoop) {
  for (const std::size_t count : {1u, 2u, 3u, 5u}) {
    const auto ports = free_ports(count);
    std::deque<WaitingRoom> rooms;
    for (std::size_t i = 0; i < count; ++i) {
      rooms.emplace_back(kHere, ports[i], hello_of_waiting("relay " + std::to_string(i)));
      ASSERT_TRUE(rooms.back().is_open());
    }
    std::vector<std::future<std::optional<wire::Hello>>> found;
    for (std::size_t i = 0; i < count; ++i) {
      found.push_back(std::async(std::launch::async,
                                 [&, i] { return wait_at(ports[(i + 1) % count], &rooms[i]); }));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto hello = found[i].get();
      ASSERT_TRUE(hello) << count << " in a circle, the " << i << "th waits";
      const auto why = why_not_relayed(*hello, rooms[i].identity(), "bridge:7410");
      ASSERT_TRUE(why);
      EXPECT_THAT(*why, HasSubstr(count == 1 ? "is this server itself" : "a loop: bridge:7410"));
    }
  }
}

TEST(WaitingRoom, AServerThatWaitsItselfIsWaitedForAndSaysSo) {
  const auto ports = free_ports(2);
  WaitingRoom far(kHere, ports[0], hello_of_waiting("far"));
  std::optional<WaitingRoom> near(std::in_place, kHere, ports[1], hello_of_waiting("near"));
  std::vector<std::string> told;
  int pauses = 0;
  const auto hello = first_hello(
      {kHere, ports[0]}, Tries::until_it_is_there, [&](auto) { return ++pauses == 2; },
      [&](const std::string& why) { told.push_back(why); }, &*near);
  EXPECT_FALSE(hello);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], HasSubstr("it is a relay that waits for its own server"));
  // Who only tries has it at once, and sees who is behind.
  std::optional<wire::Hello> tried;
  for (int i = 0; i < 100 && (!tried || tried->relays().empty()); ++i) {
    tried = first_hello(
        {kHere, ports[1]}, Tries::one, [](auto) { return false; }, [](auto&) {});
    ASSERT_TRUE(tried);
  }
  ASSERT_EQ(tried->relays_size(), 1);
  EXPECT_EQ(tried->relays(0).identity(), "far");
  EXPECT_THAT(*why_not_relayed(*tried, "third", "bridge:7410"), HasSubstr("has no radars yet"));
  // Its port is free again.
  near.reset();
  WaitingRoom next(kHere, ports[1], hello_of_waiting("next"));
  EXPECT_TRUE(next.is_open());
}

TEST(WaitingRoom, WithoutAPortNobodyIsGreeted) {
  EXPECT_FALSE(WaitingRoom(kHere, 0, hello_of_waiting("a")).is_open());
  const auto ports = free_ports(1);
  WaitingRoom first(kHere, ports[0], hello_of_waiting("a"));
  WaitingRoom second(kHere, ports[0], hello_of_waiting("b"));
  EXPECT_TRUE(first.is_open());
  EXPECT_FALSE(second.is_open());
  second.set_before(nullptr);
}

// Guests that stay, and say what nobody reads.
TEST(WaitingRoom, HasRoomForSomeAndForATime) {
  const auto ports = free_ports(1);
  WaitingRoom room(kHere, ports[0], hello_of_waiting("a"));
  boost::asio::io_context io;
  const tcp::endpoint place(boost::asio::ip::make_address(kHere), ports[0]);
  std::deque<tcp::socket> guests;
  const auto bytes_for = [](tcp::socket& guest) {
    std::vector<char> bytes(4096);
    boost::system::error_code ended;
    return boost::asio::read(guest, boost::asio::buffer(bytes), ended);  // until its end
  };
  for (std::size_t i = 0; i < WaitingRoom::kMost; ++i) {
    guests.emplace_back(io).connect(place);
    boost::asio::write(guests.back(), boost::asio::buffer("GET / HTTP/1.1", 14));
    EXPECT_GT(bytes_for(guests.back()), 0u);
  }
  tcp::socket further(io);
  further.connect(place);
  EXPECT_EQ(bytes_for(further), 0u);
  std::size_t greeted = 0;
  for (int i = 0; i < 100 && greeted == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    tcp::socket later(io);
    later.connect(place);
    greeted = bytes_for(later);
  }
  EXPECT_GT(greeted, 0u);
}

}  // namespace
}  // namespace skerry::server
