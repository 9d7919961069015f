// ChartDesk: answers what consoles ask of the chart.
#pragma once

#include <memory>

#include "server/app/chart_objects.hpp"
#include "server/core/radar_host.hpp"
#include "server/radar/coast_service.hpp"

namespace skerry::server {

// The work is done on the coast service's thread, after the radars' own.
// Thread: any.
class ChartDesk {
 public:
  // The service must outlive the desk; answers that are under way outlive both.
  explicit ChartDesk(CoastService& coast) : coast_(coast) {}

  // `done` is called as RadarHost::find_chart_objects() says.
  void answer(const wire::GetChartObjects& place, RadarHost::ChartObjectsDone done);

 private:
  CoastService& coast_;
  std::shared_ptr<ChartObjectsMaker> maker_ = std::make_shared<ChartObjectsMaker>();
};

}  // namespace skerry::server
