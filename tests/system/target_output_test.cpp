// Plots and tracks as they leave the running server in each category of ASTERIX, read by Wireshark:
// its targets are where the native list has them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "protocol/quantity/length.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"
#include "tests/unit/asterix/tshark.hpp"
#include "tests/unit/net/display_socket.hpp"

namespace skerry::system_test {
namespace {

using server::DisplaySocket;

constexpr std::uint32_t kLoopback = ipv4(127, 0, 0, 1);
constexpr std::size_t kLists = 4;  // that are compared

// Time of day in 1/128 s, truncated.
std::int64_t time_of_day(std::uint64_t utc_ns) {
  constexpr std::uint64_t kDay = 86'400'000'000'000, kSecond = 1'000'000'000;
  return static_cast<std::int64_t>(utc_ns % kDay * 128 / kSecond);
}

// The native lists, by time and number.
using Lists = std::map<std::int64_t, std::map<unsigned, wire::Target>>;

// Values of one field in one datagram, in order.
std::vector<double> numbers(const std::string& field) {
  std::vector<double> all;
  std::istringstream in(field);
  for (std::string one; std::getline(in, one, ',');) all.push_back(std::stod(one));
  return all;
}

class TargetOutputs : public testing::Test {
 protected:
  void SetUp() override {
    if (::access("/usr/bin/tshark", X_OK) != 0) {
      GTEST_SKIP() << "tshark is not installed: apt-get install tshark";
    }
    const auto output = [](const char* kind, const DisplaySocket& to) {
      return std::string(kind) + ":sac=25,port=" + std::to_string(to.port());
    };
    const RunningServer server({"--scenario", folder_.write("small.yaml", small_scenario()),
                                "--output", output("cat048", polar_), "--output",
                                output("cat062", system_), "--output", output("cat010", shore_)});
    client::SpokeClient native = connected(server);
    ASSERT_TRUE(native.watch_targets(0, 0, 2, kAnswerTime));
    acquire_tanker(native);
    while (lists_.size() < kLists) {
      const auto list = await<wire::TargetList>(
          native, [](const wire::TargetList& all) { return !all.targets().empty(); });
      for (const wire::Target& target : list.targets()) {
        lists_[time_of_day(list.utc_ns())][target.number()] = target;
      }
    }
    const Ending status = server.skerry("status");
    for (const char* kind : {"cat048", "cat062", "cat010"}) {
      EXPECT_NE(status.out.find(kind), std::string::npos) << status.out;
    }
  }

  // At once: a ship that moves would be acquired by itself, but only after many turns.
  static void acquire_tanker(client::SpokeClient& native) {
    wire::TargetOrder order;
    order.mutable_acquire()->set_latitude_deg(60.445);
    order.mutable_acquire()->set_longitude_deg(5.020);
    await<wire::TargetList>(native, [&](const wire::TargetList&) {
      return native.order_targets(order, kAnswerTime).ok();  // her echo is seen in two turns
    });
  }

  // What has come to the socket, as the first of these fields of each datagram, the second, and so
  // on.
  std::vector<std::vector<std::vector<double>>> read(DisplaySocket& socket,
                                                     const std::vector<std::string>& fields) {
    const std::string path = folder_.path("heard.pcap");
    {
      Capture capture(path);
      while (const auto datagram = socket.receive(0, std::chrono::milliseconds(0))) {
        capture.add(datagram->payload);
      }
    }
    const std::string tshark = "/usr/bin/tshark -r '" + path + "' ";
    EXPECT_EQ(output_of(tshark + "-Y '!asterix or _ws.malformed or _ws.expert.severity >= warning' "
                                 "2>/dev/null"),
              "");
    std::string arguments = "-T fields -E separator='|'";
    for (const std::string& field : fields) arguments += " -e asterix." + field;
    std::vector<std::vector<std::vector<double>>> all;
    for (const std::string& line : lines_of(output_of(tshark + arguments + " 2>/dev/null"))) {
      std::istringstream in(line + '|');
      all.emplace_back();
      for (std::string field; std::getline(in, field, '|');) all.back().push_back(numbers(field));
    }
    return all;
  }

