// What UpstreamHost is told by its talk: the other server's messages, and whether it is there.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "protocol/quantity/speed.hpp"
#include "protocol/recording/item.hpp"
#include "server/relay/radars_told.hpp"
#include "server/relay/upstream_host.hpp"
#include "server/relayed/values_in_range.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::seconds kTruthFor{10};  // after it was last asked for

std::int64_t steady_ns(SteadyTime time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

std::vector<std::uint8_t> octets_of(const google::protobuf::MessageLite& message) {
  std::vector<std::uint8_t> octets(message.ByteSizeLong());
  message.SerializeToArray(octets.data(), static_cast<int>(octets.size()));
  return octets;
}

// `own_ships`: how many there are, which are numbered by themselves.
TrafficItem item_of(const wire::ExerciseShip& ship, std::uint32_t own_ships) {
  TrafficItem item;
  item.number = 1 + ship.number() + (ship.own() ? 0 : own_ships);
  item.name = ship.name();
  item.mmsi = std::min(ship.mmsi(), 999'999'999u);
  item.position = {ship.latitude_deg(), wrapped_longitude(ship.longitude_deg())};
  item.heading_deg = ship.heading_deg();
  item.course_over_ground_deg = ship.course_over_ground_deg();
  item.speed_mps = std::max(0.0, ship.speed_kn()) * kKnot;
  item.rate_of_turn_deg_min = ship.rate_of_turn_deg_min();
  item.length_m = ship.length_m();
  item.beam_m = ship.beam_m();
  item.radars.assign(ship.radars().begin(), ship.radars().end());
  if (ship.ais_off()) item.ais = AisSaid{.silent = true};
  return item;
}

}  // namespace

std::optional<std::string> UpstreamHost::take_hello(const wire::Hello& told) {
  if (auto why = why_not_relayed(told, config_.identity, config_.upstream)) return why;
  wire::Hello hello = told;
  hello.DiscardUnknownFields();  // consoles here are told what this version knows
  const std::lock_guard lock(mutex_);
  const std::vector<wire::RadarInfo> now = radars_of(hello);
  changes_ = changes_told(radars_, now);
  if (!changes_.empty()) spdlog::warn("relay: {}: {}", config_.upstream, changes_);
  relayed_ = still_there(radars_, now);
  for (std::size_t i = 0; i < radars_.size(); ++i) {
    if (relayed_[i]) radars_[i] = now[i];
  }
  if (hello.identity().empty() || hello.identity() != hello_.identity()) cons_.begin_anew();
  hello_ = std::move(hello);
  return std::nullopt;
}

bool UpstreamHost::is_relayed(std::uint32_t radar) const {
  const std::lock_guard lock(mutex_);
  return radar < relayed_.size() && relayed_[radar];
}

void UpstreamHost::set_connected() {
  const std::lock_guard lock(mutex_);
  gone_.reset();
  meter_.connected(hello_.server(), std::chrono::steady_clock::now());
  meter_.set_problem(changes_);
}

void UpstreamHost::set_gone(const std::string& why) {
  const auto now = std::chrono::steady_clock::now();
  meter_.gone(why, now);
  const std::lock_guard lock(mutex_);
  if (!gone_) gone_at_ = now;
  gone_ = why;
  exercise_.reset();
}

