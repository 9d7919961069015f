// The parts of emulated radars' outputs: the gate for commands, the pace of datagrams, and
// which outputs can stand beside each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "server/net/common/output_socket.hpp"
#include "server/net/outputs/command_gate.hpp"
#include "server/net/outputs/datagram_pacer.hpp"
#include "server/net/outputs/output_conflicts.hpp"

namespace skerry::server {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::HasSubstr;

TEST(CommandGate, LetsABurstPassAtOnceAndThenSoManyASecond) {
  CommandGate gate;
  ScenarioTime now(std::chrono::seconds(5));
  int passed = 0;
  for (int i = 0; i < 1000; ++i) passed += gate.lets_pass(now) ? 1 : 0;
  EXPECT_EQ(passed, CommandGate::kBurst);
  // Ten seconds of a thousand a second.
  passed = 0;
  for (int i = 0; i < 10'000; ++i) passed += gate.lets_pass(now += milliseconds(1)) ? 1 : 0;
  EXPECT_EQ(passed, 10 * CommandGate::kPerSecond);
  // A second of silence earns a burst and no more.
  now += std::chrono::hours(1);
  passed = 0;
  for (int i = 0; i < 1000; ++i) passed += gate.lets_pass(now) ? 1 : 0;
  EXPECT_EQ(passed, CommandGate::kBurst);
}

TEST(CommandGate, DisplaysAtTheirOwnPaceAllPass) {
  CommandGate gate;
  ScenarioTime now{};
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(gate.lets_pass(now += milliseconds(20)));
}

// A radar of 4096 spokes at 24 rpm, whose sectors of 16 come up to 3 ms late; a datagram is
// complete with every 16.384th spoke (250 a turn).
TEST(DatagramPacer, DatagramsLeaveAtTheAntennasPaceHoweverLateTheirSectors) {
  const Duration spoke = Duration(std::chrono::nanoseconds(2'500'000'000 / 4096));
  const DatagramPacer::SteadyTime start(std::chrono::hours(7));
  DatagramPacer pacer;
  std::vector<DatagramPacer::SteadyTime> left;
  std::uint64_t next = 1;
  for (std::uint64_t sector = 0; sector < 1000; ++sector) {
    const std::uint64_t first = sector * 16;
    const auto late = microseconds((sector * 7919) % 3000);
    const auto arrival = start + spoke * static_cast<std::int64_t>(first + 16) + late;
    pacer.on_sector(arrival, ScenarioTime(spoke * static_cast<std::int64_t>(first)),
                    ScenarioTime(spoke * static_cast<std::int64_t>(first + 15)));
    for (; next * 16384 / 1000 < first + 16; ++next) {
      const auto at = ScenarioTime(spoke * static_cast<std::int64_t>(next * 16384 / 1000));
      left.push_back(pacer.leaves(at));
      EXPECT_GE(left.back(), arrival) << "not before it is there";
    }
  }
  ASSERT_GT(left.size(), 900u);
  // The first sectors find out how late is usual.
  for (std::size_t i = 20; i < left.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(Duration(left[i] - left[i - 1]).count()), 10e6,
                static_cast<double>(spoke.count()));
  }
}

TEST(DatagramPacer, BurstsLeaveTogether) {
  const DatagramPacer::SteadyTime arrival(std::chrono::seconds(100));
  DatagramPacer pacer(milliseconds(10));
  pacer.on_sector(arrival, ScenarioTime(milliseconds(0)), ScenarioTime(milliseconds(30)));
  EXPECT_EQ(pacer.leaves(ScenarioTime(milliseconds(1))),
            pacer.leaves(ScenarioTime(milliseconds(9))));
  EXPECT_EQ(
      pacer.leaves(ScenarioTime(milliseconds(12))) - pacer.leaves(ScenarioTime(milliseconds(9))),
      milliseconds(10));
}

TEST(DatagramPacer, NothingWaitsLongerThanASectorAndTheMargin) {
  DatagramPacer pacer;
  const Duration sector = milliseconds(10);
  DatagramPacer::SteadyTime arrival(std::chrono::seconds(100));
  ScenarioTime first{};
  const auto longest_wait = [&] {
    pacer.on_sector(arrival, first, first + sector);
    return pacer.leaves(first + sector) - arrival;
  };
  EXPECT_LE(longest_wait(), sector + DatagramPacer::kMargin);
  // The antenna's clock is set back, and on.
  for (const Duration step : {Duration(-std::chrono::hours(1)), Duration(std::chrono::hours(2))}) {
    arrival += sector;
    first += step;
    EXPECT_LE(longest_wait(), sector + DatagramPacer::kMargin);
    EXPECT_GE(pacer.leaves(first), arrival - sector) << "and none is lost in the past";
  }
}

TEST(TimedEncoder, TellsWhichSpokeCompletedEachDatagram) {
  // Datagrams of three spokes' numbers each.
  const SectorEncoder encoder = timed_encoder([held = Bytes()](const Sector& sector) mutable {
    auto out = std::make_shared<EncodedSector>();
    out->bytes = {0xEE};  // what is before `begin` is no datagram's
    out->begin = 1;
    for (const SpokePtr& spoke : sector.spokes) {
      held.push_back(static_cast<std::uint8_t>(spoke->header.index));
      if (held.size() < 3) continue;
      out->bytes.insert(out->bytes.end(), held.begin(), held.end());
      out->spoke_ends.push_back(static_cast<std::uint32_t>(out->bytes.size()));
      held.clear();
    }
    return EncodedSectorPtr(std::move(out));
  });
  Sector sector;
  for (std::uint32_t i = 0; i < 8; ++i) {
    Spoke spoke;
    spoke.header.index = i;
    spoke.header.scenario_time = ScenarioTime(milliseconds(i));
    sector.spokes.push_back(std::make_shared<const Spoke>(std::move(spoke)));
  }
  const EncodedSectorPtr made = encoder(sector);
  EXPECT_EQ(made->bytes, (Bytes{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(made->spoke_ends, (std::vector<std::uint32_t>{3, 6}));
  EXPECT_EQ(made->times.completed, (std::vector<ScenarioTime>{ScenarioTime(milliseconds(2)),
                                                              ScenarioTime(milliseconds(5))}));
  EXPECT_EQ(made->times.first, ScenarioTime(milliseconds(0)));
  EXPECT_EQ(made->times.last, ScenarioTime(milliseconds(7)));
}

constexpr Ipv4Endpoint kData{ipv4(236, 6, 7, 8), 6678}, kCommands{ipv4(236, 6, 7, 10), 6680},
    kLocator{ipv4(236, 6, 7, 5), 6878};

OutputClaim claim(const std::string& name, const std::string& address, unsigned interface) {
  return {name, address, interface, {"Navico BR24", {kData, kCommands}}, {kLocator, kCommands}};
}

TEST(OutputConflicts, RadarsOfAFixedFamilyNeedAddressesAndInterfacesOfTheirOwn) {
  const auto among = [](const OutputClaim& a, const OutputClaim& b) {
    return conflict_among(std::vector<OutputClaim>{a, b}).value_or("none");
  };
  const OutputClaim first = claim("one", "192.0.2.7", 2);
  EXPECT_THAT(among(first, claim("two", "192.0.2.7", 2)),
              HasSubstr("one and two would both be a Navico BR24 at 236.6.7.8:6678 on 192.0.2.7"));
  EXPECT_THAT(among(first, claim("two", "192.0.2.8", 2)),
              HasSubstr("192.0.2.7 and 192.0.2.8 are addresses of one interface"));
  EXPECT_EQ(among(first, claim("two", "198.51.100.7", 3)), "none");
  EXPECT_EQ(among(claim("one", "127.0.0.1", 0), claim("two", "127.0.0.2", 0)), "none");

  OutputClaim halo = claim("halo", "192.0.2.7", 2);
  halo.identity = {"Navico HALO", {{ipv4(236, 6, 8, 8), 6678}}};
  EXPECT_EQ(among(first, halo), "none") << "all Navico radars share the locator's group";

  // Displays command these by unicast, so that one interface will do for two.
  OutputClaim garmin = first, other = claim("other", "192.0.2.8", 2);
  garmin.groups = other.groups = {};
  EXPECT_EQ(among(garmin, other), "none");
}

TEST(OutputSockets, LoopbackIsNoInterfaceToTellApartAndStrangeAddressesHaveNone) {
  EXPECT_EQ(interface_of(asio::ip::make_address_v4("127.0.0.1")), 0u);
  EXPECT_EQ(interface_of(asio::ip::make_address_v4("203.0.113.9")), 0u);
}

}  // namespace
}  // namespace skerry::server
