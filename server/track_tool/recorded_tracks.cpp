#include "server/track_tool/recorded_tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "server/relayed/values_in_range.hpp"

namespace skerry::server {
namespace {

using recording::Kind;

TrackRow row_of(const wire::Target& target, const wire::TargetList& list) {
  TrackRow row;
  row.status = target.state() == wire::TARGET_LOST ? TrackStatus::lost : TrackStatus::tracked;
  row.place = {target.latitude_deg(), target.longitude_deg()};
  if (target.has_course_deg()) row.course_deg = target.course_deg();
  if (target.has_speed_kn()) row.speed_kn = target.speed_kn();
  row.range_m = target.range_m();
  row.bearing_deg = target.bearing_deg();
  if (target.has_cpa_nm()) row.cpa_nm = target.cpa_nm();
  if (target.has_tcpa_min()) row.tcpa_min = target.tcpa_min();
  row.place_sigma_m = target.place_sigma_m();
  row.hits = target.hits();
  row.looks = target.looks();
  row.by_hand = target.by_hand();
  row.own_ship = {list.own_latitude_deg(), list.own_longitude_deg()};
  return row;
}

}  // namespace

void RecordedTracks::add(UtcTime time, const wire::TargetList& list) {
  ++lists_;
  if (list.plots() < plots_) base_ = greatest_;  // another plotter
  plots_ = list.plots();
  const auto told = std::min(
      list.utc_ns(), static_cast<std::uint64_t>(recording::kLatestTime.time_since_epoch().count()));
  const Duration since =
      told != 0 ? Duration(static_cast<std::int64_t>(told)) : time.time_since_epoch();
  for (const wire::Target& target : list.targets()) {
    if (target.is_test() || target.number() == 0) continue;
    if (target.number() > std::numeric_limits<std::uint32_t>::max() - base_) continue;
    TrackRow row = row_of(target, list);
    row.since = since;
    row.number = base_ + target.number();
    greatest_ = std::max(greatest_, row.number);
    const bool is_lost = row.status == TrackStatus::lost;
    // It is told until a mariner has acknowledged it.
    if (std::exchange(lost_[row.number], is_lost) && is_lost) continue;
    table_.row(row);
  }
}

recording::Topic chosen_lists(const recording::RecordingReader& reader,
                              const RecordedChoice& choice) {
  const recording::Summary& summary = reader.summary();
  std::string there;
  for (const auto& [topic, count] : summary.items) {  // in the order of radars and views
    if (topic.kind != Kind::targets || count == 0) continue;
    if (choice.radar.value_or(topic.radar) == topic.radar &&
        choice.view.value_or(topic.view) == topic.view) {
      return topic;
    }
    there += fmt::format("{} radar {} view {}", there.empty() ? "" : ",", topic.radar, topic.view);
  }
  throw std::runtime_error(
      there.empty()
          ? fmt::format("{}: it holds no lists of targets: nobody aboard looked for any, or it is "
                        "from before they were recorded",
                        summary.file)
          : fmt::format("{}: it has no lists of such a radar and view; there are those of{}",
                        summary.file, there));
}

ListsTaken write_recorded(const recording::RecordingReader& reader, const recording::Topic& topic,
                          TableWriter& table) {
  RecordedTracks tracks(table);
  ListsTaken taken;
  recording::ItemCursor cursor = reader.items({topic});
  while (const auto item = cursor.next()) {
    wire::TargetList list;
    if (!list.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) {
      ++taken.refused;
      continue;
    }
    bring_into_range(list);
    taken.by_water = taken.by_water || list.stabilisation() == wire::STABILISATION_WATER;
    tracks.add(item->time, list);
  }
  table.finish();
  taken.lists = tracks.lists();
  taken.targets = tracks.targets();
  taken.chunks = cursor.chunks_damaged();
  return taken;
}

}  // namespace skerry::server
