#include "server/app/exercise_files.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "echo/chart/gshhg_reader.hpp"
#include "protocol/digest/digest.hpp"
#include "server/app/control/control_ranges.hpp"
#include "server/app/options/coast_rules.hpp"
#include "server/app/options/radar_config.hpp"
#include "server/config/yaml_include.hpp"
#include "server/config/yaml_message.hpp"
#include "server/replay/recorded_exercise.hpp"
#include "server/world/scenario.hpp"
#include "server/world/shipped_exercises.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kSample = 1 << 20;

// Size, first and last MiB: a chart that was changed by hand or replaced shows, and half a gigabyte
// is not read at every start.
std::uintmax_t add_file(const fs::path& path, Sha256& digest) {
  std::ifstream file(path, std::ios::binary);
  const std::uintmax_t size = fs::file_size(path);
  digest.add(fmt::format("{}\n", size));
  std::string sample(std::min(size, kSample), '\0');
  for (const std::uintmax_t at : {std::uintmax_t{0}, size - sample.size()}) {
    file.seekg(static_cast<std::streamoff>(at));
    file.read(sample.data(), static_cast<std::streamsize>(sample.size()));
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
    digest.add(sample);
  }
  return size;
}

// A file, or all files of a folder in the order of their names.
Json identity_of(const std::string& path) {
  std::vector<fs::path> files;
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
  } else {
    files.emplace_back(path);
  }
  Sha256 digest;
  std::uintmax_t bytes = 0;
  for (const fs::path& file : files) {
    digest.add(file.filename().string() + "\n");
    bytes += add_file(file, digest);
  }
  return {{"path", path}, {"bytes", bytes}, {"digest", hexadecimal(digest.take())}};
}

// The same of a chart that a server has opened; what of it cannot be read is no reason not to sail.
Json told_identity_of(const std::string& path) {
  try {
    return identity_of(path);
  } catch (const std::exception& error) {
    spdlog::warn("recordings will not know the chart {} again: {}", path, error.what());
    return {{"path", path}};
  }
}

std::string finest_world() {
  try {
    return echo::GshhgReader::find_finest().string();
  } catch (const std::runtime_error&) {
    return {};
  }
}

// The path recorded, or the one in its place, if that is the file it was.
std::string same_file(const Json& recorded, const std::string& instead) {
  const std::string path = instead.empty() ? recorded.at("path").get<std::string>() : instead;
  std::error_code ignored;
  if (path.empty() || !fs::exists(path, ignored)) {
    throw std::runtime_error(fmt::format(
        "the exercise's chart {} is not here; name where it lies now with --chart or --elevation",
        path));
  }
  if (recorded.contains("digest") && identity_of(path).at("digest") != recorded.at("digest")) {
    throw std::runtime_error(fmt::format(
        "chart {} is not the one of the exercise ({} bytes, digest {}); name that with "
        "--chart or --elevation",
        path, recorded.at("bytes").get<std::uint64_t>(), recorded.at("digest").get<std::string>()));
  }
  return path;
}

void set_number(YamlNode& map, const std::string& key, std::uint64_t value) {
  YamlNode number{YamlNode::Kind::plain, {}, fmt::format("{}", value), {}, {}};
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i].text != key) continue;
    map.items[i] = std::move(number);
    return;
  }
  if (map.kind != YamlNode::Kind::map) return;
  map.keys.push_back({YamlNode::Kind::plain, {}, key, {}, {}});
  map.items.push_back(std::move(number));
}

scenario::Scenario checked(scenario::Scenario scenario, YamlSource& source) {
  check_coast(scenario, source);
  check_locks(scenario, source);
  source.require_sound();
  return scenario;
}

}  // namespace

