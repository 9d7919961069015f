// Where the audit of a running server is found: by HTTP, in its recording, over files that were
// rotated, in a backup, and after a full disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "server/audit/audit_chain.hpp"
#include "tests/system/running_server.hpp"
#include "tests/system/small_disk.hpp"
#include "tests/system/small_scenario.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::system_test {
namespace {

namespace fs = std::filesystem;
using server::wait_until;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Ending tool(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), skerry_program());
  return run(std::move(arguments));
}

class KeptAudit : public testing::Test {
 protected:
  static std::string page(const RunningServer& server, const std::string& query = {}) {
    return server::http_get(server.http_port(), "/audit" + query);
  }
  static bool has(const RunningServer& server, const std::string& text) {
    return wait_until([&] { return page(server).find(text) != std::string::npos; });
  }
  static void set_gain(const RunningServer& server, int gain) {
    const Ending set = server.skerry("set", {"--gain", std::to_string(gain)});
    EXPECT_EQ(set.code, 0) << set.err;
  }

  // "record start watch" of this server.
  static void record(const RunningServer& server, const std::vector<std::string>& words) {
    std::vector<std::string> all{"record"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"--port", std::to_string(server.tcp_port())});
    const Ending done = tool(all);
    EXPECT_EQ(done.code, 0) << done.err;
  }

  // The audit with another value before the change to 71, and a chain that is right.
  static void make_anew(const std::string& file, const std::string& other,
                        const std::string& before) {
    std::ofstream out(other, std::ios::binary);
    server::AuditHead head;
    server::check_audit(file, {}, [&](recording::AuditEntry entry) {
      if (entry.before() == before && entry.after() == "71") entry.set_before("70");
      out << server::audit_line(entry, head);
    });
  }

  TempFolder folder_;
  std::string scenario_ = folder_.write("small.yaml", small_scenario());
  std::string state_ = folder_.path("state");
};

TEST_F(KeptAudit, IsServedAlsoWithoutAFile) {
  const RunningServer server({"--scenario", scenario_});
  set_gain(server, 71);
  EXPECT_TRUE(has(server, R"("before":"50","after":"71")"));
  EXPECT_THAT(page(server),
              AllOf(HasSubstr(R"("has_file":false)"), HasSubstr(" begins: scenario")));
  EXPECT_THAT(page(server, "?kind=server"), Not(HasSubstr("\"71\"")));
}

TEST_F(KeptAudit, HasWhoseConsoleLeftACon) {
  std::string classed = small_scenario();
  classed.replace(classed.find("speed_kn: 12"), 12, "speed_kn: 12\n    ship_class: coaster");
  for (const char* key :
       {"speed_time_constant_s", "turn_time_constant_s", "max_rate_of_turn_deg"}) {
    const std::size_t at = classed.find(key);
    classed.erase(at, classed.find('\n', at) - at);
  }
  const RunningServer server({"--scenario", folder_.write("classed.yaml", classed)});
  {
    server::TestClient console(server.tcp_port());
    console.receive_hello();
    wire::ClientMessage message;
    message.mutable_set()->mutable_con()->set_take(true);
    console.send(message);
    EXPECT_EQ(console.receive_reply().code(), wire::Reply::OK);
    EXPECT_TRUE(has(server, R"("before":"nobody")"));
  }
  EXPECT_TRUE(has(server, R"("what":"Tern: con")"));
  EXPECT_THAT(page(server, "?last=1"), HasSubstr(R"("after":"nobody: its console has left")"));
}

