#include "server/radar/radar_unit.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>

#include "server/radar/thread_priority.hpp"

namespace skerry::server {
namespace {

// Half a second of sectors.
std::size_t ring_sectors(const RadarConfig& config) {
  const double sectors = config.geometry.spokes_per_turn *
                         rpm_of(config.set, config.radar_controls) / 60.0 /
                         RadarUnit::kSectorSpokes;
  return static_cast<std::size_t>(std::max(8.0, std::ceil(0.5 * sectors)));
}

constexpr Duration kRest = std::chrono::milliseconds(50);

// Sleeps until `deadline` or a stop, whichever comes first.
class Sleeper {
 public:
  bool until(std::chrono::steady_clock::time_point deadline, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    condition_.wait_until(lock, stop, deadline, [] { return false; });
    return !stop.stop_requested();
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any condition_;
};

std::vector<ViewInForce> in_force(const RadarViews& views) {
  std::vector<ViewInForce> out;
  for (const RadarViewPtr& view : views) out.push_back({view->number, view->controls_in_force()});
  return out;
}

}  // namespace

RadarUnit::RadarUnit(const RadarConfig& config, Timeline& timeline, CoastService& coast,
                     Airwaves& airwaves, std::size_t workers, InputSink* inputs)
    : config_(config),
      timeline_(timeline),
      coast_keeper_(coast, config.radar),
      airwaves_(airwaves),
      inputs_(inputs),
      maker_(config, workers),
      views_(config.controls, ring_sectors(config)),
      radar_controls_(config.radar_controls) {
  given_.on_air = config.controls.range_scale;
  airwaves_.set(config.radar, maker_.emission(config.radar_controls, config.controls.range_scale));
}

void RadarUnit::look_at_views() {
  shown_ = views_.get();
  given_.views = in_force(*shown_);
}

void RadarUnit::warm_up() {
  look_at_views();
  given_.radar = radar_controls();
  given_.on_air = given_.views.front().controls.range_scale;
  given_.state = timeline_.at(ScenarioTime{});
  given_.coast = coast_keeper_.latest();
  given_.emissions = airwaves_.get();
  if (inputs_ != nullptr) inputs_->warmed_up(config_.radar, given_);
  maker_.warm_up(given_);
}

echo::RadarSet RadarUnit::set_on_air() const {
  echo::RadarSet set = config_.set;
  const echo::RadarControls controls = radar_controls();
  set.rpm = rpm_of(set, controls);
  if (controls.antenna_height_m > 0.0) set.antenna_height_m = controls.antenna_height_m;
  return set;
}

void RadarUnit::start(const Epoch& epoch) {
  set_utc({{}, epoch.utc});
  thread_ = std::jthread([this, epoch](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), fmt::format("radar-{}", config_.radar).c_str());
    go_before_others();
    run(stop, epoch);
  });
}

void RadarUnit::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

CoastWish RadarUnit::wish(const ShipState& own_ship, RangeScale range) const {
  std::vector<ViewInForce> views = in_force(*views_.get());
  views.front().controls.range_scale = range;
  return maker_.wish(own_ship, views, 0);
}

bool RadarUnit::gather(std::uint64_t first) {
  const RangeScale shown = given_.on_air;
  look_at_views();
  const ScenarioTime time = maker_.clock().time_of(first);
  given_.state = timeline_.at(time);
  const WorldState& state = *given_.state;
  if (time - state.time > 3 * World::kTick) return false;
  coast_keeper_.look_after(maker_.wish(state.own_ships[config_.own_ship], given_.views, first + 1),
                           state.time);
  given_.coast = coast_keeper_.latest();
  given_.on_air = range_to_show(shown);
  coast_edges_.store(given_.coast->picture->edge_count(), std::memory_order_relaxed);
  scan_.store(static_cast<std::uint32_t>(first / config_.geometry.spokes_per_turn),
              std::memory_order_relaxed);
  return true;
}

RangeScale RadarUnit::range_to_show(RangeScale shown) {
  const RangeScale wished = given_.views.front().controls.range_scale;
  if (wished == shown || !given_.radar.transmit || !given_.emissions) {
    tables_ahead_.let_go();
    return wished;
  }
  const bool ready = tables_ahead_.ready({wished, given_.radar}, [&] {
    SectorInputs inputs = given_;
    inputs.on_air = wished;
    return maker_.ahead(inputs);
  });
  const bool coast_comes = given_.coast->picture->range_m < wished.length().in_metres() &&
                           coast_keeper_.is_waiting(given_.state->time);
  return ready && !coast_comes ? wished : shown;
}

bool RadarUnit::make_sector(std::uint64_t first) {
  if (!gather(first)) {
    skip(first);
    return false;
  }
  const Airwaves::Set set =
      airwaves_.set(config_.radar, maker_.emission(given_.radar, given_.on_air));
  given_.emissions = set.emissions;
  given_.utc = *utc_.get();
  if (inputs_ != nullptr) inputs_->took(config_.radar, first, given_, set.changed);
  maker_.make(first, given_, made_);
  return !made_.empty();
}

