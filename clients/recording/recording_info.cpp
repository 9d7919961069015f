#include "clients/recording/recording_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "clients/recording/position.hpp"
#include "protocol/picture/label_text.hpp"
#include "protocol/recording/topics.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using recording::RecordingReader;
using recording::Summary;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kInfoLooksEvery = 4096;  // items
constexpr std::size_t kMarksListed = 50;

std::string bytes_text(std::uint64_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (bytes < 10'000) return fmt::format("{} bytes", bytes);
  if (bytes < 10'000'000) return fmt::format("{:.1f} kB", value / 1e3);
  if (bytes < 10'000'000'000) return fmt::format("{:.1f} MB", value / 1e6);
  return fmt::format("{:.1f} GB", value / 1e9);
}

std::int64_t ns_of(UtcTime time) { return time.time_since_epoch().count(); }

std::string packing_text(const Summary& summary) {
  std::string text = summary.compression.empty() ? "none" : summary.compression;
  if (summary.compact) text += ", compact";
  if (summary.uncompressed_bytes > 0 && summary.file_bytes > 0) {
    text += fmt::format(", {:.1f} times smaller", static_cast<double>(summary.uncompressed_bytes) /
                                                      static_cast<double>(summary.file_bytes));
  }
  return text;
}

std::string radar_text(const wire::RadarInfo& info) {
  return fmt::format("  radar {:<3} {}, {} spokes of {} cells of {} bits, {:.1f} rpm{}\n",
                     info.radar(), printable(info.name(), 40), info.spokes_per_turn(), info.cells(),
                     info.bits(), info.rpm(),
                     info.set().empty() ? "" : ", " + printable(info.set(), 40));
}

std::string topic_text(const recording::Topic& topic, std::uint64_t count) {
  const recording::KindRow& row = recording::row_of(topic.kind);
  std::string of;
  if (row.scope != recording::Scope::recording) of += fmt::format(" of radar {}", topic.radar);
  if (row.scope == recording::Scope::view) of += fmt::format(" view {}", topic.view);
  return fmt::format("  {:>12} {}{}\n", count, row.title, of);
}

Json radar_json(const wire::RadarInfo& info) {
  return {{"radar", info.radar()},
          {"name", printable(info.name())},
          {"own_ship", printable(info.own_ship())},
          {"spokes_per_turn", info.spokes_per_turn()},
          {"cells", info.cells()},
          {"bits", info.bits()},
          {"rpm", info.rpm()},
          {"set", printable(info.set())}};
}

Json damage_json(const std::optional<recording::RecordingError>& damage) {
  if (!damage) return nullptr;
  return {{"offset", damage->offset}, {"text", printable(damage->text)}};
}

}  // namespace

Result<CheckReport, recording::RecordingError> check_recording(
    const RecordingReader& reader, const RecordingReader::Progress& progress) {
  const Summary& summary = reader.summary();
  CheckReport report;
  recording::ItemCursor cursor = reader.items();
  const double length_s = in_seconds(summary.end - summary.begin);
  while (const auto item = cursor.next()) {
    if (progress && report.items % kInfoLooksEvery == 0) {
      const double share = length_s > 0.0 ? in_seconds(item->time - summary.begin) / length_s : 0.0;
      if (!progress(share)) {
        return Failure{recording::RecordingError{summary.file, 0, "given up"}};
      }
    }
    ++report.items;
  }
  report.chunks_damaged = cursor.chunks_damaged();
  report.damage = cursor.damage();
  return report;
}

std::string info_text(const RecordingReader& reader, const std::optional<CheckReport>& check) {
  const Summary& summary = reader.summary();
  std::string out =
      fmt::format("{}: {}, {} chunks ({})\nfrom {} to {}, {} long\n", printable(summary.file),
                  bytes_text(summary.file_bytes), summary.chunks, packing_text(summary),
                  utc_text(summary.begin), utc_text(summary.end),
                  playing_time_text(summary.end - summary.begin));
  if (const auto hello = reader.hello()) {
    out += fmt::format(
        "made by {}{}\n", printable(hello->server()),
        hello->scenario().empty() ? "" : fmt::format(" of {}", printable(hello->scenario())));
    for (const auto& info : hello->radars()) out += radar_text(info);
  } else {
    out += "it does not say which radars it has\n";
  }
  out += "items:\n";
  for (const auto& [topic, count] : summary.items) out += topic_text(topic, count);
  if (!summary.marks.empty()) out += fmt::format("marks: {}\n", summary.marks.size());
  for (std::size_t i = 0; i < std::min(summary.marks.size(), kMarksListed); ++i) {
    out += fmt::format("  {:>12} {}\n", playing_time_text(summary.marks[i].time - summary.begin),
                       printable(summary.marks[i].name, 100));
  }
  if (summary.marks.size() > kMarksListed) {
    out += fmt::format("  and {} more\n", summary.marks.size() - kMarksListed);
  }
  if (!summary.attachments.empty()) out += "attachments:\n";
  for (const auto& each : summary.attachments) {
    out += fmt::format("  {} ({}), {}\n", printable(each.name, 100), printable(each.media_type, 60),
                       bytes_text(each.bytes.size()));
  }
  if (summary.damage) {
    out += fmt::format("damaged: {}\n  skerry recording repair makes a whole file of it\n",
                       printable(summary.damage->to_string()));
  }
  if (check) {
    out += check->chunks_damaged == 0
               ? fmt::format("checked: all {} items can be read\n", check->items)
               : fmt::format("checked: {} items can be read, {} chunks cannot{}\n", check->items,
                             check->chunks_damaged,
                             check->damage ? ": " + printable(check->damage->to_string()) : "");
  }
  return out;
}

std::string info_json(const RecordingReader& reader, const std::optional<CheckReport>& check) {
  const Summary& summary = reader.summary();
  Json out = {{"file", printable(summary.file)},
              {"file_bytes", summary.file_bytes},
              {"uncompressed_bytes", summary.uncompressed_bytes},
              {"chunks", summary.chunks},
              {"compression", summary.compression},
              {"compact", summary.compact},
              {"begin", utc_text(summary.begin)},
              {"begin_ns", ns_of(summary.begin)},
              {"end", utc_text(summary.end)},
              {"end_ns", ns_of(summary.end)},
              {"length_s", in_seconds(summary.end - summary.begin)}};
  out["radars"] = Json::array();
  if (const auto hello = reader.hello()) {
    out["server"] = printable(hello->server());
    out["scenario"] = printable(hello->scenario());
    for (const auto& info : hello->radars()) out["radars"].push_back(radar_json(info));
  }
  out["items"] = Json::array();
  for (const auto& [topic, count] : summary.items) {
    out["items"].push_back({{"kind", recording::row_of(topic.kind).title},
                            {"radar", topic.radar},
                            {"view", topic.view},
                            {"count", count}});
  }
  out["marks"] = Json::array();
  for (const auto& mark : summary.marks) {
    out["marks"].push_back(
        {{"position_s", in_seconds(mark.time - summary.begin)}, {"name", printable(mark.name)}});
  }
  out["attachments"] = Json::array();
  for (const auto& each : summary.attachments) {
    out["attachments"].push_back({{"name", printable(each.name)},
                                  {"media_type", printable(each.media_type)},
                                  {"bytes", each.bytes.size()}});
  }
  out["damage"] = damage_json(summary.damage);
  if (check) {
    out["check"] = {{"items", check->items},
                    {"chunks_damaged", check->chunks_damaged},
                    {"damage", damage_json(check->damage)}};
  }
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace skerry::client
