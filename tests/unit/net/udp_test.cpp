// Datagrams as a display receives them.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include "protocol/asterix/cat240.hpp"
#include "protocol/wire/datagram.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/net/common/encoders.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

class UdpReceiver {
 public:
  explicit UdpReceiver(const char* group = nullptr) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    const int buffer = 4 * 1024 * 1024;
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
    const timeval patience{30, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = group == nullptr ? htonl(INADDR_LOOPBACK) : ::inet_addr(group);
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("cannot bind a UDP socket");
    }
    socklen_t size = sizeof address;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    if (group == nullptr) return;
    ip_mreq membership{};
    membership.imr_multiaddr.s_addr = ::inet_addr(group);
    membership.imr_interface.s_addr = htonl(INADDR_LOOPBACK);
    if (::setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0) {
      throw std::runtime_error("cannot join the group");
    }
  }
  ~UdpReceiver() { ::close(socket_); }
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  std::uint16_t port() const { return port_; }
  Bytes receive() {
    Bytes bytes(65536);
    const auto size = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (size < 0) throw std::runtime_error("no datagram came");
    bytes.resize(static_cast<std::size_t>(size));
    return bytes;
  }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

// The next spoke, from as many datagrams as it takes.
Spoke receive_spoke(UdpReceiver& receiver, DatagramReassembler& reassembler, std::size_t largest) {
  while (true) {
    const Bytes datagram = receiver.receive();
    EXPECT_LE(datagram.size(), largest);
    const auto body = reassembler.feed(datagram);
    if (!body.ok()) throw std::runtime_error(body.error().text);
    if (!body->has_value()) continue;
    wire::ServerMessage message;
    if (!message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size()))) {
      throw std::runtime_error("no ServerMessage in a datagram");
    }
    const auto spoke = from_message(message.spoke());
    if (!spoke.ok()) throw std::runtime_error(spoke.error().text);
    return *spoke;
  }
}

StreamOutputConfig native_to(const UdpDestination& to) {
  return {.to = to, .shape = NativeShape{}};
}

// Senders begin on the server's thread, before anything that a client asks there later.
void wait_for_senders(NetServer& server) { TestClient(server.tcp_port()).get_status(); }

class UdpSpokes : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(LargestDatagram, UdpSpokes, testing::Values(256u, 600u, 1472u, 0u),
                         testing::PrintToStringParamName());

TEST_P(UdpSpokes, ComeWholeInOrderWithTheirCells) {
  FakeHost host(2);
  UdpReceiver receiver;
  NetConfig config = test_config();
  config.streams = {native_to({.radar = 1, .port = receiver.port(), .max_datagram = GetParam()})};
  NetServer server(host, config, {});
  server.start();
  wait_for_senders(server);
  DatagramReassembler reassembler;
  for (std::uint64_t sequence = 0; sequence < 20 * FakeHost::kSectorSpokes; ++sequence) {
    if (sequence % FakeHost::kSectorSpokes == 0) {
      host.publish(0);
      host.publish(1);
    }
    const Spoke spoke =
        receive_spoke(receiver, reassembler, GetParam() == 0 ? kMaxDatagram : GetParam());
    const Spoke expected = host.spoke(1, sequence);
    ASSERT_EQ(spoke.header.radar, 1u);
    ASSERT_EQ(spoke.header.sequence, sequence);
    ASSERT_EQ(spoke.cells, expected.cells);
  }
  EXPECT_EQ(host.encoded(kNativeFormat, 1), host.published(1));
  EXPECT_EQ(host.encoded(kNativeFormat, 0), 0u) << "radar 0 has no receiver";
  ASSERT_TRUE(
      wait_until([&] { return server.status().clients(0).spokes_sent() == host.published(1); }));
  const wire::ClientStatus client = server.status().clients(0);
  EXPECT_EQ(client.transport(), "udp");
  EXPECT_EQ(client.peer(), "127.0.0.1:" + std::to_string(receiver.port()));
  EXPECT_EQ(client.radar(), 1u);
  EXPECT_EQ(client.spokes_lost(), 0u);
}

TEST(Udp, MulticastStaysOnThisHostUnlessConfiguredOtherwise) {
  FakeHost host;
  UdpReceiver receiver("239.255.74.10");
  NetConfig config = test_config();
  config.streams = {native_to(
      {.address = "239.255.74.10", .port = receiver.port(), .interface_address = "127.0.0.1"})};
  NetServer server(host, config, {});
  server.start();
  wait_for_senders(server);
  host.publish();
  DatagramReassembler reassembler;
  EXPECT_EQ(receive_spoke(receiver, reassembler, kDefaultDatagram).cells, host.spoke(0, 0).cells);
  EXPECT_EQ(UdpDestination().multicast_ttl, 0);
}

