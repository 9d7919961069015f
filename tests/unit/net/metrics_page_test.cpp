// The parts of a status message that stand at /metrics, and those that do not.
#include "server/net/http/metrics_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

namespace skerry::server {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string page_of(const wire::Status& status, const ClientTotalsByTransport& clients = {}) {
  return metrics_page(status, clients, MetricsFormat::openmetrics);
}

// The sample's value; it must be there once; "none" if it is not there.
std::string value_of(const std::string& page, const std::string& sample) {
  std::istringstream lines(page);
  std::string found = "none";
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(sample + " ")) continue;
    EXPECT_EQ(found, "none") << sample << " is there twice";
    found = line.substr(sample.size() + 1);
  }
  return found;
}

wire::Status full_status() {
  wire::Status status;
  status.set_server("skerryd 0.1.0");
  status.set_scenario("Two \"ferries\"");
  status.set_uptime_s(12.5);
  status.set_scenario_s(3600.25);
  status.set_resident_mib(160.5);
  (*status.mutable_errors())["tcp accept"] = 3;
  (*status.mutable_errors())["a \\ b\n"] = 4;
  for (std::uint32_t number : {0u, 1u}) {
    wire::RadarStatus& radar = *status.add_radars();
    radar.set_radar(number);
    radar.set_name("X-band");
    radar.set_spokes(1000 + number);
    radar.set_spokes_late(5);
    radar.set_sectors_skipped(6);
    radar.set_scan(7);
    radar.set_lateness_max_ms(250);
    radar.set_render_ns_per_cell(2);
    radar.set_coast_edges(112'090);
    radar.mutable_settings()->set_standby(number == 1);
    (*radar.mutable_encodes())["native"] = 900;
    (*radar.mutable_encodes())["cat240"] = 100;
  }
  status.mutable_radars(0)->add_views();
  wire::BoardState& board = *status.mutable_radars(0)->mutable_board();
  board.set_triggers(40);
  board.set_sweeps(30);
  board.set_sweeps_late(10);
  board.set_records(31);
  board.set_faults(0b1010);
  board.set_sweep_us(12.5);
  board.set_ring_name("/skerry-board-7410-0");
  return status;
}

TEST(MetricsPage, HasServerErrorsRadarsAndBoards) {
  const std::string page = page_of(full_status());
  EXPECT_EQ(value_of(page,
                     "skerry_server_info{server=\"skerryd 0.1.0\",scenario=\"Two "
                     "\\\"ferries\\\"\"}"),
            "1");
  EXPECT_EQ(value_of(page, "skerry_uptime_seconds"), "12.5");
  EXPECT_EQ(value_of(page, "skerry_scenario_seconds"), "3600.25");
  EXPECT_EQ(std::stod(value_of(page, "skerry_resident_memory_bytes")), 160.5 * 1024 * 1024);
  EXPECT_EQ(value_of(page, "skerry_errors_total{kind=\"tcp accept\"}"), "3");
  EXPECT_EQ(value_of(page, R"(skerry_errors_total{kind="a \\ b\n"})"), "4");
  const std::string first = "{radar=\"0\",name=\"X-band\"}",
                    second = "{radar=\"1\",name=\"X-band\"}";
  EXPECT_EQ(value_of(page, "skerry_radar_spokes_total" + first), "1000");
  EXPECT_EQ(value_of(page, "skerry_radar_spokes_total" + second), "1001");
  EXPECT_EQ(value_of(page, "skerry_radar_spokes_late_total" + first), "5");
  EXPECT_EQ(value_of(page, "skerry_radar_sectors_skipped_total" + first), "6");
  EXPECT_EQ(value_of(page, "skerry_radar_turns_total" + first), "7");
  EXPECT_EQ(value_of(page, "skerry_radar_lateness_max_seconds" + first), "0.25");
  EXPECT_EQ(std::stod(value_of(page, "skerry_radar_render_cell_seconds" + first)), 2 * 1e-9);
  EXPECT_EQ(value_of(page, "skerry_radar_coast_edges" + first), "112090");
  EXPECT_EQ(value_of(page, "skerry_radar_transmitting" + first), "1");
  EXPECT_EQ(value_of(page, "skerry_radar_transmitting" + second), "0");
  EXPECT_EQ(value_of(page, "skerry_radar_views" + first), "2");
  EXPECT_EQ(value_of(page,
                     "skerry_radar_encoded_spokes"
                     "{radar=\"1\",name=\"X-band\",format=\"cat240\"}"),
            "100");
  EXPECT_EQ(value_of(page, "skerry_board_triggers_total" + first), "40");
  EXPECT_EQ(value_of(page, "skerry_board_sweeps_total" + first), "30");
  EXPECT_EQ(value_of(page, "skerry_board_sweeps_late_total" + first), "10");
  EXPECT_EQ(value_of(page, "skerry_board_records_total" + first), "31");
  EXPECT_EQ(value_of(page, "skerry_board_faults" + first), "2");
  EXPECT_EQ(std::stod(value_of(page, "skerry_board_sweep_cpu_seconds" + first)), 12.5 * 1e-6);
  EXPECT_EQ(value_of(page, "skerry_board_triggers_total" + second), "none");
}

TEST(MetricsPage, HasNothingOfWhatTheStatusDoesNotHave) {
  for (const auto format : {MetricsFormat::prometheus, MetricsFormat::openmetrics}) {
    const std::string page = metrics_page({}, {}, format);
    for (const char* absent :
         {"recorder", "playback", "radar_", "board", "client", "output", "errors"}) {
      EXPECT_THAT(page, Not(HasSubstr(absent)));
    }
    EXPECT_EQ(value_of(page, "skerry_uptime_seconds"), "0");
  }
}

TEST(MetricsPage, HasTheRecorder) {
  wire::Status status;
  wire::RecorderState& recorder = *status.mutable_recorder();
  recorder.set_phase(wire::RecorderState::DISK_FULL);
  recorder.set_file("watch 3.mcap");
  recorder.set_folder("watches/recordings");
  recorder.set_problem("no room in watches/recordings");
  recorder.set_file_bytes(100);
  recorder.set_total_bytes(5'000'000'000);
  recorder.set_seconds(61.5);
  recorder.set_bytes_per_second(8.5e6);
  recorder.set_spokes(1'000'000);
  recorder.set_spokes_lost(17);
  recorder.set_marks(2);
  std::string page = page_of(status);
  const auto phase = [&](const std::string& name) {
    return value_of(page, "skerry_recorder_phase{skerry_recorder_phase=\"" + name + "\"}");
  };
  EXPECT_EQ(phase("off") + phase("recording") + phase("disk_full") + phase("failed"), "0010");
  EXPECT_EQ(value_of(page, "skerry_recorder_file_bytes"), "100");
  EXPECT_EQ(value_of(page, "skerry_recorder_written_bytes_total"), "5000000000");
  EXPECT_EQ(value_of(page, "skerry_recorder_recording_seconds"), "61.5");
  EXPECT_EQ(std::stod(value_of(page, "skerry_recorder_bytes_per_second")), 8.5e6);
  EXPECT_EQ(value_of(page, "skerry_recorder_spokes"), "1000000");
  EXPECT_EQ(value_of(page, "skerry_recorder_spokes_lost_total"), "17");
  EXPECT_EQ(value_of(page, "skerry_recorder_marks_total"), "2");
  EXPECT_EQ(value_of(page, "skerry_recorder_free_bytes"), "0") << "the disk is full";
  EXPECT_THAT(page, Not(HasSubstr("watches"))) << "where files lie";
  EXPECT_THAT(page, Not(HasSubstr("watch 3")));

  recorder.set_phase(wire::RecorderState::OFF);
  page = page_of(status);
  EXPECT_EQ(phase("off") + phase("recording") + phase("disk_full") + phase("failed"), "1000");
  EXPECT_EQ(value_of(page, "skerry_recorder_free_bytes"), "none") << "nobody has looked yet";
  recorder.set_free_bytes(12'345);
  EXPECT_EQ(value_of(page_of(status), "skerry_recorder_free_bytes"), "12345");
}

TEST(MetricsPage, HasThePlayback) {
  wire::Status status;
  wire::PlaybackState& playback = *status.mutable_playback();
  playback.set_file("storm.mcap");
  playback.set_playing(true);
  playback.set_rate(2.5);
  playback.set_position_s(90);
  playback.set_length_s(1800);
  const std::string page = page_of(status);
  EXPECT_EQ(value_of(page, "skerry_playback_playing"), "1");
  EXPECT_EQ(value_of(page, "skerry_playback_rate_ratio"), "2.5");
  EXPECT_EQ(value_of(page, "skerry_playback_position_seconds"), "90");
  EXPECT_EQ(value_of(page, "skerry_playback_length_seconds"), "1800");
  EXPECT_EQ(value_of(page, "skerry_playback_loop"), "0");
  EXPECT_THAT(page, Not(HasSubstr("storm")));
}

TEST(MetricsPage, HasClientsByTransportAndNobodysAddress) {
  wire::Status status;
  wire::ClientStatus& client = *status.add_clients();
  client.set_transport("tcp");
  client.set_peer("192.0.2.7:50714");
  const std::string page =
      page_of(status, {{"tcp", {1, 2, 3, 4, 5}}, {"websocket", {0, 1, 10, 0, 20}}});
  EXPECT_EQ(value_of(page, "skerry_clients{transport=\"tcp\"}"), "1");
  EXPECT_EQ(value_of(page, "skerry_client_connections_total{transport=\"tcp\"}"), "2");
  EXPECT_EQ(value_of(page, "skerry_client_spokes_sent_total{transport=\"tcp\"}"), "3");
  EXPECT_EQ(value_of(page, "skerry_client_spokes_lost_total{transport=\"tcp\"}"), "4");
  EXPECT_EQ(value_of(page, "skerry_client_sent_bytes_total{transport=\"tcp\"}"), "5");
  EXPECT_EQ(value_of(page, "skerry_clients{transport=\"websocket\"}"), "0");
  EXPECT_THAT(page, Not(HasSubstr("192.0.2.7")));
}

TEST(MetricsPage, HasOutputsAndThoseThatLookAlikeAsOne) {
  wire::Status status;
  for (const char* interface_address : {"127.0.0.2", "127.0.0.1", "127.0.0.2"}) {
    wire::OutputStatus& output = *status.add_outputs();
    output.set_name("garmin_xhd");
    output.set_radar(1);
    output.set_address("239.254.2.0:50102");
    output.set_interface_address(interface_address);
    output.set_datagrams(1);
    output.set_reports(2);
    output.set_bytes(3);
    output.set_spokes_lost(4);
    output.set_datagrams_unsent(5);
    output.set_commands(6);
    output.set_commands_refused(7);
    output.set_commands_dropped(8);
    output.set_last_display("192.0.2.9:50100");
  }
  const std::string page = page_of(status);
  const std::string labels =
      "{output=\"garmin_xhd\",radar=\"1\",address=\"239.254.2.0:50102\",interface=\"127.0.0.1\"}";
  EXPECT_EQ(value_of(page, "skerry_output_datagrams_total" + labels), "1");
  EXPECT_EQ(value_of(page, "skerry_output_reports_total" + labels), "2");
  EXPECT_EQ(value_of(page, "skerry_output_sent_bytes_total" + labels), "3");
  EXPECT_EQ(value_of(page, "skerry_output_spokes_lost_total" + labels), "4");
  EXPECT_EQ(value_of(page, "skerry_output_datagrams_unsent_total" + labels), "5");
  EXPECT_EQ(value_of(page, "skerry_output_commands_total" + labels), "6");
  EXPECT_EQ(value_of(page, "skerry_output_commands_refused_total" + labels), "7");
  EXPECT_EQ(value_of(page, "skerry_output_commands_dropped_total" + labels), "8");
  std::string twice = labels;
  twice.replace(twice.find("127.0.0.1"), 9, "127.0.0.2");
  EXPECT_EQ(value_of(page, "skerry_output_commands_total" + twice), "12");
  EXPECT_THAT(page, Not(HasSubstr("192.0.2.9"))) << "the last display";
}

TEST(MetricsPage, HasTheHopsOfARelay) {
  wire::Status status;
  EXPECT_THAT(page_of(status), Not(HasSubstr("skerry_relayed")));
  for (const char* upstream : {"192.0.2.7:7410", "192.0.2.8:7410"}) {
    wire::HopStatus& hop = *status.add_hops();
    hop.set_upstream(upstream);
    hop.set_connected(true);
    hop.set_spokes_lost(5);
  }
  status.mutable_hops(0)->set_round_trip_ms(12);
  const std::string page = page_of(status);
  const std::string near = "{hop=\"1\",upstream=\"192.0.2.7:7410\"}",
                    far = "{hop=\"2\",upstream=\"192.0.2.8:7410\"}";
  EXPECT_EQ(value_of(page, "skerry_relay_connected" + near), "1");
  EXPECT_EQ(value_of(page, "skerry_relay_spokes_lost_total" + far), "5");
  EXPECT_EQ(value_of(page, "skerry_relay_round_trip_seconds" + near), "0.012");
  EXPECT_THAT(page, Not(HasSubstr("skerry_relay_round_trip_seconds" + far)));
}

// Both formats want all of a family in one place, and no sample twice.
TEST(MetricsPage, FamiliesStandTogether) {
  wire::Status status = full_status();
  status.mutable_recorder();
  status.mutable_playback();
  const std::string long_kind(300, 'k');
  (*status.mutable_errors())[long_kind + "a"] = 1;
  (*status.mutable_errors())[long_kind + "b"] = 2;
  for (const auto format : {MetricsFormat::prometheus, MetricsFormat::openmetrics}) {
    std::istringstream page(metrics_page(status, {{"tcp", {}}, {"udp", {}}}, format));
    std::set<std::string> families, samples;
    std::string family;
    for (std::string line; std::getline(page, line) && line != "# EOF";) {
      if (line.starts_with("# ")) {
        const auto begin = line.find(' ', 2) + 1;
        const std::string name = line.substr(begin, line.find(' ', begin) - begin);
        if (name == family) continue;
        EXPECT_TRUE(families.insert(name).second) << name << " begins again";
        family = name;
      } else {
        EXPECT_TRUE(line.starts_with(family)) << line << " in " << family;
        EXPECT_TRUE(samples.insert(line.substr(0, line.rfind(' '))).second) << line;
      }
    }
    EXPECT_GT(families.size(), 30u);
    EXPECT_TRUE(samples.contains("skerry_errors_total" + metric_labels({{"kind", long_kind}})));
  }
}

}  // namespace
}  // namespace skerry::server
