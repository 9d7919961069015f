// /metrics of a running server as prometheus_client's own parsers read it, against its status.
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"
#include "tests/unit/net/display_socket.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::system_test {
namespace {

using Json = nlohmann::json;

constexpr char kOpenMetrics[] = "openmetrics";
constexpr char kPrometheus[] = "prometheus";

// A page as the parser read it.
class Samples {
 public:
  explicit Samples(const std::string& lines) {
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);) {
      const Json sample = Json::parse(line);
      samples_[sample.at("sample").get<std::string>() + sample.at("labels").dump()] = sample;
    }
  }
  bool has(const std::string& name, const Json& labels = Json::object()) const {
    return samples_.contains(name + labels.dump());
  }
  // Which must be there.
  Json of(const std::string& name, const Json& labels = Json::object()) const {
    const auto found = samples_.find(name + labels.dump());
    if (found == samples_.end()) throw std::runtime_error("no " + name + labels.dump());
    return found->second;
  }
  double value(const std::string& name, const Json& labels = Json::object()) const {
    return of(name, labels).at("value");
  }
  const std::map<std::string, Json>& all() const { return samples_; }

 private:
  std::map<std::string, Json> samples_;
};

class RunningMetrics : public testing::Test {
 protected:
  void SetUp() override {
    if (::access("/usr/lib/python3/dist-packages/prometheus_client/__init__.py", R_OK) != 0) {
      GTEST_SKIP() << "prometheus_client is not installed: apt-get install "
                      "python3-prometheus-client";
    }
  }
  // The page of a server in a format, read by the parser of that format.
  Samples metrics(const RunningServer& server, const std::string& format) {
    const std::string accept =
        format == kOpenMetrics ? "application/openmetrics-text; version=1.0.0" : "text/plain";
    const std::string answer = server::http_exchange(
        server.http_port(), "GET /metrics HTTP/1.1\r\nHost: localhost\r\nAccept: " + accept +
                                "\r\nConnection: close\r\n\r\n");
    const auto body = answer.find("\r\n\r\n") + 4;
    EXPECT_THAT(answer.substr(0, body), testing::HasSubstr("HTTP/1.1 200 OK"));
    const Ending ending =
        run({"/usr/bin/python3", std::string(SKERRY_SOURCE_DIR) + "/tests/system/read_metrics.py",
             format, folder_.write("page.txt", answer.substr(body))});
    EXPECT_EQ(ending.code, 0) << ending.err << answer;
    return Samples(ending.out);
  }
  // The status that `skerry status` prints.
  static wire::Status status(const RunningServer& server) {
    wire::Status status;
    const Ending ending = server.skerry("status", {"--json"});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(ending.out, &status).ok());
    return status;
  }
  static void record(const RunningServer& server, const std::vector<std::string>& what) {
    std::vector<std::string> all = {skerry_program(), "record"};
    all.insert(all.end(), what.begin(), what.end());
    all.insert(all.end(), {"--port", std::to_string(server.tcp_port())});
    const Ending ending = run(std::move(all));
    if (ending.code != 0) throw std::runtime_error("skerry record: " + ending.err);
  }
  std::vector<std::string> arguments() const {
    return {"--scenario",           scenario_, "--record-folder", folder_.path("rec"),
            "--record-reserve-mib", "0"};
  }

  TempFolder folder_;
  std::string scenario_ = folder_.write("small.yaml", small_scenario());
};

double phase(const Samples& samples, const std::string& name) {
  return samples.value("skerry_recorder_phase", {{"skerry_recorder_phase", name}});
}

