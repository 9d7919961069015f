#include "server/plotter/judge/truth_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>

#include "server/plotter/judge/csv_rows.hpp"

namespace skerry::server {
namespace {

constexpr std::array<std::string_view, 4> kTruthColumns = {"utc_s", "id", "lat_deg", "lon_deg"};

template <typename Point>
void sort_by_time(std::vector<Point>& points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.utc_s < b.utc_s; });
}

}  // namespace

ReadTruth read_truth_csv(std::string_view text, std::string_view file) {
  CsvRows rows(text, file, kTruthColumns);
  const std::size_t utc = rows.column("utc_s"), id = rows.column("id");
  const std::size_t lat = rows.column("lat_deg"), lon = rows.column("lon_deg");
  const std::size_t course = rows.column("course_deg"), speed = rows.column("speed_kn");
  const std::size_t seen = rows.column("seen");
  ReadTruth out;
  std::map<std::string, std::size_t, std::less<>> numbers;
  std::size_t points = 0;
  while (rows.next()) {
    out.notes.line();
    TruthPoint point;
    const auto utc_s = rows.time(utc);
    const auto latitude = rows.number(lat, -90.0, 90.0);
    const auto longitude = rows.number(lon, -360.0, 360.0);
    point.course_deg = rows.number(course, -360.0, 360.0);
    point.speed_kn = rows.number(speed, 0.0, 1000.0);
    const auto look = rows.number(seen, 0.0, 1.0);
    const std::string_view name = rows.cell(id);
    if (!utc_s || !latitude || !longitude || name.empty() || !rows.wrong().empty()) {
      out.notes.leave_out("rows that cannot be read", rows.line(),
                          rows.wrong().empty() ? "a cell is empty" : rows.wrong());
      continue;
    }
    if (++points > kMostPoints) {
      out.notes.leave_out(fmt::format("rows beyond {}", kMostPoints), rows.line());
      continue;
    }
    point.utc_s = *utc_s;
    point.place = {*latitude, wrapped_longitude(*longitude)};
    if (name == "own") {
      out.truth.own_ship.push_back(point);
      out.notes.use();
      continue;
    }
    auto found = numbers.find(name);
    if (found == numbers.end()) {
      if (numbers.size() >= kMostTargets) {
        out.notes.leave_out(fmt::format("rows of targets beyond {}", kMostTargets), rows.line());
        continue;
      }
      found = numbers.emplace(name, out.truth.targets.size()).first;
      out.truth.targets.push_back({std::string(name), {}, {}});
    }
    TruthTarget& target = out.truth.targets[found->second];
    target.points.push_back(point);
    if (look) target.looks.push_back({point.utc_s, *look >= 0.5});
    out.notes.use();
  }
  if (out.truth.targets.empty())
    throw std::runtime_error(fmt::format(
        "{}:{}: no target; expected rows with utc_s,id,lat_deg,lon_deg of others than own ({})",
        file, rows.line(), out.notes.text()));
  for (TruthTarget& target : out.truth.targets) {
    sort_by_time(target.points);
    sort_by_time(target.looks);
  }
  sort_by_time(out.truth.own_ship);
  return out;
}

}  // namespace skerry::server
