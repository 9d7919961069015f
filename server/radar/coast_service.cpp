#include "server/radar/coast_service.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

namespace skerry::server {
namespace {

// The window read from the chart: a quarter more than the range and at least 12 NM, so that the own
// ship sails for a while before the chart is asked again.
Length window_radius(double range_m) {
  return metres(std::max(1.25 * range_m + echo::CoastPreparer::kMaxAnchorDistance,
                         nautical_miles(12.0).in_metres()));
}

double distance(PlanePoint a, PlanePoint b) {
  return std::hypot(a.east_m - b.east_m, a.north_m - b.north_m);
}

}  // namespace

double index_slack_for(double range_m, double speed_mps) {
  return std::max({10.0, range_m / 400.0, 4.0 * std::fabs(speed_mps)});
}

std::shared_ptr<const echo::StructureIndex> structures_in_sight(const echo::CoastPicture& picture,
                                                                PlanePoint own_ship,
                                                                double slack_m) {
  if (!picture.structures) return nullptr;
  return std::make_shared<const echo::StructureIndex>(picture.structures, own_ship, slack_m);
}

CoastService::CoastService(std::unique_ptr<const echo::ChartSource> chart, std::size_t radars,
                           const echo::CoastRules& rules)
    : chart_(std::move(chart)), rules_(rules) {
  for (std::size_t i = 0; i < radars; ++i) slots_.push_back(std::make_unique<Slot>());
}

CoastService::~CoastService() {
  if (thread_.joinable()) thread_.request_stop();
}

void CoastService::serve(Slot& slot, const CoastWish& wish) {
  const bool laid_anew =
      !slot.preparer || !slot.preparer->serves(wish.own_ship, wish.resolution.range_m);
  if (laid_anew) {
    slot.preparer = std::make_unique<echo::CoastPreparer>(
        chart_->load(wish.own_ship, window_radius(wish.resolution.range_m)), wish.own_ship, rules_);
  }
  // Half of the picture's slack is left for the way sailed until the next wish is served.
  CoastInSightPtr before = slot.in_sight.get();
  echo::CoastPicturePtr picture = before ? before->picture : nullptr;
  const bool fresh =
      picture && !laid_anew && wish.resolution == slot.made_for &&
      distance(picture->plane.to_plane(wish.own_ship), picture->centre) <= 0.5 * picture->slack_m;
  if (!fresh) picture = slot.preparer->prepare(wish.own_ship, wish.resolution);
  slot.made_for = wish.resolution;
  const PlanePoint own_ship = picture->plane.to_plane(wish.own_ship);
  const double slack = index_slack_for(wish.resolution.range_m, wish.speed_mps);
  slot.in_sight.set(
      CoastInSight{picture, std::make_shared<const echo::PolarIndex>(*picture, own_ship, slack),
                   structures_in_sight(*picture, own_ship, slack), own_ship, slack});
}

void CoastService::prepare_now(std::size_t radar, const CoastWish& wish) {
  serve(find(radar), wish);
}

std::size_t CoastService::add_slot() {
  const std::lock_guard lock(mutex_);
  slots_.push_back(std::make_unique<Slot>());
  return slots_.size() - 1;
}

CoastService::Slot& CoastService::find(std::size_t slot) const {
  const std::lock_guard lock(mutex_);
  return *slots_[slot];
}

void CoastService::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "coast");
    work(stop);
  });
}

void CoastService::ask(std::size_t slot, const CoastWish& wish) {
  {
    const std::lock_guard lock(mutex_);
    slots_[slot]->wish = wish;
  }
  wished_.notify_one();
}

void CoastService::work(const std::stop_token& stop) {
  const auto wishing = [this] {
    return std::find_if(slots_.begin(), slots_.end(),
                        [](const auto& slot) { return slot->wish.has_value(); });
  };
  std::unique_lock lock(mutex_);
  while (wished_.wait(lock, stop, [&] { return wishing() != slots_.end(); })) {
    Slot& slot = **wishing();
    const CoastWish wish = *slot.wish;
    slot.wish.reset();
    lock.unlock();
    try {
      serve(slot, wish);
    } catch (const std::exception& error) {
      // The chart went away under a running server: the radars keep the coast they have.
      spdlog::error("coast: {}", error.what());
    }
    lock.lock();
  }
}

}  // namespace skerry::server