// A counter lies between the status before and the status after.
void expect_between(const wire::Status& before, const Samples& samples, const wire::Status& after) {
  const auto between = [&](auto low, auto high, const std::string& name, const Json& labels) {
    const double value = samples.value(name, labels);
    EXPECT_GE(value, static_cast<double>(low)) << name << labels;
    EXPECT_LE(value, static_cast<double>(high)) << name << labels;
  };
  const Json none = Json::object();
  between(before.uptime_s(), after.uptime_s(), "skerry_uptime_seconds", none);
  between(before.scenario_s(), after.scenario_s(), "skerry_scenario_seconds", none);
  ASSERT_EQ(before.radars_size(), 3);
  for (int i = 0; i < before.radars_size(); ++i) {
    const wire::RadarStatus &low = before.radars(i), &high = after.radars(i);
    const Json radar = {{"radar", std::to_string(i)}, {"name", low.name()}};
    between(low.spokes(), high.spokes(), "skerry_radar_spokes_total", radar);
    between(low.spokes_late(), high.spokes_late(), "skerry_radar_spokes_late_total", radar);
    between(low.sectors_skipped(), high.sectors_skipped(), "skerry_radar_sectors_skipped_total",
            radar);
    between(low.scan(), high.scan(), "skerry_radar_turns_total", radar);
    between(low.lateness_max_ms() * 1e-3, high.lateness_max_ms() * 1e-3 + 1e-12,
            "skerry_radar_lateness_max_seconds", radar);
    between(low.board().triggers(), high.board().triggers(), "skerry_board_triggers_total", radar);
  }
  ASSERT_EQ(before.outputs_size(), 1);
  const wire::OutputStatus &low = before.outputs(0), &high = after.outputs(0);
  const Json output = {{"output", low.name()},
                       {"radar", "0"},
                       {"address", low.address()},
                       {"interface", low.interface_address()}};
  between(low.datagrams(), high.datagrams(), "skerry_output_datagrams_total", output);
  between(low.reports(), high.reports(), "skerry_output_reports_total", output);
  between(low.bytes(), high.bytes(), "skerry_output_sent_bytes_total", output);
  between(before.recorder().total_bytes(), after.recorder().total_bytes(),
          "skerry_recorder_written_bytes_total", none);
  between(before.recorder().file_bytes(), after.recorder().file_bytes(),
          "skerry_recorder_file_bytes", none);
  between(before.recorder().seconds(), after.recorder().seconds(),
          "skerry_recorder_recording_seconds", none);
  between(before.recorder().spokes(), after.recorder().spokes(), "skerry_recorder_spokes", none);
  between(before.recorder().spokes_lost(), after.recorder().spokes_lost(),
          "skerry_recorder_spokes_lost_total", none);
}

