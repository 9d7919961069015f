// ChartDesk: answers what consoles ask of the chart.
#pragma once

#include <functional>
#include <memory>

#include "server/app/chart_objects.hpp"
#include "server/core/radar_host.hpp"
#include "server/radar/coast_service.hpp"

namespace skerry::server {

// The work is done on the coast service's thread, after all that the simulation itself asks of it.
// Thread: any.
class ChartDesk {
 public:
  // The service must outlive the desk; answers that are under way outlive both.
  explicit ChartDesk(CoastService& coast) : coast_(coast) {}

  // `done` is called as RadarHost::find_coastline() and find_chart_objects() say.
  void answer(const wire::GetCoastline& place, RadarHost::CoastlineDone done);
  void answer(const wire::GetChartObjects& place, RadarHost::ChartObjectsDone done);

 private:
  template <typename Told, typename Make>
  void answer_with(std::function<void(ChartAnswer<Told>)> done, Make make);

  CoastService& coast_;
  std::shared_ptr<ChartObjectsMaker> maker_ = std::make_shared<ChartObjectsMaker>();
};

}  // namespace skerry::server
