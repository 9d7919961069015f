// Streams of datagrams in shapes of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "protocol/asterix/cat240.hpp"
#include "protocol/wire/datagram.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "tests/unit/net/display_socket.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint32_t kLoopback = ipv4(127, 0, 0, 1);

StreamOutputConfig stream_to(const DisplaySocket& receiver,
                             decltype(StreamOutputConfig::shape) shape) {
  StreamOutputConfig stream;
  stream.to.port = receiver.port();
  stream.shape = std::move(shape);
  return stream;
}

struct StreamServer {
  StreamServer(FakeHost& host, const StreamOutputConfig& stream) : net(host, with(stream), {}) {
    net.start();
    TestClient(net.tcp_port()).get_status();  // answered when senders have begun
  }
  static NetConfig with(const StreamOutputConfig& stream) {
    NetConfig config = test_config();
    config.streams = {stream};
    return config;
  }
  NetServer net;
};

Bytes datagram(DisplaySocket& receiver) {
  auto received = receiver.receive();
  if (!received) throw std::runtime_error("no datagram came");
  return std::move(received->payload);
}

// The strongest of the spokes [spoke, spoke + spokes) and cells [cell, cell + cells).
std::uint8_t strongest(const FakeHost& host, std::uint64_t spoke, std::uint32_t spokes,
                       std::uint32_t cell, std::uint32_t cells) {
  std::uint8_t most = 0;
  for (std::uint64_t s = spoke; s < spoke + spokes; ++s) {
    const Spoke source = host.spoke(0, s);
    for (std::uint32_t c = cell; c < cell + cells; ++c) most = std::max(most, source.cells[c]);
  }
  return most;
}

TEST(StreamOutputs, NativeSpokesAreResampledByTheirPeaksAndCountedAnew) {
  FakeHost host;
  DisplaySocket receiver({0, 0}, kLoopback);
  const StreamServer server(host, stream_to(receiver, NativeShape{.cells = 512, .bits = 4}));
  host.publish();
  host.publish();
  DatagramReassembler reassembler;
  for (std::uint64_t sequence = 0; sequence < 2 * FakeHost::kSectorSpokes; ++sequence) {
    const auto body = reassembler.feed(datagram(receiver));
    ASSERT_TRUE(body.ok() && body->has_value());
    wire::ServerMessage message;
    ASSERT_TRUE(message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size())));
    const auto spoke = from_message(message.spoke());
    ASSERT_TRUE(spoke.ok()) << spoke.error().text;
    EXPECT_EQ(spoke->header.sequence, sequence);
    EXPECT_EQ(spoke->header.geometry, (ScanGeometry{FakeHost::kSpokesPerTurn, 512, 4}));
    for (std::uint32_t c = 0; c < 512; ++c) {
      ASSERT_EQ(spoke->cells[c], strongest(host, sequence, 1, 2 * c, 2) >> 4);
    }
  }
}

TEST(StreamOutputs, Cat240HasItsOwnSpokesCellsAndRecords) {
  FakeHost host;
  DisplaySocket receiver({0, 0}, kLoopback);
  Cat240StreamShape shape;
  shape.options.source = {9, 3};
  shape.options.compressed = true;
  shape.turn_spokes = FakeHost::kSpokesPerTurn / 4;
  shape.cells = 256;
  shape.records = 2;
  shape.summaries = false;
  const StreamServer server(host, stream_to(receiver, shape));
  host.publish();
  std::uint64_t spoke = 0;
  for (int block = 0; block < 2; ++block) {
    const auto records = decode_cat240(datagram(receiver));
    ASSERT_TRUE(records.ok()) << records.error().text;
    ASSERT_EQ(records->size(), 2u);
    for (const Cat240Record& record : *records) {
      EXPECT_EQ(record.source, (Cat240Source{9, 3}));
      ASSERT_TRUE(record.video && record.video->compressed);
      ASSERT_EQ(record.video->cells.size(), 256u);
      for (std::uint32_t c = 0; c < 256; ++c) {
        ASSERT_EQ(record.video->cells[c], strongest(host, spoke, 4, 4 * c, 4));
      }
      spoke += 4;
    }
  }
}

TEST(StreamOutputs, OneWithAViewOfItsOwnIsToldApartInTheStatus) {
  FakeHost host;
  DisplaySocket receiver({0, 0}, kLoopback);
  StreamOutputConfig stream = stream_to(receiver, NativeShape{});
  stream.own_view = true;
  const StreamServer server(host, stream);
  EXPECT_EQ(host.view_count(0), 2u);
  host.publish();
  DatagramReassembler reassembler;
  const auto body = reassembler.feed(datagram(receiver));
  ASSERT_TRUE(body.ok() && body->has_value());
  wire::ServerMessage message;
  ASSERT_TRUE(message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size())));
  EXPECT_EQ(message.spoke().view(), 1u);
  EXPECT_EQ(server.net.status().clients(0).view(), 1u);
}

TEST(StreamOutputs, ShapesThatAProtocolDoesNotHaveAreRefused) {
  const auto refusal = [](const StreamOutputConfig& stream) -> std::string {
    FakeHost host;
    try {
      const StreamServer server(host, stream);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  DisplaySocket receiver({0, 0}, kLoopback);
  EXPECT_THAT(refusal(stream_to(receiver, NativeShape{.turn_spokes = 100})),
              AllOf(HasSubstr("udp datagrams of radar 0 to 127.0.0.1 port "),
                    HasSubstr(": spokes 100 is not 0 (as the radar has them) or 128")));
  EXPECT_THAT(refusal(stream_to(receiver, NativeShape{.bits = 16})),
              HasSubstr("16 bits are not 4 or 8"));
  Cat240StreamShape shape;
  shape.records = 65;
  EXPECT_THAT(refusal(stream_to(receiver, shape)), HasSubstr("65 records to a datagram"));
  StreamOutputConfig stream = stream_to(receiver, NativeShape{});
  stream.to.radar = 1;
  EXPECT_THAT(refusal(stream), HasSubstr("there is no such radar; there are 1"));
}

}  // namespace
}  // namespace skerry::server