TEST_F(RunningMetrics, AreWhatTheStatusSaysWhileItRecords) {
  server::DisplaySocket plotter({}, ipv4(127, 0, 0, 1));
  std::vector<std::string> all = arguments();
  all.insert(all.end(), {"--output", "nmea0183:port=" + std::to_string(plotter.port())});
  RunningServer server(all);

  client::SpokeClient console = subscribed(server, 0);
  record(server, {"start", "a"});
  record(server, {"mark", "collision"});
  await_status(console, [](const wire::Status& now) {
    return now.recorder().spokes() > 0 && now.recorder().marks() == 1 &&
           now.recorder().free_bytes() > 0 &&
           now.outputs(0).reports() + now.outputs(0).datagrams() > 0;
  });
  EXPECT_THAT(server::http_exchange(server.http_port(),
                                    "GET /metrics HTTP/1.1\r\nHost: evil.example\r\n\r\n"),
              testing::StartsWith("HTTP/1.1 403 "));

  const wire::Status before = status(server);
  const Samples open = metrics(server, kOpenMetrics), plain = metrics(server, kPrometheus);
  const wire::Status after = status(server);
  expect_between(before, open, after);
  expect_between(before, plain, after);

  // The later page has all of the other's samples, and nothing that grows has become less.
  for (const auto& [key, sample] : open.all()) {
    ASSERT_TRUE(plain.all().contains(key)) << key;
    const Json& later = plain.all().at(key);
    EXPECT_EQ(sample.at("help"), later.at("help"));
    if (sample.at("type") == "counter") {
      EXPECT_EQ(later.at("type"), "counter") << key;
      EXPECT_TRUE(sample.at("sample").get<std::string>().ends_with("_total")) << key;
      EXPECT_LE(sample.at("value"), later.at("value")) << key;
    }
  }
  EXPECT_EQ(open.of("skerry_uptime_seconds").at("unit"), "seconds");
  EXPECT_EQ(open.of("skerry_recorder_written_bytes_total").at("unit"), "bytes");
  EXPECT_EQ(open.of("skerry_recorder_phase", {{"skerry_recorder_phase", "off"}}).at("type"),
            "stateset");
  EXPECT_TRUE(open.has("skerry_server_info",
                       {{"server", before.server()}, {"scenario", before.scenario()}}));
  EXPECT_EQ(open.value("skerry_errors_total", {{"kind", "http refused"}}), 1);
  EXPECT_EQ(phase(open, "recording"), 1);
  EXPECT_EQ(phase(open, "off") + phase(open, "disk_full") + phase(open, "failed"), 0);
  EXPECT_GT(open.value("skerry_recorder_free_bytes"), 0);
  EXPECT_EQ(open.value("skerry_recorder_marks_total"), 1);
  EXPECT_GT(open.value("skerry_resident_memory_bytes"), 1 << 20);
  // The console, and what `skerry` asked with and left again.
  const Json tcp = {{"transport", "tcp"}};
  EXPECT_GE(open.value("skerry_clients", tcp), 1);
  EXPECT_GE(open.value("skerry_client_connections_total", tcp), 4);
  EXPECT_GE(open.value("skerry_client_spokes_sent_total", tcp), before.clients(0).spokes_sent());
  EXPECT_EQ(open.value("skerry_metrics_left_out"), 0);

  record(server, {"stop"});
  const Samples ended = metrics(server, kOpenMetrics);
  const wire::RecorderState recorder = status(server).recorder();
  EXPECT_EQ(phase(ended, "off"), 1);
  EXPECT_EQ(ended.value("skerry_recorder_file_bytes"), recorder.file_bytes());
  EXPECT_EQ(ended.value("skerry_recorder_written_bytes_total"), recorder.total_bytes());
  EXPECT_GT(ended.value("skerry_recorder_free_bytes"), 0);
  EXPECT_EQ(ended.value("skerry_recorder_bytes_per_second"), 0);
  EXPECT_EQ(ended.value("skerry_recorder_recording_seconds"), recorder.seconds());
  EXPECT_EQ(ended.value("skerry_recorder_spokes"), recorder.spokes());
  EXPECT_EQ(ended.value("skerry_recorder_spokes_lost_total"), recorder.spokes_lost());
}

TEST_F(RunningMetrics, SayWhatIsPlayed) {
  {
    RunningServer server(arguments());
    client::SpokeClient console = connected(server);
    record(server, {"start", "a"});
    await_status(console, [](const wire::Status& now) { return now.recorder().spokes() > 600; });
    record(server, {"stop"});
  }
  RunningServer server({"--play", folder_.path("rec/a.mcap"), "--play-paused", "--record-folder",
                        folder_.path("again")});
  const wire::PlaybackState playback = status(server).playback();
  const Samples samples = metrics(server, kOpenMetrics);
  EXPECT_EQ(samples.value("skerry_playback_playing"), 0);
  EXPECT_EQ(samples.value("skerry_playback_rate_ratio"), 1);
  EXPECT_GT(samples.value("skerry_playback_length_seconds"), 0);
  EXPECT_DOUBLE_EQ(samples.value("skerry_playback_length_seconds"), playback.length_s());
  EXPECT_DOUBLE_EQ(samples.value("skerry_playback_position_seconds"), playback.position_s());
  EXPECT_FALSE(
      samples.has("skerry_board_triggers_total", {{"radar", "0"}, {"name", "Eight bits"}}));
  EXPECT_TRUE(samples.has("skerry_radar_spokes_total", {{"radar", "0"}, {"name", "Eight bits"}}));
}

}  // namespace
}  // namespace skerry::system_test
