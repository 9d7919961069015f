#include "server/app/shore_thread.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/world/short_way.hpp"

namespace skerry::server {

ShoreThread::ShoreThread(Timeline& timeline, CoastService& coast, InputLog& inputs,
                         std::function<ScenarioTime()> now)
    : timeline_(timeline),
      inputs_(inputs),
      now_(std::move(now)),
      watch_(
          [&coast](GeoPoint centre, Length radius, ShoreWatch::SurveyDone done) {
            coast.survey(centre, radius, std::move(done));
          },
          [this](std::size_t own_ship, GeoPoint at) { ground(own_ship, at); }) {}

void ShoreThread::start() {
  thread_.start("shore", kPause, [this](const std::stop_token& stop) { look(stop); });
}

void ShoreThread::look(const std::stop_token& stop) {
  const ScenarioTime now = now_();
  // After a long halt of the machine: what is still kept.
  next_ = std::max(next_, now - World::kTick * static_cast<std::int64_t>(Timeline::kKept - 1));
  for (; next_ <= now && !stop.stop_requested(); next_ += World::kTick) {
    watch_.look(*timeline_.at(next_));
  }
}

void ShoreThread::ground(std::size_t own_ship, GeoPoint at) {
  // This thread is up to a quarter of a second late: an instructor may have put her elsewhere.
  const ShortWay since = short_way_between(at, timeline_.latest()->own_ships[own_ship].position);
  if (std::hypot(since.north_m, since.east_m) > ShoreWatch::kMostStep_m) return;
  wire::ExerciseOrder order;
  order.set_aground(static_cast<std::uint32_t>(own_ship));
  if (elsewhere_) return elsewhere_(order);
  const auto giving = inputs_.giving();
  const Timeline::ConOrdered ordered = timeline_.order(order, kBy);
  if (ordered.fault) return;
  inputs_.exercised(ordered.tick, order, kBy);
  spdlog::info("own ship {}: {} has run aground at the shore", own_ship,
               timeline_.latest()->own_ships[own_ship].name);
}

}  // namespace skerry::server
