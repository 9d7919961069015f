// The bookkeeping of what a peer may have, without sockets; time is passed in.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "protocol/wire/host_and_port.hpp"
#include "server/net/common/connection_table.hpp"
#include "server/net/common/for_strangers.hpp"
#include "server/net/common/log_pace.hpp"
#include "server/net/common/peer_budgets.hpp"

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TcpPeer at(const std::string& address) {
  return peer_at({asio::ip::make_address(address), 50'000}, {});
}
PeerNet net(const std::string& address) { return PeerNet(asio::ip::make_address(address)); }

TEST(PeerNet, AnIpv4AddressIsOnePeerByWhateverSocketItComes) {
  EXPECT_EQ(net("192.0.2.7"), net("::ffff:192.0.2.7"));
  EXPECT_NE(net("192.0.2.7"), net("192.0.2.8"));
  EXPECT_EQ(net("192.0.2.7").text(), "192.0.2.7");
  EXPECT_EQ(net("::ffff:192.0.2.7").text(), "192.0.2.7");
}

TEST(PeerNet, AnIpv6NetworkOf64BitsIsOnePeer) {
  EXPECT_EQ(net("2001:db8:1:2::7"), net("2001:db8:1:2:ffff::1"));
  EXPECT_NE(net("2001:db8:1:2::7"), net("2001:db8:1:3::7"));
  EXPECT_EQ(net("2001:db8:1:2::7").text(), "2001:db8:1:2::/64");
  EXPECT_NE(net("fe80::1"), net("fe80::2")) << "all hosts of a link are in one network";
  EXPECT_EQ(net("fe80::1").text(), "fe80::1");
}

TEST(PeerNet, AllOfLoopbackIsTheOwnHostButWhatIsSaidToBeForeign) {
  for (const char* address : {"127.0.0.1", "127.8.9.10", "::1", "::ffff:127.0.0.1"}) {
    EXPECT_TRUE(at(address).on_own_host) << address;
    EXPECT_EQ(at(address).net, PeerNet::own_host()) << address;
  }
  const std::vector<std::string> foreign{"127.0.0.2"};
  const TcpPeer stranger = peer_at({asio::ip::make_address("127.0.0.2"), 1}, foreign);
  EXPECT_FALSE(stranger.on_own_host);
  EXPECT_EQ(stranger.net, net("127.0.0.2"));
  EXPECT_FALSE(at("192.0.2.7").on_own_host);
}

TEST(HostAndPort, AnIpv6AddressStandsInBrackets) {
  EXPECT_EQ(host_and_port("192.0.2.7", 7410), "192.0.2.7:7410");
  EXPECT_EQ(host_and_port("2001:db8::7", 7410), "[2001:db8::7]:7410");
  EXPECT_EQ(host_and_port("[::1]", 7480), "[::1]:7480");
  EXPECT_EQ(host_and_port("ship.local", 80), "ship.local:80");
  EXPECT_EQ(at("2001:db8::7").text, "[2001:db8::7]:50000");
}

std::vector<ConnectionSlotPtr> enter(ConnectionTable& table, const TcpPeer& peer, std::size_t n) {
  std::vector<ConnectionSlotPtr> slots;
  for (std::size_t i = 0; i < n; ++i) slots.push_back(table.try_enter(peer));
  return slots;
}
std::size_t count(const std::vector<ConnectionSlotPtr>& slots, Place place) {
  std::size_t n = 0;
  for (const auto& slot : slots) n += slot != nullptr && slot->place() == place;
  return n;
}

TEST(ConnectionTable, OneStrangerHasAShareAndTheOperatorAlwaysGetsIn) {
  ConnectionTable table(256, {});
  const auto flood = enter(table, at("192.0.2.7"), 255);
  EXPECT_EQ(count(flood, Place::stranger), 64u);
  EXPECT_EQ(count(flood, Place::on_trial), PeerLimits{}.trials_of_peer);
  EXPECT_EQ(count(flood, Place::refused), PeerLimits{}.refusals_of_peer);
  EXPECT_EQ(flood.back(), nullptr);
  const std::string why = table.refusal(at("192.0.2.7"));
  EXPECT_NE(why.find("192.0.2.7 has 64 connections"), std::string::npos) << why;
  EXPECT_EQ(table.try_enter(at("192.0.2.8"))->place(), Place::stranger);
  EXPECT_EQ(table.try_enter(at("127.0.0.1"))->place(), Place::own_host);
}

TEST(ConnectionTable, ManyStrangersTogetherLeaveTheReserve) {
  ConnectionTable table(256, {});
  std::vector<std::vector<ConnectionSlotPtr>> floods;
  std::size_t strangers = 0, trials = 0;
  for (int host = 1; host <= 20; ++host) {
    floods.push_back(enter(table, at("192.0.2." + std::to_string(host)), 100));
    strangers += count(floods.back(), Place::stranger);
    trials += count(floods.back(), Place::on_trial);
  }
  EXPECT_EQ(strangers, table.strangers_most());
  EXPECT_EQ(trials, table.trials_most());
  EXPECT_EQ(table.counts().refused, PeerLimits{}.refusals);
  const std::size_t left = 256 - strangers - trials;
  EXPECT_GE(left, 20u);
  const auto own = enter(table, at("127.0.0.1"), left);
  EXPECT_EQ(count(own, Place::own_host), left);
  EXPECT_NE(table.refusal(at("127.0.0.1")).find("all 256"), std::string::npos);
}

TEST(ConnectionTable, WhoShowsTheTokenCountsNoLongerAsAStranger) {
  ConnectionTable table(256, {});
  auto slots = enter(table, at("192.0.2.7"), 65);
  ASSERT_EQ(slots.back()->place(), Place::on_trial);
  EXPECT_FALSE(slots.back()->is_trusted());
  slots.back()->trust();
  EXPECT_EQ(slots.back()->place(), Place::trusted);
  EXPECT_TRUE(slots.back()->is_trusted());
  EXPECT_EQ(table.counts().on_trial, 0u);
  slots.front()->trust();
  EXPECT_EQ(table.try_enter(at("192.0.2.7"))->place(), Place::stranger) << "a place is free again";
  EXPECT_EQ(table.counts().trusted, 2u);
}

TEST(ConnectionTable, TheOwnHostMayHaveEveryPlace) {
  ConnectionTable table(256, {});
  const auto own = enter(table, at("127.0.0.1"), 257);
  EXPECT_EQ(count(own, Place::own_host), 256u);
  EXPECT_EQ(own.back()->place(), Place::refused);
  EXPECT_EQ(table.try_enter(at("192.0.2.7"))->place(), Place::refused);
}

TEST(ConnectionTable, EvenASmallTableKeepsAPlaceForTheOwnHost) {
  for (std::size_t limit = 1; limit <= 16; ++limit) {
    ConnectionTable table(limit, {});
    std::vector<std::vector<ConnectionSlotPtr>> floods;
    for (int host = 1; host <= 20; ++host) {
      floods.push_back(enter(table, at("192.0.2." + std::to_string(host)), 2));
    }
    const auto own = table.try_enter(at("::1"));
    ASSERT_NE(own, nullptr) << limit;
    EXPECT_EQ(own->place(), limit == 1 ? Place::refused : Place::own_host) << limit;
  }
}

TEST(ConnectionTable, NothingIsKeptOfPeersThatHaveLeft) {
  ConnectionTable table(256, {});
  for (int host = 0; host < 10'000; ++host) {
    const auto address = asio::ip::make_address_v4(0x0A000000u + static_cast<unsigned>(host));
    const auto slot = table.try_enter(peer_at({address, 1}, {}));
    ASSERT_EQ(slot->place(), Place::stranger);
    ASSERT_EQ(table.peers(), 1u);
  }
  EXPECT_EQ(table.peers(), 0u);
  EXPECT_EQ(table.counts().served(), 0u);
}

constexpr PeerBudgets::Time kStart{};

// So many of `n` asked for evenly over `time` that pass.
std::size_t passed(PeerBudgets& budgets, const TcpPeer& peer, std::size_t n, milliseconds time,
                   PeerBudgets::Time from = kStart) {
  std::size_t taken = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto now =
        from + std::chrono::nanoseconds(time) * static_cast<long>(i) / static_cast<long>(n);
    taken += budgets.take(peer, now);
  }
  return taken;
}

TEST(PeerBudgets, AFloodPassesABurstAndThenTheRate) {
  PeerBudgets budgets = PeerBudgets::of_changes({});
  EXPECT_NEAR(static_cast<double>(passed(budgets, at("192.0.2.7"), 71'000, seconds(1))),
              2'000 + 1'000, 2);
  const std::string why = budgets.refusal(at("192.0.2.7"));
  EXPECT_NE(why.find("1000 a second"), std::string::npos) << why;
}

TEST(PeerBudgets, AClassBehindOneAddressDragsItsSlidersAllAtOnce) {
  PeerBudgets budgets = PeerBudgets::of_changes({});
  constexpr std::size_t kHands = 16, kPerSecond = 60, kSeconds = 30;
  EXPECT_EQ(passed(budgets, at("192.0.2.7"), kHands * kPerSecond * kSeconds, seconds(kSeconds)),
            kHands * kPerSecond * kSeconds);
}

TEST(PeerBudgets, TheOwnHostHasFarMoreButNotAll) {
  PeerBudgets budgets = PeerBudgets::of_changes({});
  EXPECT_EQ(passed(budgets, at("127.0.0.1"), 20'000, seconds(1)), 20'000u);
  EXPECT_LT(passed(budgets, at("127.0.0.1"), 71'000 * 3, seconds(3), kStart + seconds(1)),
            40'000u + 3 * 20'000u + 10);
}

TEST(PeerBudgets, OnePeersFloodTakesNothingFromAnother) {
  PeerBudgets budgets = PeerBudgets::of_changes({});
  passed(budgets, at("192.0.2.7"), 10'000, milliseconds(1));
  EXPECT_FALSE(budgets.take(at("192.0.2.7"), kStart + milliseconds(1)));
  EXPECT_TRUE(budgets.take(at("192.0.2.8"), kStart + milliseconds(1)));
  EXPECT_TRUE(budgets.take(at("127.0.0.1"), kStart + milliseconds(1)));
  EXPECT_TRUE(budgets.take(at("192.0.2.7"), kStart + milliseconds(10))) << "it fills again";
}

TEST(PeerBudgets, MemoryIsBoundedHoweverManyPeersCome) {
  PeerLimits limits;
  limits.most_budgets = 100;
  PeerBudgets budgets = PeerBudgets::of_changes(limits);
  for (unsigned host = 0; host < 10'000; ++host) {
    const auto address = asio::ip::make_address_v4(0x0A000000u + host);
    EXPECT_TRUE(budgets.take(peer_at({address, 1}, {}), kStart + std::chrono::microseconds(host)));
    ASSERT_LE(budgets.size(), 100u);
  }
  budgets.take(at("192.0.2.7"), kStart + seconds(10));
  EXPECT_EQ(budgets.size(), 1u) << "those that are full again are forgotten";
}

TEST(PeerBudgets, AClassSignsInAtOnceAndAGuesserIsSlow) {
  PeerBudgets budgets = PeerBudgets::of_sign_ins({});
  for (const char* from : {"192.0.2.7", "127.0.0.1"}) {
    EXPECT_EQ(passed(budgets, at(from), 40, milliseconds(1)), 40u) << from;
    EXPECT_NEAR(static_cast<double>(passed(budgets, at(from), 60'000, seconds(600))), 200, 2);
  }
  const std::string why = budgets.refusal(at("192.0.2.7"));
  EXPECT_NE(why.find("too many sign-ins from 192.0.2.7"), std::string::npos) << why;
}

TEST(LogPace, TellsTheFirstAndThenOneAPeriodWithTheNumberInBetween) {
  LogPace pace(seconds(60));
  const LogPace::Time start{};
  const auto first = pace.tell("a", start);
  EXPECT_TRUE(first.now && first.is_first);
  for (int i = 1; i < 60; ++i) EXPECT_FALSE(pace.tell("a", start + seconds(i)).now);
  EXPECT_TRUE(pace.tell("b", start + seconds(1)).is_first);
  const auto next = pace.tell("a", start + seconds(60));
  EXPECT_TRUE(next.now && !next.is_first);
  EXPECT_EQ(next.untold, 59u);
  EXPECT_EQ(pace.tell("a", start + seconds(200)).untold, 0u);
}

TEST(ForStrangers, FoldersAndAddressesAreLeftOutAndTheNumbersStay) {
  wire::Status status;
  status.set_uptime_s(7);
  wire::ClientStatus& client = *status.add_clients();
  client.set_transport("tcp");
  client.set_peer("192.0.2.7:50000");
  client.set_spokes_sent(5);
  wire::OutputStatus& output = *status.add_outputs();
  output.set_name("navico_4g");
  output.set_address("192.0.2.8:6002");
  output.set_interface_address("192.0.2.1");
  output.set_last_display("192.0.2.9:6002");
  status.mutable_recorder()->set_folder("/recordings/secret");
  status.mutable_recorder()->set_file("watch.mcap");
  status.mutable_recorder()->set_problem("/recordings/secret/watch.mcap: cannot be written");
  status.mutable_playback()->set_last_by("console 192.0.2.7:50000");
  status.mutable_playback()->set_problem("behind: reaches 83x of 100x");
  leave_out_for_strangers(status);
  const std::string all = status.DebugString();
  EXPECT_EQ(all.find("192.0.2"), std::string::npos) << all;
  EXPECT_EQ(all.find("operator"), std::string::npos) << all;
  EXPECT_EQ(status.uptime_s(), 7);
  EXPECT_EQ(status.clients(0).spokes_sent(), 5u);
  EXPECT_EQ(status.outputs(0).name(), "navico_4g");
  EXPECT_EQ(status.recorder().file(), "watch.mcap");
  EXPECT_FALSE(status.recorder().problem().empty()) << "that there is one stays known";
  EXPECT_EQ(status.playback().problem(), "behind: reaches 83x of 100x");
}

}  // namespace
}  // namespace skerry::server