TEST_F(KeptAudit, IsInTheRecordingAndItsReport) {
  const std::string recording = state_ + "/recordings/watch.mcap";
  {
    RunningServer server({"--scenario", scenario_, "--state", state_, "--record-reserve-mib", "0"});
    set_gain(server, 60);
    record(server, {"start", "watch"});
    set_gain(server, 71);
    EXPECT_TRUE(has(server, R"("after":"71")"));
    record(server, {"mark", "here"});
    EXPECT_TRUE(has(server, "MARK"));
    record(server, {"stop"});
    set_gain(server, 72);
    EXPECT_EQ(server.stop().code, 0);
  }
  const Ending shown = tool({"audit", "show", recording});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, AllOf(HasSubstr("gain: 60 -> 71"), HasSubstr("watch"), HasSubstr("MARK")));
  EXPECT_THAT(shown.out, AllOf(Not(HasSubstr("50 -> 60")), Not(HasSubstr("71 -> 72"))));
  EXPECT_EQ(tool({"audit", "show", recording, "--kind", "change"}).out.find("MARK"),
            std::string::npos);
  const Ending verified = tool({"audit", "verify", recording});
  EXPECT_EQ(verified.code, 1);
  EXPECT_THAT(verified.err, HasSubstr("is a recording"));
  const std::string file = state_ + "/audit.jsonl", other = folder_.path("other.jsonl");
  const Ending beside = tool({"audit", "verify", file, recording});
  EXPECT_EQ(beside.code, 0) << beside.err;
  EXPECT_THAT(beside.out, HasSubstr(recording + ": 3 entries, as the files have them"));
  make_anew(file, other, "60");
  EXPECT_EQ(tool({"audit", "verify", other}).code, 0) << "it holds together";
  const Ending found_out = tool({"audit", "verify", other, recording});
  EXPECT_EQ(found_out.code, 1);
  EXPECT_THAT(found_out.err, HasSubstr("is another than in the files"));
  EXPECT_THAT(tool({"audit", "verify",
                    SKERRY_SOURCE_DIR "/tests/golden/state/0.1/state/audit.jsonl", recording})
                  .err,
              HasSubstr("3 of its 3 entries are not in the files"));
  EXPECT_THAT(tool({"recording", "info", recording}).out, HasSubstr("entries of the audit"));
  const std::string tables = folder_.path("tables"), report = folder_.path("report.html");
  const Ending made =
      tool({"exercise", "report", recording, "--csv", tables, "-o", report, "--no-checks"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(text_of_file(tables + "/deeds.csv"), HasSubstr("radar 0 view 0: gain,60,71,1,"));
  EXPECT_THAT(text_of_file(report), HasSubstr("Who did what"));
  // What is made of recordings keeps it.
  const std::string copy = folder_.path("copy.mcap");
  EXPECT_EQ(tool({"recording", "cut", recording, "--from", "0", "-o", copy}).code, 0);
  EXPECT_EQ(tool({"audit", "show", copy}).out, shown.out);
  EXPECT_THAT(tool({"audit", "show", SKERRY_SOURCE_DIR "/tests/golden/recordings/none.mcap"}).err,
              HasSubstr("no entries of the audit"));
}

TEST_F(KeptAudit, GoesOnOverFilesThatAreMovedAway) {
  const std::string file = state_ + "/audit.jsonl";
  const std::string first = file + ".1", second = file + ".2";
  {
    RunningServer server({"--scenario", scenario_, "--state", state_});
    int gain = 60;
    for (const std::string& moved : {first, second}) {
      set_gain(server, ++gain);
      EXPECT_TRUE(has(server, "\"after\":\"" + std::to_string(gain) + "\""));
      fs::rename(file, moved);
      server.signal(SIGHUP);
      EXPECT_TRUE(wait_until([&] { return fs::exists(file) && fs::file_size(file) > 0; }));
    }
    server.signal(SIGHUP);  // where it is: nothing happens
    set_gain(server, ++gain);
    EXPECT_EQ(server.stop().code, 0);
  }
  const Ending all = tool({"audit", "verify", first, second, file});
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("goes on from entry "));
  const Ending gap = tool({"audit", "verify", first, file});
  EXPECT_EQ(gap.code, 1);
  EXPECT_THAT(gap.err, AllOf(HasSubstr(file + ":1: "), HasSubstr("does not go on from " + first)));
  EXPECT_EQ(tool({"audit", "verify", second, first, file}).code, 1) << "another order";
  EXPECT_EQ(tool({"audit", "verify", file}).code, 0) << "by itself";
  const Ending shown = tool({"audit", "show", first, second, file, "--kind", "change"});
  EXPECT_THAT(shown.out,
              AllOf(HasSubstr("50 -> 61"), HasSubstr("61 -> 62"), HasSubstr("62 -> 63")));
}

