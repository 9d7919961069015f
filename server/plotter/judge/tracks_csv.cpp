#include "server/plotter/judge/tracks_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "server/plotter/judge/csv_rows.hpp"

namespace skerry::server {
namespace {

constexpr std::array<std::string_view, 5> kTrackColumns = {"utc_s", "track", "status", "lat_deg",
                                                           "lon_deg"};
constexpr std::size_t kMostRadars = 64;

std::optional<ToldStatus> status_named(std::string_view text) {
  if (text == "tentative") return ToldStatus::tentative;
  if (text == "tracked") return ToldStatus::tracked;
  if (text == "lost") return ToldStatus::lost;
  return std::nullopt;
}

// By radar, then by number.
using TracksByName = std::map<std::string, std::map<std::string, ToldTrack>>;

std::vector<Told> sorted(TracksByName radars, std::string_view file) {
  std::vector<Told> out;
  for (auto& [radar, tracks] : radars) {
    Told& told = out.emplace_back();
    told.name = radars.size() > 1 ? fmt::format("{} ({})", file, radar) : std::string(file);
    for (auto& [number, track] : tracks) {
      std::stable_sort(track.points.begin(), track.points.end(),
                       [](const ToldPoint& a, const ToldPoint& b) { return a.utc_s < b.utc_s; });
      told.tracks.push_back(std::move(track));
    }
  }
  if (out.empty()) out.push_back({std::string(file), {}});
  return out;
}

}  // namespace

ReadTracks read_tracks_csv(std::string_view text, std::string_view file) {
  CsvRows rows(text, file, kTrackColumns);
  const std::size_t utc = rows.column("utc_s"), radar = rows.column("radar");
  const std::size_t number = rows.column("track"), status = rows.column("status");
  const std::size_t lat = rows.column("lat_deg"), lon = rows.column("lon_deg");
  const std::size_t course = rows.column("course_deg"), speed = rows.column("speed_kn");
  const std::size_t cpa = rows.column("cpa_nm"), tcpa = rows.column("tcpa_min");
  ReadTracks out;
  TracksByName radars;
  std::size_t points = 0, tracks = 0;
  while (rows.next()) {
    out.notes.line();
    ToldPoint point;
    const auto utc_s = rows.time(utc);
    const auto latitude = rows.number(lat, -90.0, 90.0);
    const auto longitude = rows.number(lon, -360.0, 360.0);
    point.course_deg = rows.number(course, -360.0, 360.0);
    point.speed_kn = rows.number(speed, 0.0, 1e6);
    point.cpa_nm = rows.number(cpa, 0.0, 1e5);
    point.tcpa_min = rows.number(tcpa, -1e6, 1e6);
    const auto told = status_named(rows.cell(status));
    if (!told) {
      out.notes.leave_out("rows with another status than tentative, tracked or lost", rows.line(),
                          rows.cell(status));
      continue;
    }
    if (!utc_s || !latitude || !longitude || rows.cell(number).empty() || !rows.wrong().empty()) {
      out.notes.leave_out("rows that cannot be read", rows.line(),
                          rows.wrong().empty() ? "a cell is empty" : rows.wrong());
      continue;
    }
    if (++points > kMostPoints) {
      out.notes.leave_out(fmt::format("rows beyond {}", kMostPoints), rows.line());
      continue;
    }
    point.utc_s = *utc_s;
    point.status = *told;
    point.place = {*latitude, wrapped_longitude(*longitude)};
    const std::string of_radar(rows.cell(radar)), of_track(rows.cell(number));
    if (radars.size() >= kMostRadars && !radars.contains(of_radar)) {
      out.notes.leave_out(fmt::format("rows of radars beyond {}", kMostRadars), rows.line());
      continue;
    }
    auto& mine = radars[of_radar];
    if (!mine.contains(of_track)) {
      if (++tracks > kMostTracks) {
        out.notes.leave_out(fmt::format("rows of tracks beyond {}", kMostTracks), rows.line());
        continue;
      }
      mine[of_track].number = of_track;
    }
    mine[of_track].points.push_back(point);
    out.notes.use();
  }
  out.told = sorted(std::move(radars), file);
  return out;
}

}  // namespace skerry::server
