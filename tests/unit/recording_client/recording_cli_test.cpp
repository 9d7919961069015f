// The built program: `skerry recording ...`, on files of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/clients/program.hpp"
#include "tests/unit/recording_client/recording_maker.hpp"

namespace skerry::client {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using testing::HasSubstr;

struct Outcome {
  int code;
  std::string out, err;
};

class RecordingCli : public testing::Test {
 protected:
  RecordingCli() : folder_(test_folder()) {}
  ~RecordingCli() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  // A recording of ten turns with a mark at 6 s.
  std::string recorded(const std::string& name) const {
    RecordingMaker maker(path(name), kBegin);
    maker.add_hello({{0, "bow"}});
    maker.add_gain({}, 0, 10.0);
    maker.add_mark(seconds(6), "contact");
    maker.add_spokes(0);
    maker.finish();
    return path(name);
  }
  static Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "recording");
    Program program(std::move(arguments));
    const int code = program.wait();
    return {code, program.out(), program.err()};
  }

  std::string folder_;
};

TEST_F(RecordingCli, EveryCommandHasHelpWithExamples) {
  for (const char* command : {"info", "cut", "cat", "export", "import", "repair"}) {
    const Outcome help = run({command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, HasSubstr(std::string("\n  skerry recording ") + command));
  }
}

TEST_F(RecordingCli, EndsWithTwoWhenTheCommandLineIsWrong) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"info"},
      {"cut", "a.mcap"},
      {"cut", "a.mcap", "-o", "b.mcap"},
      {"cut", "a.mcap", "--from", "1", "--mark", "x", "-o", "b.mcap"},
      {"cat", "a.mcap", "-o", "b.mcap"},
      {"export", "a.mcap"},
      {"export", "a.mcap", "--csv", "--png", "1"},
      {"export", "a.mcap", "--png", "0"},
      {"export", "a.mcap", "--png", "last"},
      {"export", "a.mcap", "--pcap", "nmea"},
      {"import", "a.pcap", "--compression", "rar"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << testing::PrintToString(arguments);
    EXPECT_NE(outcome.err, "") << testing::PrintToString(arguments);
  }
}

TEST_F(RecordingCli, InfoShowsTheRecordingAndItsDamage) {
  const std::string file = recorded("a.mcap");
  Outcome info = run({"info", file, "--check"});
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("0:06.000 contact"));
  EXPECT_THAT(run({"info", file, "--json"}).out, HasSubstr("\"count\": 1280"));

  fs::resize_file(file, fs::file_size(file) * 3 / 4);
  info = run({"info", file});
  EXPECT_EQ(info.code, 0);
  EXPECT_THAT(info.err, HasSubstr(file + ": byte "));
  EXPECT_EQ(run({"info", file, "--check"}).code, 1);
  EXPECT_EQ(run({"info", path("none.mcap")}).code, 1);
  std::ofstream(path("text.mcap")) << "This is not a recording.\n";
  EXPECT_THAT(run({"info", path("text.mcap")}).err, HasSubstr("text.mcap: byte 0: "));
}

TEST_F(RecordingCli, RepairMakesAWholeFileOfACutOne) {
  const std::string file = recorded("a.mcap"), whole = path("whole.mcap");
  fs::resize_file(file, fs::file_size(file) * 3 / 4);
  const Outcome repaired = run({"repair", file, "-o", whole});
  EXPECT_EQ(repaired.code, 0) << repaired.err;
  EXPECT_EQ(run({"info", whole, "--check"}).code, 0);
  EXPECT_EQ(run({"repair", file, "-o", whole}).code, 1);  // it is there
  EXPECT_EQ(run({"repair", file, "-o", whole, "--force"}).code, 0);
  EXPECT_EQ(run({"repair", file, "-o", file, "--force"}).code, 1);
  EXPECT_TRUE(fs::exists(file));
}

