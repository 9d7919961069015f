#include "server/tracking/target_service.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <exception>

#include "server/tracking/own_sensors.hpp"

namespace skerry::server {

TargetService::TargetService(RadarHost& host, std::string format, Sensed sensed)
    : host_(host), format_(std::move(format)), sensed_(std::move(sensed)) {}

TargetService::~TargetService() { stop(); }

void TargetService::start() {
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "plotters");
    try {
      run();
    } catch (const std::exception& error) {
      spdlog::critical("the plotters' thread ends: {}", error.what());
      std::terminate();
    }
  });
}

void TargetService::stop() {
  {
    const std::lock_guard lock(wake_mutex_);
    stopping_ = true;
  }
  wakes_.notify_one();
  if (thread_.joinable()) thread_.join();
  const std::lock_guard lock(mutex_);
  entries_.clear();  // their readers leave the rings
}

// --- any thread

std::shared_ptr<const void> TargetService::want(std::uint32_t radar, std::uint32_t view) {
  VideoChannelPtr channel = host_.find_channel(radar, view);
  if (channel == nullptr || channel->find_format(format_) == nullptr) return nullptr;
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[{radar, view}];
  if (entry.plotter == nullptr || !entry.plotter->is_of(*channel)) {
    if (entries_.size() > kMostPlotters) {
      entries_.erase({radar, view});
      return nullptr;
    }
    entry.plotter = std::make_shared<ViewPlotter>(radar, view, std::move(channel), format_,
                                                  beam_of(radar), [this] { wake(); });
    entry.wanted.reset();
  }
  entry.last_wanted = std::chrono::steady_clock::now();
  auto lease = entry.wanted.lock();
  if (lease == nullptr) {
    lease = std::make_shared<const int>(0);
    entry.wanted = lease;
  }
  return lease;
}

std::shared_ptr<ViewPlotter> TargetService::find(std::uint32_t radar, std::uint32_t view) const {
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find({radar, view});
  return entry == entries_.end() ? nullptr : entry->second.plotter;
}

TargetListPtr TargetService::targets(std::uint32_t radar, std::uint32_t view) const {
  const auto plotter = find(radar, view);
  return plotter == nullptr ? nullptr : plotter->list();
}

TargetPlotsPtr TargetService::plots(std::uint32_t radar, std::uint32_t view) const {
  const auto plotter = find(radar, view);
  return plotter == nullptr ? nullptr : plotter->plots();
}

wire::Reply TargetService::order(const wire::TargetOrder& order, const std::string& origin) {
  const auto plotter = find(order.radar(), order.view());
  if (plotter == nullptr) {
    wire::Reply reply;
    reply.set_code(wire::Reply::REFUSED);
    reply.set_text(fmt::format(
        "nobody looks for targets of radar {} view {}; subscribe to it with targets_hz first",
        order.radar(), order.view()));
    return reply;
  }
  wire::Reply reply = plotter->order(order);
  if (reply.code() == wire::Reply::OK) {
    spdlog::debug("targets of radar {} view {}: order of {}", order.radar(), order.view(), origin);
  }
  return reply;
}

double TargetService::beam_of(std::uint32_t radar) const {
  const wire::Hello hello = host_.hello();
  for (const wire::RadarInfo& info : hello.radars()) {
    if (info.radar() == radar) return info.beam_width_deg();
  }
  return 0.0;
}

void TargetService::wake() {
  {
    const std::lock_guard lock(wake_mutex_);
    woken_ = true;
  }
  wakes_.notify_one();
}

// --- its thread

void TargetService::run() {
  Steady next_list = std::chrono::steady_clock::now();
  while (true) {
    const Steady now = std::chrono::steady_clock::now();
    const Plotters plotters = at_work(now);
    const bool more = take(plotters, next_list);
    if (now >= next_list) {
      tell(plotters);
      next_list = std::max(next_list + kListPeriod, now);
    }
    std::unique_lock lock(wake_mutex_);
    if (!more) wakes_.wait_for(lock, kLook, [this] { return woken_ || stopping_; });
    woken_ = false;
    if (stopping_) return;
  }
}

TargetService::Plotters TargetService::at_work(Steady now) {
  Plotters plotters;
  std::vector<std::shared_ptr<ViewPlotter>> ended;  // after the lock: to leave a ring may wait
  const std::lock_guard lock(mutex_);
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    auto& [key, what] = *entry;
    if (!what.wanted.expired()) what.last_wanted = now;
    const VideoChannelPtr channel = host_.find_channel(key.first, key.second);
    const bool is_there = channel != nullptr && what.plotter->is_of(*channel);
    if (!is_there || now - what.last_wanted > kGrace) {
      ended.push_back(std::move(what.plotter));
      entry = entries_.erase(entry);
      continue;
    }
    plotters.emplace_back(key, what.plotter);
    ++entry;
  }
  return plotters;
}

bool TargetService::take(const Plotters& plotters, Steady until) {
  bool more = false;
  for (std::size_t i = 0; i < plotters.size(); ++i) {
    if (i > 0 && std::chrono::steady_clock::now() >= until) return true;
    // Those that had no turn the last time come first.
    const auto& [key, plotter] = plotters[next_++ % plotters.size()];
    more = plotter->take(sensors_of(sensed_(key.first))) || more;
  }
  return more;
}

void TargetService::tell(const Plotters& plotters) {
  if (plotters.empty()) return;
  const std::vector<TrafficItem> traffic = host_.traffic();
  for (const auto& [key, plotter] : plotters) {
    const wire::OwnShip ship = sensed_(key.first);
    plotter->tell(sensors_of(ship), ais_contacts(traffic, ship, key.first));
  }
}

}  // namespace skerry::server
