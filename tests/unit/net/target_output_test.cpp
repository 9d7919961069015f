// Plots and tracks as datagrams of ASTERIX.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "protocol/asterix/cat010.hpp"
#include "protocol/asterix/cat048.hpp"
#include "protocol/asterix/cat062.hpp"
#include "tests/unit/net/display_socket.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/fake_plotters.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

class TargetOutputs : public testing::Test {
 protected:
  TargetOutputConfig to_receiver(TargetCategory category) const {
    return {.to = {.port = receiver.port()}, .category = category, .source = {25, 7}};
  }
  void serve(const TargetOutputConfig& output) {
    NetConfig config = test_config();
    config.target_outputs = {output};
    // A host's channels take the formats of one server.
    net.reset();
    host = std::make_unique<FakeHost>();
    host->plotters = &plotters;
    net.emplace(*host, config, std::span<const WebFile>());
    net->start();
  }
  void tell_target(std::uint32_t number) {
    plotters.change([&](wire::TargetList& list) {
      list.clear_targets();
      *list.add_targets() = FakePlotters::target(number, 1852.0);
    });
  }
  Bytes datagram() {
    auto received = receiver.receive();
    if (!received) throw std::runtime_error("no datagram came");
    return std::move(received->payload);
  }

  FakePlotters plotters;
  std::unique_ptr<FakeHost> host;
  DisplaySocket receiver{{0, 0}, ipv4(127, 0, 0, 1)};
  std::optional<NetServer> net;
};

TEST_F(TargetOutputs, SendEachListOnceAndKeepThePlotterRunning) {
  tell_target(7);
  serve(to_receiver(TargetCategory::cat048));
  const auto first = decode_cat048(datagram());
  ASSERT_TRUE(first.ok());
  ASSERT_EQ(first->size(), 1u);
  EXPECT_EQ(first->at(0).source, (AsterixSource{25, 7}));
  EXPECT_EQ(first->at(0).track_number, 7u);
  EXPECT_TRUE(plotters.is_wanted());

  wire::TargetPlots plots;
  plots.add_plots()->set_range_m(500.0);
  plotters.tell_plots(plots);
  const auto second = decode_cat048(datagram());
  ASSERT_TRUE(second.ok());
  ASSERT_EQ(second->size(), 1u) << "the list is the same";
  EXPECT_FALSE(second->at(0).track_number);

  tell_target(8);
  const auto third = decode_cat048(datagram());
  ASSERT_TRUE(third.ok());
  ASSERT_EQ(third->size(), 2u) << "8, and that 7 has ended; the plots are the same";
  EXPECT_EQ(third->at(0).track_number, 8u);
  EXPECT_TRUE(third->at(1).status->is_ended);

  const wire::Status status = net->status();
  ASSERT_EQ(status.outputs_size(), 1);
  EXPECT_EQ(status.outputs(0).name(), "cat048");
  EXPECT_EQ(status.outputs(0).address(), "127.0.0.1:" + std::to_string(receiver.port()));
  EXPECT_GE(status.outputs(0).reports(), 2u) << "the last may not be counted yet";
  net->stop();
  EXPECT_FALSE(plotters.is_wanted());
}

TEST_F(TargetOutputs, HaveTheCategoryThatIsAskedFor) {
  tell_target(7);
  serve(to_receiver(TargetCategory::cat062));
  const auto system = decode_cat062(datagram());
  ASSERT_TRUE(system.ok());
  EXPECT_EQ(system->at(0).track_number, 7);
  serve(to_receiver(TargetCategory::cat010));
  const auto shore = decode_cat010(datagram());
  ASSERT_TRUE(shore.ok());
  ASSERT_EQ(shore->size(), 3u);
  EXPECT_EQ(shore->at(2).track_number, 7u);
}

TEST_F(TargetOutputs, CutManyPlotsIntoDatagramsOfTheSizeThatIsAskedFor) {
  wire::TargetPlots plots;
  for (int i = 0; i < 100; ++i) plots.add_plots()->set_range_m(100.0 + i);
  plotters.tell_plots(plots);
  TargetOutputConfig output = to_receiver(TargetCategory::cat048);
  output.to.max_datagram = 256;
  serve(output);
  for (std::size_t got = 0; got < 100;) {
    const Bytes bytes = datagram();
    EXPECT_LE(bytes.size(), 256u);
    const auto reports = decode_cat048(bytes);
    ASSERT_TRUE(reports.ok());
    got += reports->size();
  }
}

TEST_F(TargetOutputs, AreRefusedWithTheReason) {
  const auto refusal = [&](const auto& change) -> std::string {
    TargetOutputConfig output = to_receiver(TargetCategory::cat062);
    change(output.to);
    try {
      serve(output);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal([](UdpDestination& to) { to.address = "plotter"; }),
              HasSubstr("cat062 datagrams of radar 0 to plotter port "));
  EXPECT_THAT(refusal([](UdpDestination& to) { to.address = "plotter"; }),
              HasSubstr("the address must be an IPv4 or IPv6 literal"));
  EXPECT_THAT(refusal([](UdpDestination& to) { to.port = 0; }),
              HasSubstr("the port must be 1 to 65535"));
  EXPECT_THAT(refusal([](UdpDestination& to) { to.radar = 1; }),
              HasSubstr("there is no such radar; there are 1"));
  EXPECT_THAT(refusal([](UdpDestination& to) { to.max_datagram = 255; }),
              HasSubstr("255 bytes is not 0 or 256 to 65507"));
}

}  // namespace
}  // namespace skerry::server
