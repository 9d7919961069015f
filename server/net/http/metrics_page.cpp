#include "server/net/http/metrics_page.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace skerry::server {
namespace {

constexpr MetricKind kGauge = MetricKind::gauge;
constexpr MetricKind kCounter = MetricKind::counter;

constexpr double kMebibyte = 1024.0 * 1024.0;

// A family, and what each row has in it; nothing: it has none.
template <typename Source>
struct MetricColumn {
  std::string_view name;
  MetricKind kind;
  std::string_view help;
  std::optional<MetricValue> (*value)(const Source&);
};

// Whatever has the same labels.
template <typename Source>
using MetricRows = std::vector<std::pair<std::string, const Source*>>;

template <typename Source, std::size_t N>
void add_columns(MetricsText& text, const std::array<MetricColumn<Source>, N>& columns,
                 const MetricRows<Source>& rows) {
  for (const auto& column : columns) {
    text.family(column.name, column.kind, column.help);
    for (const auto& [labels, source] : rows) {
      if (const auto value = column.value(*source)) text.add(labels, *value);
    }
  }
}

MetricValue count_of(std::uint64_t count) { return count; }
MetricValue flag_of(bool flag) { return std::uint64_t{flag}; }

using ServerColumn = MetricColumn<wire::Status>;
constexpr auto kServerColumns = std::to_array<ServerColumn>({
    {"skerry_uptime_seconds", kGauge, "Time since the server started.",
     [](const auto& server) { return std::optional<MetricValue>(server.uptime_s()); }},
    {"skerry_resident_memory_bytes", kGauge, "Resident memory of the server.",
     [](const auto& server) {
       return std::optional<MetricValue>(server.resident_mib() * kMebibyte);
     }},
    {"skerry_scenario_seconds", kGauge,
     "Time since the scenario, or the recording that is played, began.",
     [](const auto& server) { return std::optional<MetricValue>(server.scenario_s()); }},
});

using RecorderColumn = MetricColumn<wire::RecorderState>;
constexpr auto kRecorderColumns = std::to_array<RecorderColumn>({
    {"skerry_recorder_file_bytes", kGauge, "Size of the file that is being written, or was last.",
     [](const auto& recorder) { return std::optional(count_of(recorder.file_bytes())); }},
    {"skerry_recorder_written_bytes", kCounter,
     "Written into all files of a recording; begins again with the next one.",
     [](const auto& recorder) { return std::optional(count_of(recorder.total_bytes())); }},
    {"skerry_recorder_bytes_per_second", kGauge, "Rate of writing a recording, lately.",
     [](const auto& recorder) { return std::optional<MetricValue>(recorder.bytes_per_second()); }},
    // While nobody has looked at the disk, 0 would be an alarm.
    {"skerry_recorder_free_bytes", kGauge,
     "Free on the disk of recordings, when last looked at; absent while nobody has.",
     [](const auto& recorder) {
       const bool looked =
           recorder.free_bytes() > 0 || recorder.phase() == wire::RecorderState::DISK_FULL;
       return looked ? std::optional(count_of(recorder.free_bytes())) : std::nullopt;
     }},
    {"skerry_recorder_recording_seconds", kGauge, "Length of the recording.",
     [](const auto& recorder) { return std::optional<MetricValue>(recorder.seconds()); }},
    // No counter: what the disk refuses a second later is taken off again.
    {"skerry_recorder_spokes", kGauge, "Spokes in the recording.",
     [](const auto& recorder) { return std::optional(count_of(recorder.spokes())); }},
    {"skerry_recorder_spokes_lost", kCounter,
     "Spokes missing in the recording: overwritten before they were taken, or without room on the "
     "disk; begins again with the next one.",
     [](const auto& recorder) { return std::optional(count_of(recorder.spokes_lost())); }},
    {"skerry_recorder_marks", kCounter, "Marks in the recording; begins again with the next one.",
     [](const auto& recorder) { return std::optional(count_of(recorder.marks())); }},
});

using PlaybackColumn = MetricColumn<wire::PlaybackState>;
constexpr auto kPlaybackColumns = std::to_array<PlaybackColumn>({
    {"skerry_playback_playing", kGauge, "1: the playback runs; 0: it stands still.",
     [](const auto& playback) { return std::optional(flag_of(playback.playing())); }},
    {"skerry_playback_rate_ratio", kGauge, "Pace asked for, over that of the recording.",
     [](const auto& playback) { return std::optional<MetricValue>(playback.rate()); }},
    {"skerry_playback_position_seconds", kGauge,
     "Place of the playback, since the begin of the recording.",
     [](const auto& playback) { return std::optional<MetricValue>(playback.position_s()); }},
    {"skerry_playback_length_seconds", kGauge, "Length of the recording that is played.",
     [](const auto& playback) { return std::optional<MetricValue>(playback.length_s()); }},
    {"skerry_playback_loop", kGauge, "1: the playback begins again at its end.",
     [](const auto& playback) { return std::optional(flag_of(playback.loop())); }},
});

using RadarColumn = MetricColumn<wire::RadarStatus>;
constexpr auto kRadarColumns = std::to_array<RadarColumn>({
    {"skerry_radar_spokes", kCounter, "Spokes published.",
     [](const auto& radar) { return std::optional(count_of(radar.spokes())); }},
    {"skerry_radar_spokes_late", kCounter, "Spokes published more than a sector after their time.",
     [](const auto& radar) { return std::optional(count_of(radar.spokes_late())); }},
    {"skerry_radar_sectors_skipped", kCounter, "Sectors never made because the radar was too late.",
     [](const auto& radar) { return std::optional(count_of(radar.sectors_skipped())); }},
    {"skerry_radar_turns", kCounter, "Turns of the antenna, relative to the bow.",
     [](const auto& radar) { return std::optional(count_of(radar.scan())); }},
    {"skerry_radar_lateness_max_seconds", kGauge, "How late the latest of all sectors was.",
     [](const auto& radar) { return std::optional<MetricValue>(radar.lateness_max_ms() * 1e-3); }},
    {"skerry_radar_render_cell_seconds", kGauge, "Time to make one cell, mean of the last second.",
     [](const auto& radar) {
       return std::optional<MetricValue>(radar.render_ns_per_cell() * 1e-9);
     }},
    {"skerry_radar_coast_edges", kGauge, "Edges of the coast as the radar has it.",
     [](const auto& radar) { return std::optional(count_of(radar.coast_edges())); }},
    {"skerry_radar_transmitting", kGauge, "1: the radar is on the air; 0: standby.",
     [](const auto& radar) { return std::optional(flag_of(!radar.settings().standby())); }},
    {"skerry_radar_views", kGauge, "Views that are open, the one that all share among them.",
     [](const auto& radar) {
       return std::optional(count_of(1 + static_cast<std::uint64_t>(radar.views_size())));
     }},
});

using BoardColumn = MetricColumn<wire::BoardState>;
constexpr auto kBoardColumns = std::to_array<BoardColumn>({
    {"skerry_board_triggers", kCounter, "Triggers of the interface board.",
     [](const auto& board) { return std::optional(count_of(board.triggers())); }},
    {"skerry_board_sweeps", kCounter, "Sweeps made by the interface board.",
     [](const auto& board) { return std::optional(count_of(board.sweeps())); }},
    {"skerry_board_sweeps_late", kCounter, "Sweeps left out because the board was too far behind.",
     [](const auto& board) { return std::optional(count_of(board.sweeps_late())); }},
    {"skerry_board_records", kCounter, "Records published by the interface board.",
     [](const auto& board) { return std::optional(count_of(board.records())); }},
    {"skerry_board_sweep_cpu_seconds", kGauge, "Processor time of a sweep, mean.",
     [](const auto& board) { return std::optional<MetricValue>(board.sweep_us() * 1e-6); }},
    {"skerry_board_faults", kGauge, "Bits set in the FAULTS register of the interface board.",
     [](const auto& board) {
       return std::optional(count_of(static_cast<std::uint64_t>(std::popcount(board.faults()))));
     }},
});

using ClientColumn = MetricColumn<ClientTotals>;
constexpr auto kClientColumns = std::to_array<ClientColumn>({
    {"skerry_clients", kGauge, "Clients connected, and destinations of datagrams.",
     [](const auto& clients) { return std::optional(count_of(clients.connected)); }},
    {"skerry_client_connections", kCounter, "Clients since the start.",
     [](const auto& clients) { return std::optional(count_of(clients.connections)); }},
    {"skerry_client_spokes_sent", kCounter, "Spokes sent to clients since the start.",
     [](const auto& clients) { return std::optional(count_of(clients.spokes_sent)); }},
    {"skerry_client_spokes_lost", kCounter, "Spokes overwritten before their client took them.",
     [](const auto& clients) { return std::optional(count_of(clients.spokes_lost)); }},
    {"skerry_client_sent_bytes", kCounter, "Sent to clients since the start.",
     [](const auto& clients) { return std::optional(count_of(clients.bytes_sent)); }},
});

struct OutputTotals {
  std::uint64_t datagrams = 0, reports = 0, bytes = 0, spokes_lost = 0, unsent = 0;
  std::uint64_t commands = 0, refused = 0, dropped = 0;
};
using OutputColumn = MetricColumn<OutputTotals>;
constexpr auto kOutputColumns = std::to_array<OutputColumn>({
    {"skerry_output_datagrams", kCounter, "Datagrams of the picture sent.",
     [](const auto& output) { return std::optional(count_of(output.datagrams)); }},
    {"skerry_output_datagrams_unsent", kCounter,
     "Datagrams of the picture not taken by the system, or too late.",
     [](const auto& output) { return std::optional(count_of(output.unsent)); }},
    {"skerry_output_reports", kCounter, "Other datagrams sent.",
     [](const auto& output) { return std::optional(count_of(output.reports)); }},
    {"skerry_output_sent_bytes", kCounter, "Sent in datagrams of the picture and others.",
     [](const auto& output) { return std::optional(count_of(output.bytes)); }},
    {"skerry_output_spokes_lost", kCounter, "Spokes overwritten before the output took them.",
     [](const auto& output) { return std::optional(count_of(output.spokes_lost)); }},
    {"skerry_output_commands", kCounter, "Datagrams received from displays.",
     [](const auto& output) { return std::optional(count_of(output.commands)); }},
    {"skerry_output_commands_refused", kCounter,
     "Datagrams from displays not understood or not obeyed.",
     [](const auto& output) { return std::optional(count_of(output.refused)); }},
    {"skerry_output_commands_dropped", kCounter,
     "Datagrams from displays not looked at, because there were too many.",
     [](const auto& output) { return std::optional(count_of(output.dropped)); }},
});

using HopColumn = MetricColumn<wire::HopStatus>;
constexpr auto kHopColumns = std::to_array<HopColumn>({
    {"skerry_relay_connected", kGauge, "1: the server that is relayed is there; 0: it is not.",
     [](const auto& hop) { return std::optional(flag_of(hop.connected())); }},
    {"skerry_relay_since_seconds", kGauge, "How long it has been there, or not.",
     [](const auto& hop) { return std::optional<MetricValue>(hop.since_s()); }},
    {"skerry_relay_spokes", kCounter, "Spokes that came from it.",
     [](const auto& hop) { return std::optional(count_of(hop.spokes())); }},
    {"skerry_relay_spokes_lost", kCounter, "Spokes missing between those that came.",
     [](const auto& hop) { return std::optional(count_of(hop.spokes_lost())); }},
    {"skerry_relay_received_bytes", kCounter, "Received from it.",
     [](const auto& hop) { return std::optional(count_of(hop.bytes())); }},
    {"skerry_relay_round_trip_seconds", kGauge,
     "From a request to its answer, median of the last five; absent: not measured.",
     [](const auto& hop) {
       return hop.has_round_trip_ms() ? std::optional<MetricValue>(hop.round_trip_ms() * 1e-3)
                                      : std::nullopt;
     }},
    {"skerry_relay_reconnects", kCounter, "How often it was there again.",
     [](const auto& hop) { return std::optional(count_of(hop.reconnects())); }},
    {"skerry_relay_requests", kCounter, "Requests of consoles passed on to it.",
     [](const auto& hop) { return std::optional(count_of(hop.requests())); }},
    {"skerry_relay_requests_refused", kCounter,
     "Of these, refused by it, or because it was not there.",
     [](const auto& hop) { return std::optional(count_of(hop.requests_refused())); }},
});

void add_errors(MetricsText& text, const wire::Status& status) {
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [kind, times] : status.errors())
    counts[metric_labels({{"kind", kind}})] += times;
  text.family("skerry_errors", kCounter, "Errors by kind, since the start.");
  for (const auto& [labels, times] : counts) text.add(labels, times);
}