  // Calls compare(target, values) for each track that a list compared has: the values are those of
  // the fields after the number and the time of day.  Plots come before the tracks, and have no
  // number.  Returns how many tracks and how many other records there were.
  template <typename Compare>
  std::pair<std::size_t, std::size_t> for_each_track(DisplaySocket& socket,
                                                     const std::vector<std::string>& fields,
                                                     const Compare& compare) {
    std::size_t compared = 0, others = 0;
    for (const auto& datagram : read(socket, fields)) {
      const std::vector<double>& tracks = datagram.at(0);
      others += datagram.at(1).size() - tracks.size();
      for (std::size_t i = 0; i < tracks.size(); ++i) {
        std::vector<double> values;
        for (const auto& field : datagram) {
          values.push_back(field.at(field.size() - tracks.size() + i));
        }
        const auto list = lists_.find(std::llround(values[1] * 128));
        if (list == lists_.end()) continue;
        const auto target = list->second.find(static_cast<unsigned>(values[0]));
        if (target == list->second.end()) continue;
        compare(target->second, std::vector<double>(values.begin() + 2, values.end()));
        ++compared;
      }
    }
    return {compared, others};
  }

  TempFolder folder_;
  DisplaySocket polar_{{}, kLoopback}, system_{{}, kLoopback}, shore_{{}, kLoopback};
  Lists lists_;
};

// Of bearings: the shorter way round.
double between(double a_deg, double b_deg) { return std::remainder(a_deg - b_deg, 360.0); }

TEST_F(TargetOutputs, AreReadByWiresharkAndAgreeWithTheNativeList) {
  const auto polar =
      for_each_track(polar_, {"048_161_TRN", "048_140_VALUE", "048_040_RHO", "048_040_THETA"},
                     [](const wire::Target& target, const std::vector<double>& values) {
                       EXPECT_NEAR(values[0] * Length::kMetresPerNauticalMile, target.range_m(),
                                   Length::kMetresPerNauticalMile / 256);
                       EXPECT_NEAR(between(values[1], target.bearing_deg()), 0.0, 360.0 / 65536);
                     });
  EXPECT_GE(polar.first, kLists - 1) << "the last may still be on its way";
  EXPECT_GT(polar.second, 0u) << "plots";

  const auto system =
      for_each_track(system_, {"062_040_VALUE", "062_070_VALUE", "062_105_LAT", "062_105_LON"},
                     [](const wire::Target& target, const std::vector<double>& values) {
                       EXPECT_NEAR(values[0], target.latitude_deg(), 180.0 / (1 << 25));
                       EXPECT_NEAR(values[1], target.longitude_deg(), 180.0 / (1 << 25));
                     });
  EXPECT_GE(system.first, kLists - 1);
  EXPECT_EQ(system.second, 0u) << "it has no plots";

  const auto shore = for_each_track(
      shore_,
      {"010_161_TRK", "010_140_VALUE", "010_041_LAT", "010_041_LON", "010_040_RHO", "010_040_TH"},
      [](const wire::Target& target, const std::vector<double>& values) {
        EXPECT_NEAR(values[0], target.latitude_deg(), 1e-6);
        EXPECT_NEAR(values[1], target.longitude_deg(), 1e-6);
        EXPECT_NEAR(values[2], target.range_m(), 1.0);
        EXPECT_NEAR(between(values[3], target.bearing_deg()), 0.0, 360.0 / 65536);
      });
  EXPECT_GE(shore.first, kLists - 1);
  EXPECT_GT(shore.second, 2 * kLists) << "two messages with each list, and plots";
}

}  // namespace
}  // namespace skerry::system_test
