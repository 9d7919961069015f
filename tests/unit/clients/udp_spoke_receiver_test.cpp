#include "clients/common/udp_spoke_receiver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "clients/common/asio.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/spoke_message.hpp"
#include "tests/unit/clients/long_wait.hpp"
#include "tests/unit/picture/synthetic_scan.hpp"

namespace skerry::client {
namespace {

using namespace std::chrono_literals;
using boost::asio::ip::udp;

// Sends to an address from a socket of its own.
class Sender {
 public:
  Sender(const std::string& address, std::uint16_t port)
      : target_(boost::asio::ip::make_address(address), port) {
    socket_.set_option(boost::asio::ip::multicast::hops(0));
    socket_.set_option(
        boost::asio::ip::multicast::outbound_interface(boost::asio::ip::address_v4::loopback()));
  }
  void send(std::span<const std::uint8_t> datagram) {
    socket_.send_to(boost::asio::buffer(datagram.data(), datagram.size()), target_);
  }
  void send(const Spoke& spoke, std::size_t max_datagram = kDefaultDatagram) {
    for (const Bytes& datagram : datagrams_of(spoke, max_datagram)) send(datagram);
  }
  static std::vector<Bytes> datagrams_of(const Spoke& spoke, std::size_t max_datagram) {
    Bytes frame, scratch;
    append_spoke_frame(frame, spoke);
    std::vector<Bytes> datagrams;
    for_each_datagram({.radar = static_cast<std::uint16_t>(spoke.header.radar),
                       .view = static_cast<std::uint16_t>(spoke.header.view),
                       .sequence = spoke.header.sequence},
                      frame_body(frame), max_datagram, scratch,
                      [&](std::span<const std::uint8_t> datagram) {
                        datagrams.emplace_back(datagram.begin(), datagram.end());
                      });
    return datagrams;
  }

