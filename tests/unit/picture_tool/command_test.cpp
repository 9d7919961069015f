// The built program `skerry`, whose commands picture and radar run skerry-picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/unit/clients/program.hpp"
#include "tests/unit/picture_tool/picture_kit.hpp"

namespace skerry::echo {
namespace {

using client::Program;
using client::test_folder;
using client::text_of_file;
using test::blobs;
using test::put;
using test::recording_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Outcome {
  int code;
  std::string out, err;
};

Outcome skerry_says(std::vector<std::string> arguments) {
  Program program(std::move(arguments));
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

TEST(PictureCommand, HelpsAndRefusesWhatItDoesNotKnow) {
  for (const char* command : {"judge", "sheet", "table"}) {
    const Outcome help = skerry_says({"picture", command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, HasSubstr(std::string("  skerry picture ") + command)) << command;
    EXPECT_EQ(skerry_says({"picture", command}).code, 2) << command;
    EXPECT_EQ(skerry_says({"picture", command, "x", "--none-such"}).code, 2) << command;
  }
  const Outcome fit = skerry_says({"radar", "fit", "--help"});
  EXPECT_EQ(fit.code, 0);
  EXPECT_THAT(fit.out, HasSubstr("  skerry radar fit "));
  EXPECT_EQ(skerry_says({"radar", "fit", "x", "--set", "none such"}).code, 2);
  EXPECT_EQ(skerry_says({"picture"}).code, 2);
}

TEST(PictureCommand, JudgesTwoRecordings) {
  const std::string folder = test_folder();
  const std::string real = put(folder, "real.mcap", recording_of(blobs(1, {}, 2)));
  const std::string made = put(folder, "made.mcap", recording_of(blobs(2, {.holes = 0.02}, 2)));
  const Outcome judge =
      skerry_says({"picture", "judge", real, made, "--csv", folder + "/judge.csv"});
  ASSERT_EQ(judge.code, 0) << judge.err;
  EXPECT_THAT(judge.out,
              AllOf(StartsWith("first   real 1920 m"), HasSubstr("outline D below"),
                    HasSubstr("real | ours"), HasSubstr("null"), HasSubstr("tells, one by one"),
                    HasSubstr("note: the capture's name "
                              "tells no set")));
  EXPECT_EQ(judge.err, "");  // no progress but on a terminal
  const std::string csv = text_of_file(folder + "/judge.csv");
  EXPECT_THAT(csv, AllOf(StartsWith("kind,name,measure,value\nstatistic,outline_below,first,1."),
                         AnyOf(HasSubstr("\ncall,real | ours,mask_auc,0.9"),
                               HasSubstr("\ncall,real | ours,mask_auc,1\n"))));
  const Outcome json = skerry_says({"picture", "judge", real, made, "--json"});
  EXPECT_THAT(json.out,
              AllOf(StartsWith("{\n"), HasSubstr("\"real | ours\": {\"mask\": {\"auc\": "),
                    Not(HasSubstr("nan"))));
}

TEST(PictureCommand, SaysWhatItCannotJudge) {
  const std::string folder = test_folder();
  const std::string real = put(folder, "real.mcap", recording_of(blobs(1, {}, 1)));
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    const Outcome outcome = skerry_says(std::move(arguments));
    EXPECT_EQ(outcome.code, 1) << why;
    EXPECT_THAT(outcome.err + outcome.out, HasSubstr(why));
  };
  refused({"picture", "judge", real, folder + "/none.mcap"}, "none.mcap");
  refused({"picture", "judge", real, put(folder, "empty.pcap", "")}, "capture");
  refused({"picture", "judge", real, real, "--radar", "1"}, "no whole turn of radar 1");
  refused({"radar", "fit", put(folder, "text.pcap", "neither of them, but long enough")}, "");
  refused({"picture", "table", folder + "/none"}, "none");
  refused({"picture", "table", test_folder()}, "no capture in it");

  TurnsOfPicture other = blobs(2);
  other.reach_m *= 2.0;
  refused({"picture", "judge", real, put(folder, "other.mcap", recording_of(other))},
          "Record a radar of 512 spokes and 384 cells");

  TurnsOfPicture sea = blobs(1);
  sea.turns[0].assign(sea.turns[0].size(), 0);
  const std::string empty = put(folder, "sea.mcap", recording_of(sea));
  refused({"picture", "judge", empty, real}, "no coast in it");
  refused({"radar", "fit", empty}, "no coast in it");
  refused({"picture", "judge", real, empty}, "too few patches");
  refused({"picture", "judge", real, empty}, "the second has no ");
}

// Real captures, where there are any beside the tree.
class PictureOfCaptures : public testing::Test {
 protected:
  void SetUp() override {
    const auto folder = std::filesystem::path(SKERRY_SOURCE_DIR) / "../shared/data/radar";
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no captures in " << folder;
    folder_ = folder.string() + "/";
  }
  std::string folder_;
};

TEST_F(PictureOfCaptures, TwoRadarsAreToldApartAndTheNullIsNot) {
  const Outcome judge = skerry_says({"picture", "judge", folder_ + "3g-trueheading.pcap.gz",
                                     folder_ + "br24-ranges-nm.pcap.gz", "--reach", "1633"});
  ASSERT_EQ(judge.code, 0) << judge.err;
  EXPECT_THAT(judge.out, AllOf(HasSubstr("beam    5.2 deg"), HasSubstr("\nreal | ours "),
                               Not(HasSubstr("the folds leak"))));
}

TEST_F(PictureOfCaptures, WithoutAWholeTurnOrACoastAreRefused) {
  const Outcome gaps = skerry_says({"radar", "fit", folder_ + "halo3-5-connect-transmit.pcap.gz"});
  EXPECT_EQ(gaps.code, 1);
  EXPECT_THAT(gaps.err, HasSubstr("no whole turn"));
  const Outcome sea = skerry_says({"picture", "table", folder_, "--only", "furuno"});
  EXPECT_EQ(sea.code, 1);
  EXPECT_THAT(sea.out, HasSubstr("no coast in it"));
}

TEST_F(PictureOfCaptures, AreDrawnAndTabledAndFitted) {
  const std::string png = test_folder() + "/sheet.png";
  const std::string capture = folder_ + "garminxhd_txon_txoff.pcap.gz";
  const Outcome sheet = skerry_says({"picture", "sheet", "-o", png, capture});
  if (sheet.err.find("GSHHG") != std::string::npos) GTEST_SKIP() << sheet.err;
  ASSERT_EQ(sheet.code, 0) << sheet.err;
  EXPECT_EQ(text_of_file(png).substr(1, 3), "PNG");
  const Outcome table =
      skerry_says({"picture", "table", folder_, "--only", "garminxhd", "--places", "2"});
  EXPECT_EQ(table.code, 0) << table.err;
  // One turn: nothing is made up of its following turns.
  EXPECT_THAT(table.out, AllOf(HasSubstr("garminxhd_txon_txoff 2093 m x1"),
                               HasSubstr("the first has no turn_lag1, bow_seam")));
  const Outcome fit = skerry_says({"radar", "fit", capture, "--renders", "3", "--places", "2"});
  EXPECT_EQ(fit.code, 0) << fit.err;
  EXPECT_THAT(fit.out, AllOf(HasSubstr("3 renders, stopped before the search ended"),
                             HasSubstr("- set: xHD\n"), HasSubstr("AUC, mask ")));
}

}  // namespace
}  // namespace skerry::echo
