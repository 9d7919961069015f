// The same scenario and seed give the same picture, bit for bit, in every run of the server and for
// any number of workers.
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "clients/common/udp_spoke_receiver.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using Turn = std::map<std::uint32_t, Spoke>;  // by index

// The first turn of radar 0.  Datagrams, because these go out from the first sector on; a console
// would have to connect first.
Turn first_turn(const std::string& scenario, const std::string& workers) {
  auto receiver = client::UdpSpokeReceiver::open({client::kDefaultHost, 0});
  if (!receiver) throw std::runtime_error(receiver.error().text);
  const RunningServer server({"--scenario", scenario, "--workers", workers, "--udp",
                              "127.0.0.1:" + std::to_string(receiver->port())});
  Turn turn;
  for (;;) {
    auto spoke = receiver->receive(kAnswerTime);
    if (!spoke) throw std::runtime_error(spoke.error().text);
    if (!*spoke) throw std::runtime_error("no datagrams");
    if ((*spoke)->header.scan > 0) return turn;
    turn.emplace((*spoke)->header.index, std::move(**spoke));
  }
}

// How many spokes of two turns are of the same index, and how many of these differ.
struct Comparison {
  std::size_t common = 0;
  std::size_t different = 0;
};

Comparison compare(const Turn& a, const Turn& b) {
  Comparison result;
  for (const auto& [index, spoke] : a) {
    const auto other = b.find(index);
    if (other == b.end()) continue;
    ++result.common;
    const SpokeHeader &x = spoke.header, &y = other->second.header;
    const bool same = spoke.cells == other->second.cells && x.scenario_time == y.scenario_time &&
                      x.heading == y.heading &&
                      x.own_ship.latitude_deg == y.own_ship.latitude_deg &&
                      x.own_ship.longitude_deg == y.own_ship.longitude_deg;
    if (!same) ++result.different;
  }
  return result;
}

TEST(Determinism, EveryRunShowsTheSameFirstTurnForAnyNumberOfWorkers) {
  const TempFolder folder;
  const std::string scenario = folder.write("small.yaml", small_scenario());
  const Turn first = first_turn(scenario, "0");
  for (const char* workers : {"0", "3", "3"}) {
    const Comparison same = compare(first, first_turn(scenario, workers));
    // A busy machine may leave a sector out; what is there must not differ.
    EXPECT_GE(same.common, kSmallSpokes * 9 / 10) << workers << " workers";
    EXPECT_EQ(same.different, 0u) << workers << " workers";
  }
}

TEST(Determinism, AnotherSeedIsAnotherPicture) {
  const TempFolder folder;
  const Turn one = first_turn(folder.write("one.yaml", small_scenario(1)), "0");
  const Turn two = first_turn(folder.write("two.yaml", small_scenario(2)), "0");
  const Comparison other = compare(one, two);
  EXPECT_GE(other.common, kSmallSpokes * 9 / 10);
  EXPECT_GT(other.different, other.common / 2);
}

}  // namespace
}  // namespace skerry::system_test
