#include "server/playback/recorded_radars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "protocol/recording/topics.hpp"
#include "protocol/video/scan_geometry.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/relayed/sendable_text.hpp"
#include "server/relayed/values_in_range.hpp"

namespace skerry::server {
namespace {

using recording::Kind;

constexpr double kUsualRpm = 24.0, kSlowest = 5.0;
constexpr int kSpokesLookedAt = 64;  // for one that can be read
constexpr auto kRpmSpan = std::chrono::milliseconds(500);

// Turns a minute between two spokes some time apart; 0 where they do not tell.
double rpm_between(const SpokeHeader& first, const SpokeHeader& last) {
  const double seconds = in_seconds(last.utc - first.utc);
  const double turns =
      (static_cast<double>(last.index) - first.index) / first.geometry.spokes_per_turn +
      static_cast<double>(static_cast<std::int32_t>(last.scan - first.scan));
  if (!(seconds > 0.0) || !(turns > 0.0)) return 0.0;
  const double rpm = turns / seconds * 60.0;
  return rpm >= kSlowest && rpm <= 60.0 ? rpm : 0.0;
}

// Geometry of the first spoke that can be read, and where it is missing the rate of turn.
void ask_spokes(const recording::RecordingReader& reader, const RecordedRadar& radar,
                wire::RadarInfo& info) {
  const bool wants_rpm = !(info.rpm() >= kSlowest);
  auto cursor = reader.items({{Kind::spoke, radar.recorded, radar.shared_view()}});
  std::optional<SpokeHeader> first;
  wire::Spoke message;
  for (int unreadable = 0; unreadable < kSpokesLookedAt;) {
    const auto item = cursor.next();
    if (!item) break;
    const bool parsed =
        message.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()));
    const auto spoke = from_message(message);
    if (!parsed || !spoke) {
      ++unreadable;
      continue;
    }
    if (!first) {
      first = spoke->header;
      info.set_spokes_per_turn(first->geometry.spokes_per_turn);
      info.set_cells(first->geometry.cells);
      info.set_bits(first->geometry.bits);
      if (!wants_rpm) break;
    } else if (spoke->header.utc - first->utc >= kRpmSpan) {
      info.set_rpm(rpm_between(*first, spoke->header));
      break;
    }
  }
}

wire::RadarInfo info_of(const recording::RecordingReader& reader, const RecordedRadar& radar,
                        const std::optional<wire::Hello>& hello) {
  wire::RadarInfo info;
  if (hello) {
    const auto said =
        std::find_if(hello->radars().begin(), hello->radars().end(),
                     [&](const wire::RadarInfo& each) { return each.radar() == radar.recorded; });
    if (said != hello->radars().end()) info = *said;
  }
  bring_into_range(info);
  info.set_board(false);
  ask_spokes(reader, radar, info);
  const ScanGeometry geometry{info.spokes_per_turn(), info.cells(), info.bits()};
  if (!geometry.valid()) {
    info.set_spokes_per_turn(ScanGeometry{}.spokes_per_turn);
    info.set_cells(ScanGeometry{}.cells);
    info.set_bits(ScanGeometry{}.bits);
  }
  if (!(info.rpm() >= kSlowest)) info.set_rpm(kUsualRpm);
  if (info.name().empty()) info.set_name(fmt::format("radar {}", radar.recorded));
  return info;
}

}  // namespace

Result<RecordedRadars, std::string> radars_of(const recording::RecordingReader& reader) {
  const recording::Summary& summary = reader.summary();
  std::map<std::uint32_t, std::set<std::uint32_t>> views;  // with spokes, by radar
  for (const auto& [topic, count] : summary.items) {
    if (!is_of_a_radar(topic.kind) || count == 0) continue;
    auto& of_radar = views[topic.radar];
    if (topic.kind == Kind::spoke) of_radar.insert(topic.view);
  }
  RecordedRadars out;
  const std::optional<wire::Hello> hello = reader.hello();
  if (hello) out.scenario = sendable(hello->scenario(), kLongestText);
  std::size_t left_out = 0, all_views = 0;
  for (const auto& [recorded, of_radar] : views) {
    if (out.radars.size() == RecordedRadars::kMaxRadars) {
      ++left_out;
      continue;
    }
    RecordedRadar radar;
    radar.recorded = recorded;
    for (const std::uint32_t view : of_radar) {
      const bool fits = radar.views.size() < RecordedRadars::kMaxViews &&
                        all_views < RecordedRadars::kMaxAllViews && view <= 65'535;
      fits ? radar.views.push_back(view) : void(++left_out);
      all_views += fits;
    }
    radar.info = info_of(reader, radar, hello);
    const auto number = static_cast<std::uint32_t>(out.radars.size());
    radar.info.set_radar(number);
    out.played[recorded] = number;
    out.radars.push_back(std::move(radar));
  }
  if (left_out > 0) {
    out.problem =
        fmt::format("{} radars or views more than a playback can have are left out", left_out);
  }
  const bool has_video =
      std::any_of(out.radars.begin(), out.radars.end(),
                  [](const RecordedRadar& radar) { return !radar.views.empty(); });
  if (!has_video) {
    const bool has_inputs = summary.items.contains({Kind::input});
    return Failure{fmt::format("{}: there are no spokes in it to play{}{}{}{}", summary.file,
                               has_inputs ? "; of its inputs skerryd --verify FILE --video OUT "
                                            "makes the video, skerry exercise report a debrief"
                                          : "",
                               out.problem.empty() ? "" : "; ", out.problem,
                               summary.damage ? "; " + summary.damage->to_string() : "")};
  }
  return out;
}

std::vector<recording::Topic> played_topics(const recording::Summary& summary,
                                            const RecordedRadars& radars) {
  std::vector<recording::Topic> topics;
  for (const auto& [topic, count] : summary.items) {
    if (!recording::row_of(topic.kind).is_played) continue;
    if (!is_of_a_radar(topic.kind)) topics.push_back(topic);
    const auto played = radars.played.find(topic.radar);
    if (!is_of_a_radar(topic.kind) || played == radars.played.end()) continue;
    const auto& views = radars.radars[played->second].views;
    const bool known = std::find(views.begin(), views.end(), topic.view) != views.end();
    const bool of_radar = topic.kind != Kind::spoke && topic.view == 0;
    if (known || of_radar) topics.push_back(topic);
  }
  return topics;
}

}  // namespace skerry::server