// A copy while the server runs and records is a backup.
TEST_F(KeptAudit, ACopyOfTheStateFolderIsABackup) {
  const std::string copy = folder_.path("copy");
  {
    RunningServer server({"--scenario", scenario_, "--state", state_, "--record"});
    const std::string setup =
        R"({"kind": "skerry set-up", "version": 1, "name": "night", "parts": {}})";
    server::http_exchange(server.http_port(),
                          "PUT /setups/night HTTP/1.1\r\nHost: localhost\r\nConnection: "
                          "close\r\nContent-Length: " +
                              std::to_string(setup.size()) + "\r\n\r\n" + setup);
    set_gain(server, 71);
    EXPECT_TRUE(has(server, R"("after":"71")"));
    EXPECT_TRUE(wait_until([&] {
      return text_of_file(state_ + "/audit.jsonl").find("\"after\":\"71\"") != std::string::npos;
    }));
    std::string recording;
    EXPECT_TRUE(wait_until([&] {
      for (const auto& entry : fs::directory_iterator(state_ + "/recordings")) {
        if (entry.path().extension() == ".mcap" && entry.file_size() > 200'000) {
          recording = entry.path().filename();
        }
      }
      return !recording.empty();
    }));
    EXPECT_EQ(run({"/bin/cp", "-a", state_, copy}).code, 0);
    EXPECT_EQ(tool({"audit", "verify", copy + "/audit.jsonl"}).code, 0);
    const std::string copied = copy + "/recordings/" + recording;
    EXPECT_EQ(tool({"recording", "repair", copied, "-o", folder_.path("whole.mcap")}).code, 0);
    EXPECT_THAT(tool({"recording", "info", folder_.path("whole.mcap")}).out,
                HasSubstr("entries of the audit"));
  }
  RunningServer restored({"--scenario", scenario_, "--state", copy});
  EXPECT_THAT(server::http_get(restored.http_port(), "/setups"), HasSubstr("night"));
  EXPECT_EQ(restored.stop().code, 0);
  EXPECT_EQ(tool({"audit", "verify", copy + "/audit.jsonl"}).code, 0) << "it goes on";
}

TEST_F(KeptAudit, AFullDiskStopsNoRadarAndLosesNoEntry) {
  const SmallDisk disk(state_, "size=40m");
  if (!disk.is_there()) GTEST_SKIP() << SmallDisk::kNeeds;
  {
    RunningServer server(
        {"--scenario", scenario_, "--state", state_, "--record", "--record-reserve-mib", "1"});
    set_gain(server, 61);
    EXPECT_TRUE(has(server, R"("after":"61")"));
    disk.fill();
    server::TestClient console(server.tcp_port());
    console.receive_hello();
    console.subscribe();
    int gain = 61;
    EXPECT_TRUE(wait_until([&] {
      set_gain(server, ++gain);
      return page(server).find(R"("unwritten":0)") == std::string::npos;
    }));
    EXPECT_TRUE(has(server, "\"after\":\"" + std::to_string(gain) + "\"")) << "it is shown";
    const auto spoke = [&] {
      while (const auto message = console.receive()) {
        if (message->has_spoke()) return message->spoke().sequence();
      }
      return decltype(wire::Spoke().sequence()){0};
    };
    const auto first = spoke();
    while (spoke() < first + kSmallSpokes) continue;  // a turn goes by
    disk.make_room();
    EXPECT_TRUE(has(server, R"("unwritten":0)"));
    set_gain(server, ++gain);
    EXPECT_TRUE(has(server, "\"after\":\"" + std::to_string(gain) + "\""));
    std::this_thread::sleep_for(std::chrono::seconds(1));  // the recorder looks for room
    EXPECT_EQ(server.stop().code, 0);
  }
  EXPECT_EQ(tool({"audit", "verify", state_ + "/audit.jsonl"}).code, 0);
  for (const auto& entry : fs::directory_iterator(state_ + "/recordings")) {
    if (entry.path().extension() != ".mcap") continue;
    const Ending shown = tool({"audit", "show", entry.path().string()});
    EXPECT_EQ(shown.code, 0) << "none is missing: " << shown.err;
  }
}

}  // namespace
}  // namespace skerry::system_test
