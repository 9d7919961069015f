// `skerry targets` at the running server: a ship is found in the video, and the plotter does what
// it is ordered to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/wire/targets.pb.h"
#include "tests/system/receive.hpp"
#include "tests/system/running_server.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

// On the open sea.  Foe comes by from ahead and has AIS; Still lies at anchor in the east.
constexpr const char* kOpenSea = R"(
name: Open sea
seed: 3
sea: {state: 0}
own_ships:
  - name: Tern
    position: {lat: 45, lon: -30}
    course_deg: 0
    speed_kn: 0
    radars:
      - {name: Fast, spokes: 720, cells: 512, bits: 8, rpm: 60, range_nm: 3}
targets:
  - {name: Foe, mmsi: 257000002, position: {lat: 45.03, lon: -29.96}, course_deg: 180, speed_kn: 20,
     length_m: 180, beam_m: 30, height_m: 20}
  - {name: Still, position: {lat: 45, lon: -29.98}, course_deg: 0, speed_kn: 0,
     length_m: 120, beam_m: 20, height_m: 15}
)";

class TargetsCommand : public testing::Test {
 protected:
  // `skerry targets WORDS...`
  Ending targets(const std::vector<std::string>& words) const {
    return server_.skerry("targets", words);
  }
  std::string told(const std::vector<std::string>& words) const {
    const Ending ending = targets(words);
    EXPECT_EQ(ending.code, 0) << testing::PrintToString(words) << ending.err;
    return ending.out;
  }
  wire::TargetList list() const {
    wire::TargetList list;
    const auto read = google::protobuf::util::JsonStringToMessage(told({"--json"}), &list);
    if (!read.ok()) throw std::runtime_error(std::string(read.message()));
    return list;
  }
  // Reads on up to a line that has the text.
  std::string await_line(const std::string& text) {
    for (;;) {
      const auto line = watch_.read_line();
      if (!line) throw std::runtime_error("never written: " + text);
      if (line->find(text) != std::string::npos) return *line;
    }
  }

  TempFolder folder_;
  RunningServer server_{{"--scenario", folder_.write("open_sea.yaml", kOpenSea)}};
  // The plotter works while somebody looks at it.
  ChildProcess watch_{
      {skerry_program(), "targets", "watch", "--port", std::to_string(server_.tcp_port())}};
};

TEST_F(TargetsCommand, ATargetIsFoundAnotherAcquiredAndWhatIsOrderedIsDone) {
  EXPECT_THAT(await_line("watching"), HasSubstr("radar 0 view 0"));

  // By AIS she passes at 1.7 NM: no danger, until the limits say so.
  EXPECT_EQ(told({"rules", "--cpa", "3", "--tcpa", "30"}), "CPA limit 3 NM, TCPA limit 30 min\n");
  await_line("rules: CPA limit 3 NM, TCPA limit 30 min");
  EXPECT_THAT(told({"rules"}), HasSubstr("CPA limit            3 NM"));
  EXPECT_THAT(await_line("alarm 3044."), HasSubstr("AIS target 257000002"));
  EXPECT_THAT(told({"acknowledge", "3044"}), HasSubstr("acknowledged: alarm 3044."));
  await_line("CPA/TCPA: acknowledged");

  // The ship at anchor does not move: she is acquired by hand.
  const std::string taken = told({"acquire", "--range", "0.85", "--bearing", "90", "--wait", "30"});
  ASSERT_THAT(taken, MatchesRegex("target [0-9]+ is tracked\n"));
  const std::string number = taken.substr(7, taken.find(' ', 7) - 7);
  await_line("target " + number + ": acquired");
  // The other comes by itself.
  const auto is_foe = [](const wire::Target& target) {
    return !target.by_hand() && std::abs(target.bearing_deg() - 45.0) < 20.0;
  };
  client::SpokeClient display = connected(server_);
  ASSERT_TRUE(display.watch_targets(0, 0, 2, kAnswerTime).ok());
  await<wire::TargetList>(display, [&](const wire::TargetList& now) {
    return std::any_of(now.targets().begin(), now.targets().end(), is_foe);
  });
  EXPECT_THAT(told({"--by", "range"}), HasSubstr("by hand"));
  EXPECT_EQ(told({"cancel", number}), "cancelled: " + number + "\n");
  await_line("target " + number + ": no longer listed");

  EXPECT_THAT(told({"trial", "--course", "90", "--speed", "12"}), HasSubstr("Still"));
  told({"trial", "--end"});
  told({"zone", "1", "--inner", "0.1", "--outer", "2.5"});
  await_line("zone 1: acquires");
  told({"test", "on"});
  await_line("test target,");
  EXPECT_THAT(told({}), HasSubstr("TEST TARGET"));
  watch_.signal(SIGINT);
  EXPECT_EQ(watch_.wait().code, 0);
}

TEST_F(TargetsCommand, WhatIsWrongIsSaidAsTheServerSaysIt) {
  struct Case {
    std::vector<std::string> words;
    std::vector<const char*> said;
  };
  const std::vector<Case> cases = {
      {{"--radar", "7"}, {"radar"}},
      {{"--view", "9", "silence"}, {"view"}},
      {{"cancel", "999"}, {"target 999 is not tracked"}},
      {{"reference", "999"}, {"target 999 is not tracked"}},
      {{"rules", "--cpa", "11"}, {"CPA limit", "11", "0 to 10 NM"}},
      {{"rules", "--capacity", "9"}, {"capacity", "10 to 200"}},
      {{"zone", "9", "--outer", "3"}, {"1 to 8"}},
      {{"zone", "1", "--inner", "3", "--outer", "2"}, {"zone 1", "inner"}},
      {{"zone", "2", "--remove"}, {"there is no zone 2"}},
      {{"trial", "--course", "361", "--speed", "5"}, {"trial course", "0 to 360 deg"}},
      {{"acknowledge", "3044.9"}, {"there is no alert 3044.9"}},
      {{"acknowledge", "1"}, {"there are no alerts 1"}},
      {{"ais", "activate", "123456789"}, {"there is no AIS target 123456789"}},
      {{"acquire", "--range", "49", "--bearing", "5"}, {"range", "49", "0.01 to 48 NM"}},
      {{"acquire", "--range", "2.9", "--bearing", "270", "--wait", "0"}, {"no echo there"}},
  };
  const std::string before = list().rules().SerializeAsString();
  for (const Case& wrong : cases) {
    const Ending ending = targets(wrong.words);
    SCOPED_TRACE(testing::PrintToString(wrong.words));
    EXPECT_EQ(ending.code, 1) << ending.err;
    EXPECT_EQ(ending.out, "");
    for (const char* part : wrong.said) EXPECT_THAT(ending.err, HasSubstr(part));
  }
  EXPECT_EQ(list().rules().SerializeAsString(), before) << "nothing was changed";
  EXPECT_EQ(list().zones_size(), 0);
}

}  // namespace
}  // namespace skerry::system_test
