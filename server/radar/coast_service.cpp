#include "server/radar/coast_service.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

namespace skerry::server {

CoastService::CoastService(std::unique_ptr<const echo::ChartSource> chart, std::size_t radars,
                           const echo::CoastRules& rules)
    : chart_(std::move(chart)), rules_(rules) {
  for (std::size_t i = 0; i < radars; ++i)
    slots_.push_back(std::make_unique<Slot>(*chart_, rules_));
}

CoastService::~CoastService() { stop(); }

void CoastService::stop() {
  std::deque<Look> refused;
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    refused.swap(surveys_);
    std::move(looks_.begin(), looks_.end(), std::back_inserter(refused));
    looks_.clear();
  }
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  for (const Look& look : refused) call(look, nullptr);
}

void CoastService::serve(Slot& slot, const CoastWish& wish) {
  const bool laid_anew = !slot.maker.serves(wish);
  if (laid_anew) slot.maker.lay(wish);
  // Half of the picture's slack is left for the way sailed until the next wish is served.
  const CoastInSightPtr before = slot.in_sight.get();
  echo::CoastPicturePtr picture = before ? before->picture : nullptr;
  const bool fresh =
      picture && !laid_anew && wish.resolution == slot.made_for &&
      length_of(picture->plane.to_plane(wish.own_ship) - picture->centre) <= 0.5 * picture->slack_m;
  if (laid_anew) slot.origin.laid = wish.tag;
  if (!fresh) {
    picture = slot.maker.picture(wish);
    slot.origin.wish = wish.tag;
  }
  slot.made_for = wish.resolution;
  slot.in_sight.set(seen_from(picture, wish, slot.origin));
}

void CoastService::prepare_now(std::size_t radar, const CoastWish& wish) {
  serve(find(radar), wish);
}

std::size_t CoastService::add_slot() {
  const std::lock_guard lock(mutex_);
  slots_.push_back(std::make_unique<Slot>(*chart_, rules_));
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
  const auto has_work = [&] {
    return wishing() != slots_.end() || !surveys_.empty() || !looks_.empty();
  };
  // After a request to stop the wait returns what has_work() says.
  while (wished_.wait(lock, stop, has_work) && !stop.stop_requested()) {
    const auto slot = wishing();
    if (slot == slots_.end()) {
      std::deque<Look>& waiting = surveys_.empty() ? looks_ : surveys_;
      Look look = std::move(waiting.front());
      waiting.pop_front();
      lock.unlock();
      call(look, chart_.get());
      look = nullptr;  // what it holds is not freed under the lock
      lock.lock();
      continue;
    }
    Slot& wished = **slot;
    const CoastWish wish = *wished.wish;
    wished.wish.reset();
    lock.unlock();
    try {
      serve(wished, wish);
    } catch (const std::exception& error) {
      // The chart went away under a running server: the radars keep the coast they have.
      spdlog::error("coast: {}", error.what());
    }
    lock.lock();
  }
}

void CoastService::queue(std::deque<Look>& waiting, std::size_t most, Look look) {
  {
    const std::lock_guard lock(mutex_);
    if (!stopped_ && waiting.size() < most) {
      waiting.push_back(std::move(look));
      look = nullptr;
    }
  }
  if (look) return call(look, nullptr);
  wished_.notify_one();
}

void CoastService::look(Look look) { queue(looks_, kMaxLooks, std::move(look)); }

void CoastService::call(const Look& look, const echo::ChartSource* chart) {
  try {
    look(chart);
  } catch (const std::exception& error) {
    spdlog::error("chart: {}", error.what());
  }
}

void CoastService::survey(GeoPoint centre, Length radius, SurveyDone done) {
  const auto look = [centre, radius, done = std::move(done)](const echo::ChartSource* source) {
    std::optional<echo::CoastChart> chart;
    try {
      if (source != nullptr) chart = source->load(centre, radius);
    } catch (const std::exception& error) {
      spdlog::error("chart: {}", error.what());
    }
    done(std::move(chart));
  };
  queue(surveys_, kMaxSurveys, look);
}

}  // namespace skerry::server
