#include "server/app/chart_desk.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

#include "server/app/coastline.hpp"

namespace skerry::server {

// `make` is called with the chart, on the coast service's thread.
template <typename Told, typename Make>
void ChartDesk::answer_with(std::function<void(ChartAnswer<Told>)> done, Make make) {
  coast_.look([done = std::move(done), make = std::move(make)](const echo::ChartSource* chart) {
    ChartAnswer<Told> answer = chart == nullptr ? NoChart::busy : NoChart::none_here;
    try {
      if (chart != nullptr) answer = make(*chart);
    } catch (const std::exception& error) {
      spdlog::error("chart: {}", error.what());
    }
    done(std::move(answer));
  });
}

void ChartDesk::answer(const wire::GetCoastline& place, RadarHost::CoastlineDone done) {
  answer_with(std::move(done), [place](const echo::ChartSource& chart) {
    const GeoPoint centre{place.latitude_deg(), place.longitude_deg()};
    return coastline_of(chart.load(centre, nautical_miles(place.radius_nm())), place);
  });
}

void ChartDesk::answer(const wire::GetChartObjects& place, RadarHost::ChartObjectsDone done) {
  answer_with(std::move(done), [place, maker = maker_](const echo::ChartSource& chart) {
    return maker->about(chart, place);
  });
}

}  // namespace skerry::server
