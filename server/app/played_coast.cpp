#include "server/app/played_coast.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "server/app/options/charts.hpp"
#include "server/replay/recorded_exercise.hpp"

namespace skerry::server {
namespace {

ChartFiles files_of(const recording::Summary& recorded, const ChartFiles& instead) {
  const auto named =
      std::find_if(recorded.attachments.begin(), recorded.attachments.end(),
                   [](const recording::Attachment& each) { return each.name == kChartsDocument; });
  return named == recorded.attachments.end() ? instead : recorded_charts(named->bytes, instead);
}

std::unique_ptr<const echo::ChartSource> chart_of(const recording::Summary& recorded,
                                                  const ChartFiles& instead) {
  try {
    const ChartFiles files = files_of(recorded, instead);
    return open_charts(files.charts, files.elevation);
  } catch (const std::exception& error) {
    spdlog::warn("instructors see the world's shoreline, not the exercise's charts: {}",
                 error.what());
  }
  try {
    return open_charts({}, {});
  } catch (const std::exception& error) {
    spdlog::warn("instructors see no shore: {}", error.what());
    return nullptr;
  }
}

}  // namespace

std::unique_ptr<PlayedCoast> PlayedCoast::of(PlaybackHost& playback, const ChartFiles& instead) {
  if (!playback.holds_truth()) return nullptr;
  auto chart = chart_of(playback.summary(), instead);
  if (chart == nullptr) return nullptr;
  return std::unique_ptr<PlayedCoast>(new PlayedCoast(playback, std::move(chart)));
}

PlayedCoast::PlayedCoast(PlaybackHost& playback, std::unique_ptr<const echo::ChartSource> chart)
    : coast_(std::move(chart), 0, echo::CoastRules{}) {
  playback.set_coastline([this](const wire::GetCoastline& place, RadarHost::CoastlineDone done) {
    chart_desk_.answer(place, std::move(done));
  });
  playback.set_chart_objects(
      [this](const wire::GetChartObjects& place, RadarHost::ChartObjectsDone done) {
        chart_desk_.answer(place, std::move(done));
      });
}

}  // namespace skerry::server