ScenarioFile open_scenario(const std::string& path, std::optional<std::uint64_t> seed) {
  const std::string file = find_scenario(path);
  YamlSource source(path.empty() ? "built-in bergen.yaml" : file);
  std::string text = path.empty() ? default_scenario_yaml() : read_yaml_file(file);
  YamlNode root = parse_yaml_whole(text, source);
  if (seed) set_number(root, "seed", *seed);
  scenario::Scenario scenario = checked(read_scenario(root, source), source);
  if (source.file_count() == 1 && !seed) return {std::move(text), std::move(scenario)};
  return {yaml_text(root), std::move(scenario)};
}

scenario::Scenario exercise_scenario(const std::string& yaml, const std::string& file_name) {
  YamlSource source(file_name);
  return checked(read_scenario(yaml, source), source);
}

std::vector<ExerciseDocument> exercise_documents(const std::string& scenario_yaml,
                                                 const ChartFiles& files) {
  Json json;
  json["charts"] = Json::array();
  for (const std::string& chart : files.charts) json["charts"].push_back(told_identity_of(chart));
  if (!files.elevation.empty()) json["elevation"] = told_identity_of(files.elevation);
  if (const std::string world = finest_world(); !world.empty()) {
    json["world"] = told_identity_of(world);
  }
  return {{kScenarioDocument, "application/yaml", scenario_yaml},
          {kChartsDocument, "application/json", json.dump(1) + "\n"}};
}

std::vector<std::string> exercise_digests(const std::string& scenario_yaml,
                                          const ChartFiles& files) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& what, const std::string& digest) {
    lines.push_back(what + " " + digest.substr(0, 16));
  };
  Sha256 sha;
  sha.add(std::string_view(scenario_yaml));
  add("scenario", hexadecimal(sha.take()));
  const Json charts = Json::parse(exercise_documents(scenario_yaml, files).back().bytes);
  const auto add_chart = [&](const std::string& what, const Json& chart) {
    add(what, chart.value("digest", "that cannot be read"));
  };
  for (const Json& chart : charts["charts"]) add_chart("chart", chart);
  for (const char* const what : {"elevation", "world"}) {
    if (charts.contains(what)) add_chart(what, charts[what]);
  }
  return lines;
}

ChartFiles recorded_charts(const std::string& charts_json, const ChartFiles& instead) {
  ChartFiles files;
  try {
    const Json json = Json::parse(charts_json);
    const Json& charts = json.at("charts");
    if (!instead.charts.empty() && instead.charts.size() != charts.size()) {
      throw std::runtime_error(fmt::format("the exercise has {} charts, --chart names {}",
                                           charts.size(), instead.charts.size()));
    }
    for (std::size_t i = 0; i < charts.size(); ++i) {
      files.charts.push_back(
          same_file(charts[i], instead.charts.empty() ? std::string() : instead.charts[i]));
    }
    if (json.contains("elevation"))
      files.elevation = same_file(json["elevation"], instead.elevation);
    if (json.contains("world")) same_file(json["world"], finest_world());
  } catch (const nlohmann::json::exception& wrong) {
    throw std::runtime_error(
        fmt::format("the recording's {} makes no sense: {}", kChartsDocument, wrong.what()));
  }
  return files;
}

ExercisePlan exercise_plan(const std::string& scenario_yaml, const std::string& file_name) {
  return exercise_plan(exercise_scenario(scenario_yaml, file_name));
}

ExercisePlan exercise_plan(scenario::Scenario scenario) {
  ExercisePlan plan;
  plan.scenario = std::move(scenario);
  for (int i = 0; i < plan.scenario.own_ships_size(); ++i) {
    for (const scenario::Radar& radar : plan.scenario.own_ships(i).radars()) {
      plan.radars.push_back(radar_config(radar, static_cast<std::uint32_t>(plan.radars.size()),
                                         static_cast<std::size_t>(i), plan.scenario.seed()));
    }
  }
  plan.coast = coast_rules(plan.scenario);
  plan.in_range = [](const wire::Set& set) { return !refusal_of(set); };
  return plan;
}

}  // namespace skerry::server
