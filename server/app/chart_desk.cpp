#include "server/app/chart_desk.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <optional>
#include <utility>

namespace skerry::server {

void ChartDesk::answer(const wire::GetChartObjects& place, RadarHost::ChartObjectsDone done) {
  coast_.look([place, maker = maker_, done = std::move(done)](const echo::ChartSource* chart) {
    std::optional<wire::ChartObjects> objects;
    try {
      if (chart != nullptr) objects = maker->about(*chart, place);
    } catch (const std::exception& error) {
      spdlog::error("chart: {}", error.what());
    }
    done(std::move(objects));
  });
}

}  // namespace skerry::server