void RadarUnit::make_spokes_until(std::chrono::steady_clock::time_point end) {
  const auto now = std::chrono::steady_clock::now();
  if (now.time_since_epoch().count() >= made_until_.load()) {
    made_from_.store((now + kTakeOver).time_since_epoch().count());
  }
  made_until_.store(end.time_since_epoch().count());
}

bool RadarUnit::is_made_here(std::chrono::steady_clock::time_point now,
                             std::chrono::steady_clock::time_point end) const {
  return now.time_since_epoch().count() < made_until_.load() &&
         end.time_since_epoch().count() > made_from_.load();
}

void RadarUnit::leave_to_another_host(std::uint64_t first) {
  given_.on_air = range_on_air();
  airwaves_.set(config_.radar, maker_.emission(given_.radar, given_.on_air));
  scan_.store(static_cast<std::uint32_t>(first / config_.geometry.spokes_per_turn),
              std::memory_order_relaxed);
  if (inputs_ != nullptr) inputs_->skipped(config_.radar, first, given_.radar);
  given_.numbered_from = first + kSectorSpokes;
}

void RadarUnit::skip(std::uint64_t first) {
  sectors_skipped_.fetch_add(1, std::memory_order_relaxed);
  if (inputs_ != nullptr) inputs_->skipped(config_.radar, first, given_.radar);
}

void RadarUnit::run(const std::stop_token& stop, const Epoch& epoch) {
  coast_keeper_.begin(
      wish(timeline_.latest()->own_ships[config_.own_ship], config_.controls.range_scale)
          .resolution);
  Sleeper sleeper;
  const auto end_of = [&](std::uint64_t first) {
    return epoch.steady + Duration(shift_.load()) +
           maker_.clock().time_of(first + kSectorSpokes).time_since_epoch();
  };
  for (std::uint64_t first = 0;; first += kSectorSpokes) {
    given_.radar = *radar_controls_.get();
    maker_.turn(first, given_.radar);
    if (maker_.clock().time_of(first + kSectorSpokes) <= epoch.taken_up) {
      if (inputs_ != nullptr) inputs_->skipped(config_.radar, first, given_.radar);
      given_.numbered_from = first + kSectorSpokes;
      continue;
    }
    // Of a radar that is made elsewhere several sectors at a time are passed.
    const auto looked = std::chrono::steady_clock::now();
    const bool waits = !is_made_here(looked, end_of(first)) && end_of(first) > looked;
    const Duration rest = waits ? kRest : Duration{};
    if (!sleeper.until(end_of(first) + rest, stop)) return;
    const auto begun = std::chrono::steady_clock::now();
    if (!is_made_here(begun, end_of(first))) {
      leave_to_another_host(first);
    } else if (begun > end_of(first) + kGiveUp) {
      skip(first);
    } else if (make_sector(first) &&
               // The process may have been stopped meanwhile.
               is_made_here(std::chrono::steady_clock::now(), end_of(first))) {
      publish(first, epoch, begun);
    }
    sectors_.fetch_add(1, std::memory_order_relaxed);
  }
}

void RadarUnit::publish(std::uint64_t first, const Epoch& epoch,
                        std::chrono::steady_clock::time_point begun) {
  const auto made = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < made_.size(); ++i) (*shown_)[i]->channel.publish(made_[i].sector);

  const Duration end = maker_.clock().time_of(first + kSectorSpokes).time_since_epoch();
  const Duration late =
      std::chrono::steady_clock::now() - (epoch.steady + Duration(shift_.load()) + end);
  if (late.count() > lateness_max_ns_.load(std::memory_order_relaxed)) {
    lateness_max_ns_.store(late.count(), std::memory_order_relaxed);
  }
  if (late > end - maker_.clock().time_of(first).time_since_epoch()) {
    spokes_late_.fetch_add(kSectorSpokes, std::memory_order_relaxed);
  }
  spokes_.fetch_add(kSectorSpokes, std::memory_order_relaxed);
  const double ns = static_cast<double>(Duration(made - begun).count()) /
                    (double{kSectorSpokes} * config_.geometry.cells);
  mean_ns_ += (ns - mean_ns_) / 64.0;
  render_ns_per_cell_.store(mean_ns_, std::memory_order_relaxed);
}

RadarCounters RadarUnit::counters() const {
  return {sectors_.load(),
          spokes_.load(),
          spokes_late_.load(),
          sectors_skipped_.load(),
          static_cast<double>(lateness_max_ns_.load()) * 1e-6,
          render_ns_per_cell_.load(),
          scan_.load(),
          coast_edges_.load()};
}

}  // namespace skerry::server
