// Recorded exercises are made again from what they were given: the running server, its recorder and
// `skerry recording verify`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

constexpr unsigned kChanges = 50;

// Length of an exercise; SKERRY_EXERCISE_S sets another.
double seconds_of_exercise() {
  const char* said = std::getenv("SKERRY_EXERCISE_S");
  return said != nullptr ? std::stod(said) : 6.0;
}

// A change of what consoles and instructors may change.
wire::Set change(unsigned number, std::mt19937& random) {
  const auto below = [&](unsigned end) {
    return std::uniform_int_distribution<unsigned>(0, end - 1)(random);
  };
  wire::Set set;
  set.set_radar(below(3));
  switch (number % 7) {
    case 0:
      set.set_gain(below(101));
      break;
    case 1:
      set.set_range_nm(std::array{0.75, 1.5, 3.0, 6.0, 12.0}[below(5)]);
      break;
    case 2:
      set.set_course_deg(below(360));
      set.set_speed_kn(below(40));
      break;
    case 3:
      set.mutable_world()->set_sea_state(below(7));
      break;
    case 4:
      set.set_transmit(number % 2 == 0);
      break;
    case 5:
      set.set_rotation_rpm(30.0 + below(31));
      break;
    default:
      set.set_sea(below(101));
      set.set_rain(below(101));
      set.set_interference_rejection(below(101));
  }
  return set;
}

class RecordedExercise : public testing::TestWithParam<bool> {
 protected:
  static wire::Record request(wire::Record::Action action) {
    wire::Record record;
    record.set_action(action);
    return record;
  }
};

TEST_P(RecordedExercise, IsMadeAgainBitForBit) {
  const bool inputs_only = GetParam();
  const TempFolder folder;
  const std::string recordings = folder.path("recordings");
  RunningServer server({"--scenario", folder.write("small.yaml", small_scenario()),
                        "--record-folder", recordings, "--record-reserve-mib", "0"});
  client::SpokeClient client = connected(server);
  wire::Record start = request(wire::Record::START);
  start.set_name("exercise");
  start.set_inputs_only(inputs_only);
  const auto started = client.record(start, kAnswerTime);
  ASSERT_TRUE(started) << started.error().text;
  ASSERT_EQ(started->code(), wire::Reply::OK) << started->text();

  std::mt19937 random(3);
  const std::chrono::duration<double> pace(seconds_of_exercise() / kChanges);
  for (unsigned i = 0; i < kChanges; ++i) {
    std::this_thread::sleep_for(pace);  // what an exercise is made of
    const auto reply = client.set(change(i, random), kAnswerTime);
    ASSERT_TRUE(reply) << reply.error().text;
    EXPECT_EQ(reply->code(), wire::Reply::OK) << reply->text();
  }
  ASSERT_EQ(client.record(request(wire::Record::STOP), kAnswerTime)->code(), wire::Reply::OK);
  // Finished when the server has ended, or before.
  EXPECT_EQ(server.stop().code, 0);

  const Ending verified =
      run({skerry_program(), "recording", "verify", recordings + "/exercise.mcap", "--video",
           folder.path("again.mcap")});
  std::printf("%s", verified.out.c_str());
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("\nidentical\n"));
  EXPECT_THAT(verified.out, HasSubstr(inputs_only ? "checkpoints" : "compared byte by byte, 0"));
  // The video made again is a recording like any other, and verifies itself.
  const Ending again = run({skerryd_program(), "--verify", folder.path("again.mcap")});
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_THAT(again.out, HasSubstr("compared byte by byte, 0 different"));
}

INSTANTIATE_TEST_SUITE_P(Of, RecordedExercise, testing::Values(false, true),
                         [](const auto& of) { return of.param ? "Inputs" : "Video"; });

// Recordings that version 0.1 made, and the SHA-256 of the video that is made of them now.  Spokes
// at the end of a turn are others since turns fade into each other, and rain has another shape
// (echo/MODEL.md, section 8); the last bits of own ship's place are others since every machine
// steps her by the same arithmetic (server/world/short_way.hpp); verify says so of recordings
// whose checkpoints cover such spokes.
TEST(Verify, MakesTheVideoOfFormerRecordingsAgain) {
  struct Former {
    const char* name;
    const char* sum;
    bool same;
  };
  for (const Former& former : {
           Former{"all_views", "8c59b1b5d33f61aee41b66f2b8e863432b8fa122b87c4081c61bb89596320786",
                  false},
           {"compact_zstd", "74b36cc079af23cd5a313b4b33053a699fc3af8494cbf9aeb2710d16a78c2dd4",
            false},
           {"inputs", "6e37fb97289ecd3321847d739fef99ff9374fc62169c5c790058a87d30866a77", false},
           {"inputs_nmea", "d21d1a1163d428d534fc7c9c2476953c474b969bcd36305010bf4313f76d9a55",
            false},
           {"none", "fd4df1a077a0c88c07cb1d4c52d66d2243394a624eccfa0ce75351e3bcdb33ac", false},
           {"unfinished", "adadb8d32aeaa6bacc78fe1257e5a2b64992e2340698ea56e7796fe4671e3201",
            false},
       }) {
    const Ending ending =
        run({skerry_program(), "recording", "verify",
             SKERRY_SOURCE_DIR "/tests/golden/recordings/" + std::string(former.name) + ".mcap"});
    EXPECT_EQ(ending.code, former.same ? 0 : 1) << former.name << ": " << ending.out << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("SHA-256          " + std::string(former.sum)))
        << former.name;
    EXPECT_THAT(ending.out, HasSubstr(former.same ? "\nidentical\n" : "\nNOT identical\n"))
        << former.name;
  }
}

TEST(Verify, SaysWhatCannotBeMadeAgain) {
  const TempFolder folder;
  const auto refused = [&](const std::string& file, const std::string& reason) {
    const Ending ending = run({skerry_program(), "recording", "verify", file});
    EXPECT_EQ(ending.code, 2) << ending.out;
    EXPECT_THAT(ending.err, HasSubstr(reason));
    EXPECT_THAT(ending.err, HasSubstr(file));
  };
  refused(folder.path("none.mcap"), "No such file");
  refused(folder.write("garbage.mcap", std::string(1000, 'x')), "byte 0");
  refused(folder.write("empty.mcap", ""), "byte 0");
}

}  // namespace
}  // namespace skerry::system_test
