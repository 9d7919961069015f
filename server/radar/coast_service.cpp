#include "server/radar/coast_service.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace skerry::server {
namespace {

// The window read from the chart: a quarter more than the range and at least 12 NM, so that the own
// ship sails for a while before the chart is asked again.
Length window_radius(double range_m) {
  return metres(std::max(1.25 * range_m + echo::CoastPreparer::kMaxAnchorDistance,
                         nautical_miles(12.0).in_metres()));
}

}  // namespace

CoastService::CoastService(echo::GshhgReader reader, std::size_t radars, std::uint64_t seed)
    : reader_(std::move(reader)), seed_(seed) {
  for (std::size_t i = 0; i < radars; ++i) slots_.push_back(std::make_unique<Slot>());
}

CoastService::~CoastService() {
  if (thread_.joinable()) thread_.request_stop();
}

void CoastService::serve(Slot& slot, const CoastWish& wish) {
  if (!slot.preparer || !slot.preparer->serves(wish.own_ship, wish.resolution.range_m)) {
    slot.preparer = std::make_unique<echo::CoastPreparer>(
        reader_.load(wish.own_ship, window_radius(wish.resolution.range_m)), wish.own_ship,
        echo::kDefaultDimension, seed_);
  }
  slot.picture.set(slot.preparer->prepare(wish.own_ship, wish.resolution));
}

void CoastService::prepare_now(std::size_t radar, const CoastWish& wish) {
  serve(*slots_[radar], wish);
}

void CoastService::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "coast");
    work(stop);
  });
}

void CoastService::ask(std::size_t radar, const CoastWish& wish) {
  {
    const std::lock_guard lock(mutex_);
    slots_[radar]->wish = wish;
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