 private:
  boost::asio::io_context io_;
  udp::socket socket_{io_, udp::v4()};
  udp::endpoint target_;
};

TEST(UdpSpokeReceiver, PutsSpokesTogetherAndCountsLosses) {
  auto receiver = UdpSpokeReceiver::open({.port = 0});
  ASSERT_TRUE(receiver) << receiver.error().text;
  Sender sender("127.0.0.1", receiver->port());
  for (const std::uint32_t index : {0u, 1u, 2u, 5u, 6u, 9u}) {
    sender.send(spoke_of(kSmall, 0, index), kMinDatagram);
    const auto spoke = receiver->receive(kLong);
    ASSERT_TRUE(spoke && *spoke);
    EXPECT_EQ((*spoke)->header.index, index);
  }
  const LossCounter& losses = receiver->losses().at({0, 0});
  EXPECT_EQ(losses.received(), 6u);
  EXPECT_EQ(losses.lost(), 4u);
}

TEST(UdpSpokeReceiver, PassesOverGarbageAndDuplicates) {
  auto receiver = UdpSpokeReceiver::open({.port = 0});
  ASSERT_TRUE(receiver);
  Sender sender("127.0.0.1", receiver->port());
  const Bytes garbage(300, 0xa5);
  auto pieces = Sender::datagrams_of(spoke_of(kSmall, 0, 0), kMinDatagram);
  ASSERT_GE(pieces.size(), 2u);
  sender.send(garbage);
  sender.send(Bytes{});
  sender.send(std::span(pieces[0]).first(10));
  std::reverse(pieces.begin(), pieces.end());
  for (const Bytes& piece : pieces) {
    sender.send(piece);
    sender.send(piece);
  }
  sender.send(spoke_of(kSmall, 0, 1));
  for (const std::uint32_t index : {0u, 1u}) {
    const auto spoke = receiver->receive(kLong);
    ASSERT_TRUE(spoke && *spoke);
    EXPECT_EQ((*spoke)->header.index, index);
  }
  const auto nothing = receiver->receive(0s);
  ASSERT_TRUE(nothing);
  EXPECT_FALSE(*nothing);
  EXPECT_EQ(receiver->refused(), 3u);
  EXPECT_EQ(receiver->losses().at({0, 0}).lost(), 0u);
}

TEST(UdpSpokeReceiver, RefusesABodyThatIsNoSpoke) {
  auto receiver = UdpSpokeReceiver::open({.port = 0});
  ASSERT_TRUE(receiver);
  Sender sender("127.0.0.1", receiver->port());
  wire::ServerMessage message;
  to_message(spoke_of(kSmall, 0, 0), *message.mutable_spoke());
  message.mutable_spoke()->set_range_scale(99);
  const std::string body = message.SerializeAsString();
  Bytes scratch;
  for_each_datagram({}, {reinterpret_cast<const std::uint8_t*>(body.data()), body.size()},
                    kDefaultDatagram, scratch,
                    [&](std::span<const std::uint8_t> datagram) { sender.send(datagram); });
  sender.send(spoke_of(kSmall, 0, 1));
  const auto spoke = receiver->receive(kLong);
  ASSERT_TRUE(spoke && *spoke);
  EXPECT_EQ((*spoke)->header.index, 1u);
  EXPECT_EQ(receiver->refused(), 1u);
}

TEST(UdpSpokeReceiver, CountsEachRadarByItself) {
  auto receiver = UdpSpokeReceiver::open({.port = 0});
  ASSERT_TRUE(receiver);
  Sender sender("127.0.0.1", receiver->port());
  for (const std::uint32_t radar : {0u, 3u}) {
    Spoke spoke = spoke_of(kSmall, radar, 10);  // far apart in sequence
    spoke.header.radar = radar;
    sender.send(spoke);
    ASSERT_TRUE(receiver->receive(kLong).value());
  }
  EXPECT_EQ(receiver->losses().size(), 2u);
  EXPECT_EQ(receiver->losses().at({3, 0}).lost(), 0u);
}

TEST(UdpSpokeReceiver, JoinsAMulticastGroupThatSeveralCanHear) {
  auto first = UdpSpokeReceiver::open({.address = "239.192.43.78", .port = 0});
  ASSERT_TRUE(first) << first.error().text;
  auto second = UdpSpokeReceiver::open({.address = "239.192.43.78", .port = first->port()});
  ASSERT_TRUE(second) << second.error().text;
  Sender sender("239.192.43.78", first->port());
  sender.send(spoke_of(kSmall, 0, 77));
  for (auto* receiver : {&*first, &*second}) {
    const auto spoke = receiver->receive(kLong);
    ASSERT_TRUE(spoke && *spoke);
    EXPECT_EQ((*spoke)->header.index, 77u);
  }
}

TEST(UdpSpokeReceiver, NamesThePortThatIsInUse) {
  const auto first = UdpSpokeReceiver::open({.port = 0});
  ASSERT_TRUE(first);
  const auto second = UdpSpokeReceiver::open({.port = first->port()});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, ClientErrorKind::unreachable);
  EXPECT_THAT(second.error().text,
              testing::HasSubstr("127.0.0.1:" + std::to_string(first->port())));
}

TEST(UdpAddress, IsReadFromText) {
  const auto parsed = [](const char* text) {
    const auto where = parse_udp_address(text, 7411);
    return where ? where->address + " " + std::to_string(where->port) : "error";
  };
  EXPECT_EQ(parsed("8600"), "127.0.0.1 8600");
  EXPECT_EQ(parsed("239.1.2.3:9000"), "239.1.2.3 9000");
  EXPECT_EQ(parsed("239.1.2.3:"), "239.1.2.3 7411");
  EXPECT_EQ(parsed("[ff02::1]:9000"), "ff02::1 9000");
  for (const char* wrong :
       {"", "x", "1.2.3:9", "1.2.3.4:x", "1.2.3.4:70000", "1.2.3.4:9z", "1.2.3.4", "host:9"}) {
    EXPECT_EQ(parsed(wrong), "error") << wrong;
  }
}

}  // namespace
}  // namespace skerry::client