// Sending to the broadcast address without permission fails for every datagram, at once.
TEST(Udp, WhatCannotBeSentIsCountedAndNobodyWaits) {
  FakeHost host;
  UdpReceiver receiver;
  NetConfig config = test_config();
  config.streams = {native_to({.address = "255.255.255.255", .port = 9, .max_datagram = 256}),
                    native_to({.port = receiver.port()})};
  NetServer server(host, config, {});
  server.start();
  wait_for_senders(server);
  host.publish();
  DatagramReassembler reassembler;
  for (std::uint64_t i = 0; i < FakeHost::kSectorSpokes; ++i) {
    EXPECT_EQ(receive_spoke(receiver, reassembler, kMaxDatagram).header.sequence, i);
  }
  ASSERT_TRUE(wait_until(
      [&] { return server.status().clients(0).spokes_lost() == FakeHost::kSectorSpokes; }));
  EXPECT_EQ(server.status().clients(0).spokes_sent(), 0u);
  EXPECT_GE(server.status().errors().at("udp send"), FakeHost::kSectorSpokes);
}

TEST(Udp, WrongDestinationsAreNamed) {
  const auto refused = [&](const UdpDestination& to, const std::string& part) {
    NetConfig config = test_config();
    config.streams = {native_to(to)};
    FakeHost host;
    try {
      NetServer(host, config, {});
      ADD_FAILURE() << "accepted: " << part;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused({.radar = 1, .port = 9}, "no such radar");
  refused({.address = "radar.example", .port = 9}, "literal");
  refused({.port = 0}, "port must be");
  refused({.port = 9, .max_datagram = 100}, "256 to 65507");
  refused({.port = 9, .max_datagram = 70000}, "256 to 65507");
  refused({.address = "239.0.0.1", .port = 9, .multicast_ttl = 256}, "0 to 255");
  refused({.address = "239.0.0.1", .port = 9, .interface_address = "eth0"}, "interface");
  refused({.address = "239.0.0.1", .port = 9, .interface_address = "203.0.113.1"}, "interface");
}

TEST(Cat240, EachTurnBeginsWithASummaryAndHasAllItsSpokes) {
  constexpr int kTurns = 3;
  constexpr int kSectors = kTurns * FakeHost::kSpokesPerTurn / FakeHost::kSectorSpokes;
  FakeHost host(2);
  UdpReceiver receiver, second;
  NetConfig config = test_config();
  Cat240StreamShape shape;
  shape.options.source = {.sac = 25, .sic = 11};
  // Two receivers: encoded once.
  config.streams = {{.to = {.radar = 1, .port = receiver.port()}, .shape = shape},
                    {.to = {.radar = 1, .port = second.port()}, .shape = shape}};
  NetServer server(host, config, {});
  server.start();
  wait_for_senders(server);
  std::uint32_t videos = 0;
  int summaries = 0;
  for (int sector = 0; sector < kSectors; ++sector) {
    host.publish(1);
    const bool turn_begins = videos % FakeHost::kSpokesPerTurn == 0;
    const std::uint32_t wanted = FakeHost::kSectorSpokes + (turn_begins ? 1 : 0);
    for (std::uint32_t i = 0; i < wanted; ++i) {
      const Bytes datagram = receiver.receive();
      EXPECT_EQ(second.receive(), datagram);
      const auto records = decode_cat240(datagram);
      ASSERT_TRUE(records.ok()) << records.error().text;
      ASSERT_EQ(records->size(), 1u) << "one record in a datagram";
      const Cat240Record& record = records->front();
      EXPECT_EQ(record.source, (Cat240Source{.sac = 25, .sic = 11}));
      if (turn_begins && i == 0) {
        ASSERT_TRUE(record.summary);
        EXPECT_NE(record.summary->find("radar 1"), std::string::npos) << *record.summary;
        ++summaries;
        continue;
      }
      ASSERT_TRUE(record.video);
      EXPECT_EQ(record.video->message_index, videos);
      EXPECT_EQ(record.video->cells, host.spoke(1, videos).cells);
      ++videos;
    }
  }
  EXPECT_EQ(summaries, kTurns);
  EXPECT_EQ(videos, kTurns * FakeHost::kSpokesPerTurn);
  EXPECT_EQ(host.encoded("stream 1 (cat240)", 1), host.published(1));
}

}  // namespace
}  // namespace skerry::server
