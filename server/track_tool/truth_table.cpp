#include "server/track_tool/truth_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "server/relayed/values_in_range.hpp"
#include "server/track_tool/track_writer.hpp"

namespace skerry::server {
namespace {

using recording::Kind;

bool carries(const wire::ExerciseShip& ship, std::optional<std::uint32_t> radar) {
  if (!ship.own()) return false;
  if (!radar) return true;
  return std::find(ship.radars().begin(), ship.radars().end(), *radar) != ship.radars().end();
}

// RFC 4180.
std::string cell_of(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

}  // namespace

TruthTable::TruthTable(std::optional<std::uint32_t> radar, Sink sink)
    : radar_(radar), sink_(std::move(sink)) {
  sink_("utc_s,id,lat_deg,lon_deg,course_deg,speed_kn\n");
}

void TruthTable::add(UtcTime utc, const wire::ExerciseState& state) {
  ++states_;
  // "own" is nobody's name but hers.
  std::map<std::string_view, int> named = {{"", 2}, {"own", 2}};
  for (const wire::ExerciseShip& ship : state.ships()) ++named[ship.name()];
  const auto own = std::find_if(state.ships().begin(), state.ships().end(),
                                [&](const auto& ship) { return carries(ship, radar_); });
  const std::string time = time_text(utc, {});
  for (auto ship = state.ships().begin(); ship != state.ships().end(); ++ship) {
    if (ship->removed()) continue;
    std::string id = ship->name();
    if (ship == own) {
      id = "own";
    } else if (named[ship->name()] > 1) {
      id += fmt::format("{}#{}", id.empty() ? "" : " ", ship->number());
    }
    sink_(fmt::format("{},{},{:.7f},{:.7f},{},{:.2f}\n", time, cell_of(id), ship->latitude_deg(),
                      ship->longitude_deg(), degrees_text(ship->course_over_ground_deg()),
                      ship->speed_kn()));
  }
}

std::uint64_t write_truth(const recording::RecordingReader& reader,
                          std::optional<std::uint32_t> radar, const TruthTable::Sink& sink) {
  const std::string& file = reader.summary().file;
  TruthTable table(radar, sink);
  recording::ItemCursor cursor = reader.items({{Kind::exercise}});
  bool carried = false;
  while (const auto item = cursor.next()) {
    wire::ExerciseState state;
    if (!state.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) continue;
    bring_into_range(state);
    carried = carried || std::any_of(state.ships().begin(), state.ships().end(),
                                     [&](const auto& ship) { return carries(ship, radar); });
    table.add(item->time, state);
  }
  if (table.states() == 0) {
    throw std::runtime_error(
        fmt::format("{}: it holds no state of an exercise: it is of a real radar, or was made "
                    "without the exercise's truth",
                    file));
  }
  if (radar && !carried) {
    throw std::runtime_error(fmt::format("{}: no own ship has radar {} aboard", file, *radar));
  }
  return table.states();
}

}  // namespace skerry::server
