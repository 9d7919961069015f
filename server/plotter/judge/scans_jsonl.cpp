#include "server/plotter/judge/scans_jsonl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "protocol/signalk/json.hpp"
#include "server/plotter/judge/place_series.hpp"

namespace skerry::server {
namespace {

using signalk::Json;

constexpr double kMostCoordinate_m = 400'000.0;

// [north, east].
std::optional<PlanePoint> north_east(const Json* value) {
  if (value == nullptr || !value->is_array() || value->size() != 2) return std::nullopt;
  const Json &north = (*value)[0], &east = (*value)[1];
  if (!north.is_number() || !east.is_number()) return std::nullopt;
  const PlanePoint point{east.get<double>(), north.get<double>()};
  if (!(std::fabs(point.east_m) <= kMostCoordinate_m) ||
      !(std::fabs(point.north_m) <= kMostCoordinate_m))
    return std::nullopt;
  return point;
}

std::optional<double> time_member(const Json& object) {
  const Json* time = signalk::member(object, "time");
  if (time == nullptr || !time->is_number()) return std::nullopt;
  const double utc_s = time->get<double>();
  return std::fabs(utc_s) < 1e11 ? std::optional(utc_s) : std::nullopt;
}

std::string id_of(const Json& target) {
  const Json* id = signalk::member(target, "id");
  if (id == nullptr) return {};
  if (id->is_number_integer()) return fmt::format("{}", id->get<std::int64_t>());
  return id->is_string() ? id->get<std::string>() : std::string();
}

class ScanReader {
 public:
  explicit ScanReader(GeoPoint origin) : plane_(origin) {}

  void line(std::string_view text, std::size_t number) {
    if (text.empty()) return;
    out_.notes.line();
    const auto json = signalk::read_json(text);
    if (!json || !json->is_object())
      return leave_out("lines that are no JSON object", number, text);
    const auto utc_s = time_member(*json);
    const auto own = north_east(signalk::member(*json, "own_north_east"));
    if (!utc_s || !own) return leave_out("lines without time or own_north_east", number, text);
    if (out_.scans.size() >= kMostScans) return leave_out("scans beyond the most", number, {});
    DetectionScan scan{*utc_s, plane_.to_geo(*own), {}};
    const Json* plots = signalk::member(*json, "plots");
    if (plots == nullptr || !plots->is_array())
      return leave_out("lines without plots", number, text);
    for (const Json& each : *plots) {
      const auto plot = north_east(&each);
      if (!plot || scan.plots.size() >= kMostScanPlots) {
        leave_out("plots that are not [north, east]", number, {});
        continue;
      }
      scan.plots.push_back(*plot);
    }
    out_.scans.push_back(std::move(scan));
    const Json* targets = signalk::member(*json, "targets");
    if (targets != nullptr && targets->is_array())
      for (const Json& each : *targets) target(each, number);
    out_.notes.use();
  }

  ReadScans finish(std::string_view file) {
    if (out_.scans.empty())
      throw std::runtime_error(
          fmt::format("{}:1: no scan; expected lines like {{\"time\": 1620114893.0, "
                      "\"own_north_east\": [0, 0], \"plots\": [[10, 20]], \"targets\": []}} ({})",
                      file, out_.notes.text()));
    std::stable_sort(
        out_.scans.begin(), out_.scans.end(),
        [](const DetectionScan& a, const DetectionScan& b) { return a.utc_s < b.utc_s; });
    for (const DetectionScan& scan : out_.scans)
      out_.truth.own_ship.push_back({scan.utc_s, scan.own_ship, {}, {}});
    for (auto& [id, points] : targets_) {
      TruthTarget& target = out_.truth.targets.emplace_back();
      target.id = id;
      target.points = std::move(points);
      std::stable_sort(target.points.begin(), target.points.end(),
                       [](const TruthPoint& a, const TruthPoint& b) { return a.utc_s < b.utc_s; });
      look(target);
    }
    return std::move(out_);
  }

 private:
  void leave_out(std::string_view kind, std::size_t line, std::string_view detail) {
    out_.notes.leave_out(kind, line, detail);
  }

  void target(const Json& json, std::size_t number) {
    const auto utc_s = time_member(json);
    const auto place = north_east(signalk::member(json, "north_east"));
    const std::string id = id_of(json);
    if (!utc_s || !place || id.empty() ||
        (targets_.size() >= kMostTargets && !targets_.contains(id)))
      return leave_out("targets without id, time or north_east", number, {});
    targets_[id].push_back({*utc_s, plane_.to_geo(*place), {}, {}});
  }

  // A scan looked for the target where its truth was then.
  void look(TruthTarget& target) const {
    const TruthSeries series(target.points, plane_);
    for (const DetectionScan& scan : out_.scans) {
      const auto now = series.at(scan.utc_s);
      if (!now) continue;
      const PlanePoint own = plane_.to_plane(scan.own_ship);
      const bool seen = std::any_of(scan.plots.begin(), scan.plots.end(), [&](PlanePoint plot) {
        return length_of(own + plot - now->place) <= kSeen_m;
      });
      target.looks.push_back({scan.utc_s, seen});
    }
  }

  echo::LocalPlane plane_;
  std::map<std::string, std::vector<TruthPoint>> targets_;
  ReadScans out_;
};

}  // namespace

ReadScans read_scans_jsonl(std::string_view text, std::string_view file, const ScansRule& rule) {
  ScanReader reader(rule.origin);
  for_each_line(text,
                [&](std::string_view line, std::size_t number) { reader.line(line, number); });
  return reader.finish(file);
}

}  // namespace skerry::server