TEST_F(RecordingCli, CutAndCatByPositionsAndMarks) {
  const std::string file = recorded("a.mcap"), a = path("1.mcap"), b = path("2.mcap");
  EXPECT_THAT(run({"cut", file, "--to", "contact", "-o", a}).out, HasSubstr("600 spokes"));
  EXPECT_THAT(run({"cut", file, "--from", "0:06", "-o", b}).out, HasSubstr("680 spokes"));
  EXPECT_THAT(run({"cat", a, b, "-o", path("both.mcap")}).out, HasSubstr("1280 spokes"));
  EXPECT_THAT(run({"cut", file, "--mark", "contact", "--before", "1", "--after", "0.5", "-o",
                   path("3.mcap"), "--compact", "--compression", "lz4"})
                  .out,
              HasSubstr("150 spokes"));
  // No file is replaced unasked, and a source never.
  EXPECT_THAT(run({"cut", file, "--to", "5", "-o", a}).err, HasSubstr("--force"));
  EXPECT_EQ(run({"cut", file, "--to", "5", "-o", a, "--force"}).code, 0);
  EXPECT_EQ(run({"cut", file, "--to", "5", "-o", file, "--force"}).code, 1);
  EXPECT_EQ(run({"cat", a, b, "-o", b, "--force"}).code, 1);
  EXPECT_THAT(run({"cut", file, "--from", "1:00", "-o", path("4.mcap")}).err,
              HasSubstr("which is at 0:12.790"));
  EXPECT_THAT(run({"cut", file, "--from", "collision", "-o", path("4.mcap")}).err,
              HasSubstr("its marks are \"contact\""));
  EXPECT_THAT(run({"cut", file, "--from", "8", "--to", "7", "-o", path("4.mcap")}).err,
              HasSubstr("is not behind"));
  EXPECT_FALSE(fs::exists(path("4.mcap")));
}

TEST_F(RecordingCli, ExportsPicturesTablesAndCapturesThatImportAgain) {
  const std::string file = recorded("a.mcap");
  EXPECT_THAT(run({"export", file, "--png", "3", "-o", path("3.png"), "--size", "256"}).out,
              HasSubstr("turn 3, 128 of 128 spokes"));
  EXPECT_THAT(text_of_file(path("3.png")), testing::StartsWith("\x89PNG"));
  EXPECT_THAT(run({"export", file, "--png", "all", "-o", path("all.png"), "--size", "64"}).out,
              HasSubstr("10 turns"));
  EXPECT_TRUE(fs::exists(path("all-0010.png")));
  EXPECT_THAT(run({"export", file, "--png", "11"}).err, HasSubstr("the last one is 10"));
  const std::string csv = run({"export", file, "--csv", "--from", "contact"}).out;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 681);
  EXPECT_THAT(run({"export", file, "--csv", "--radar", "3"}).err,
              HasSubstr("there are radar 0 view 0"));
  for (const char* protocol : {"cat240", "navico"}) {
    const std::string pcap = path(std::string(protocol) + ".pcap");
    EXPECT_EQ(run({"export", file, "--pcap", protocol, "-o", pcap}).code, 0);
    const Outcome back = run({"import", pcap, "-o", pcap + ".mcap"});
    EXPECT_EQ(back.code, 0) << back.err;
    EXPECT_EQ(run({"info", pcap + ".mcap", "--check"}).code, 0);
    EXPECT_EQ(run({"export", file, "--pcap", protocol, "-o", pcap}).code, 1);
    EXPECT_EQ(run({"import", pcap, "-o", pcap, "--force"}).code, 1);
  }
  const auto size = fs::file_size(file);
  EXPECT_EQ(run({"export", file, "--csv", "-o", file, "--force"}).code, 1);
  EXPECT_EQ(fs::file_size(file), size);
}

TEST_F(RecordingCli, AnExportReplacesAFileOnceItIsWhole) {
  const std::string file = recorded("a.mcap"), csv = path("a.csv"), link = path("b.csv");
  std::ofstream(csv) << "old";
  EXPECT_EQ(run({"export", file, "--csv", "--radar", "3", "-o", csv, "--force"}).code, 1);
  EXPECT_EQ(run({"export", file, "--pcap", "navico", "--radar", "3", "-o", csv, "--force"}).code,
            1);
  EXPECT_EQ(text_of_file(csv), "old");
  fs::create_symlink(csv, link);
  EXPECT_EQ(run({"export", file, "--csv", "-o", link}).code, 1);
  EXPECT_EQ(run({"export", file, "--csv", "-o", link, "--force"}).code, 0);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_GT(fs::file_size(csv), 1000U);
  EXPECT_EQ(run({"export", file, "--csv", "-o", "/dev/null", "--force"}).code, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 3);
}

TEST_F(RecordingCli, FilesMayHaveAnyName) {
  const std::string file = recorded(
      "r\xE9"
      "cord \xFF.mcap");
  EXPECT_EQ(run({"info", file, "--json"}).code, 0);
  const std::string pcap = path("\xFF\n.pcap");
  EXPECT_EQ(run({"export", file, "--pcap", "navico", "-o", pcap}).code, 0);
  const Outcome back = run({"import", pcap, "-o", path("\xFE.mcap")});
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_THAT(run({"info", path("\xFE.mcap")}).out, HasSubstr("of ??.pcap"));
}

}  // namespace
}  // namespace skerry::client