void UpstreamHost::take(std::uint32_t radar, std::uint32_t view, wire::ServerMessage& message) {
  message.DiscardUnknownFields();
  if (message.has_settings()) {
    state_.take({recording::Kind::settings, radar, view}, {}, octets_of(message.settings()), {});
  } else if (message.has_world()) {
    std::string told = message.world().SerializeAsString();
    if (std::exchange(world_told_, told) == told) return;
    state_.take({recording::Kind::world}, {}, octets_of(message.world()), {});
    const std::lock_guard lock(mutex_);
    world_at_ = std::chrono::steady_clock::now();
  } else if (message.has_own_ship()) {
    bring_into_range(*message.mutable_own_ship());
    const std::lock_guard lock(mutex_);
    own_ships_[radar] = std::move(*message.mutable_own_ship());
  } else if (message.has_exercise()) {
    bring_into_range(*message.mutable_exercise());
    const std::lock_guard lock(mutex_);
    exercise_ = std::move(*message.mutable_exercise());
  } else if (message.has_playback()) {
    bring_into_range(*message.mutable_playback());
    const std::lock_guard lock(mutex_);
    wire::PlaybackState before = std::exchange(playback_, message.playback());
    before.set_position_s(playback_.position_s());
    if (before.SerializeAsString() != playback_.SerializeAsString()) ++playback_version_;
  }
}

void UpstreamHost::publish(std::uint32_t radar, std::uint32_t view,
                           const SpokeBatch::Spokes& spokes) {
  const auto views = views_.at(radar)->get();
  for (const RelayedViewPtr& each : *views) {
    if (each->number == view) {
      each->pass_on(spokes.sector, config_.format, spokes.native);
    } else if (view == 0 && each->opened) {
      std::vector<std::shared_ptr<Spoke>> copies;
      for (const SpokePtr& spoke : spokes.sector.spokes) {
        copies.push_back(std::make_shared<Spoke>(*spoke));
      }
      each->publish(std::move(copies));
    }
  }
}

std::optional<std::uint32_t> UpstreamHost::add_view(
    std::uint32_t radar, std::uint32_t view, std::uint32_t like,
    const std::function<void(VideoChannel&)>& prepare) {
  const RelayedViewPtr added = views_.at(radar)->add(view, prepare);
  if (!added) return std::nullopt;
  // Until its own come.
  state_.take({recording::Kind::settings, radar, added->number}, {},
              octets_of(settings(radar, like)), {});
  {
    const std::lock_guard lock(mutex_);
    views_there_[{radar, added->number}] = view;
  }
  views_changed();
  return added->number;
}

void UpstreamHost::renumber_view(std::uint32_t radar, std::uint32_t view,
                                 std::optional<std::uint32_t> there) {
  const std::lock_guard lock(mutex_);
  const auto known = views_there_.find({radar, view});
  if (known != views_there_.end()) known->second = there;
}

bool UpstreamHost::wants_truth(SteadyTime now) const {
  const std::int64_t wanted = truth_wanted_.load(std::memory_order_relaxed);
  return wanted != 0 && steady_ns(now) - wanted < std::chrono::nanoseconds(kTruthFor).count();
}

std::optional<wire::ExerciseState> UpstreamHost::exercise_state() const {
  truth_wanted_.store(steady_ns(std::chrono::steady_clock::now()), std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  return exercise_;
}

std::vector<TrafficItem> UpstreamHost::traffic() const {
  std::vector<TrafficItem> items;
  const auto told = exercise_state();
  if (!told) return items;
  const auto own_ships = static_cast<std::uint32_t>(std::count_if(
      told->ships().begin(), told->ships().end(), [](const auto& ship) { return ship.own(); }));
  for (const wire::ExerciseShip& ship : told->ships()) {
    if (!ship.removed()) items.push_back(item_of(ship, own_ships));
  }
  return items;
}

wire::World UpstreamHost::world() const {
  wire::World world = RelayedHost::world();
  const std::lock_guard lock(mutex_);
  const auto until = gone_ ? gone_at_ : std::chrono::steady_clock::now();
  if (world_at_ == SteadyTime{} || until < world_at_) return world;
  const double since_s = std::chrono::duration<double>(until - world_at_).count();
  world.set_scenario_s(world.scenario_s() + since_s);
  if (!world.frozen()) world.set_exercise_s(world.exercise_s() + since_s * world.rate());
  return world;
}

wire::PlaybackState UpstreamHost::state() const {
  const std::lock_guard lock(mutex_);
  return playback_;
}

}  // namespace skerry::server