void add_recorder(MetricsText& text, const wire::RecorderState& recorder) {
  constexpr std::string_view kPhase = "skerry_recorder_phase";
  constexpr std::array<std::pair<wire::RecorderState::Phase, std::string_view>, 4> kPhases = {{
      {wire::RecorderState::OFF, "off"},
      {wire::RecorderState::RECORDING, "recording"},
      {wire::RecorderState::DISK_FULL, "disk_full"},
      {wire::RecorderState::FAILED, "failed"},
  }};
  text.family(kPhase, MetricKind::state_set, "1: the phase that the recorder is in.");
  for (const auto& [phase, name] : kPhases) {
    text.add(metric_labels({{kPhase, name}}), flag_of(recorder.phase() == phase));
  }
  add_columns(text, kRecorderColumns, {{"", &recorder}});
}

void add_radars(MetricsText& text, const wire::Status& status) {
  MetricRows<wire::RadarStatus> radars;
  MetricRows<wire::BoardState> boards;
  for (const auto& radar : status.radars()) {
    const std::string labels =
        metric_labels({{"radar", fmt::to_string(radar.radar())}, {"name", radar.name()}});
    radars.emplace_back(labels, &radar);
    if (radar.has_board()) boards.emplace_back(labels, &radar.board());
  }
  add_columns(text, kRadarColumns, radars);
  // No counter: a view that ends takes its spokes along.
  text.family("skerry_radar_encoded_spokes", kGauge,
              "Spokes encoded of the views that are open, by format.");
  for (const auto& radar : status.radars()) {
    const std::string number = fmt::to_string(radar.radar());
    const std::map<std::string, std::uint64_t> encodes(radar.encodes().begin(),
                                                       radar.encodes().end());
    for (const auto& [format, spokes] : encodes) {
      text.add(metric_labels({{"radar", number}, {"name", radar.name()}, {"format", format}}),
               spokes);
    }
  }
  add_columns(text, kBoardColumns, boards);
}

// Those that have all labels in common are one to a reader.
void add_outputs(MetricsText& text, const wire::Status& status) {
  std::map<std::string, OutputTotals> outputs;
  for (const wire::OutputStatus& output : status.outputs()) {
    OutputTotals& sum = outputs[metric_labels({{"output", output.name()},
                                               {"radar", fmt::to_string(output.radar())},
                                               {"address", output.address()},
                                               {"interface", output.interface_address()}})];
    sum.datagrams += output.datagrams();
    sum.unsent += output.datagrams_unsent();
    sum.reports += output.reports();
    sum.bytes += output.bytes();
    sum.spokes_lost += output.spokes_lost();
    sum.commands += output.commands();
    sum.refused += output.commands_refused();
    sum.dropped += output.commands_dropped();
  }
  MetricRows<OutputTotals> rows;
  for (const auto& [labels, sum] : outputs) rows.emplace_back(labels, &sum);
  add_columns(text, kOutputColumns, rows);
}

// Of a relay alone.
void add_hops(MetricsText& text, const wire::Status& status) {
  MetricRows<wire::HopStatus> rows;
  for (const wire::HopStatus& hop : status.hops()) {
    rows.emplace_back(
        metric_labels({{"hop", fmt::to_string(rows.size() + 1)}, {"upstream", hop.upstream()}}),
        &hop);
  }
  if (!rows.empty()) add_columns(text, kHopColumns, rows);
}

}  // namespace

std::string metrics_page(const wire::Status& status, const ClientTotalsByTransport& clients,
                         MetricsFormat format) {
  MetricsText text(format);
  text.family("skerry_server", MetricKind::info, "The program and what it shows.");
  text.add(metric_labels({{"server", status.server()}, {"scenario", status.scenario()}}),
           count_of(1));
  add_columns(text, kServerColumns, {{"", &status}});
  add_errors(text, status);
  if (status.has_recorder()) add_recorder(text, status.recorder());
  if (status.has_playback()) add_columns(text, kPlaybackColumns, {{"", &status.playback()}});
  add_radars(text, status);
  MetricRows<ClientTotals> rows;
  for (const auto& [transport, totals] : clients) {
    rows.emplace_back(metric_labels({{"transport", transport}}), &totals);
  }
  add_columns(text, kClientColumns, rows);
  add_outputs(text, status);
  add_hops(text, status);
  return std::move(text).finish();
}

}  // namespace skerry::server
