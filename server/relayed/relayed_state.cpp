#include "server/relayed/relayed_state.hpp"

#include <algorithm>
#include <string>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "protocol/video/range_scale.hpp"
#include "server/relayed/relayed_exercise.hpp"
#include "server/relayed/sailed_on.hpp"
#include "server/relayed/values_in_range.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kLastMmsi = 999'999'999;

template <typename Message>
bool parse(std::span<const std::uint8_t> bytes, Message& message) {
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return false;
  bring_into_range(message);
  return true;
}

// How long a ship has sailed on since an item.
double sailed_s(UtcTime since, UtcTime now) {
  return in_seconds(std::clamp<Duration>(now - since, Duration::zero(), RelayedState::kSailsOn));
}

TrafficKind kind_of(recording::Traffic::Item::Kind kind) {
  switch (kind) {
    case recording::Traffic::Item::SHIP:
      return TrafficKind::ship;
    case recording::Traffic::Item::BOAT:
      return TrafficKind::boat;
    case recording::Traffic::Item::AID_TO_NAVIGATION:
      return TrafficKind::aid_to_navigation;
    default:
      return TrafficKind::other;
  }
}

TrafficItem traffic_item(const recording::Traffic::Item& said,
                         const std::map<std::uint32_t, std::uint32_t>& radars) {
  TrafficItem item;
  item.number = said.number();
  item.kind = kind_of(said.kind());
  item.name = said.name();
  item.mmsi = std::min(said.mmsi(), kLastMmsi);
  item.position = {said.latitude_deg(), wrapped_longitude(said.longitude_deg())};
  item.heading_deg = said.heading_deg();
  item.course_over_ground_deg = said.course_over_ground_deg();
  item.speed_mps = said.speed_mps();
  item.rate_of_turn_deg_min = said.rate_of_turn_deg_min();
  item.length_m = said.length_m();
  item.beam_m = said.beam_m();
  for (const std::uint32_t recorded : said.radars()) {
    const auto played = radars.find(recorded);
    if (played != radars.end()) item.radars.push_back(played->second);
  }
  item.ship_type = static_cast<std::uint8_t>(std::min(said.ship_type(), 99u));
  item.aid_type = static_cast<std::uint8_t>(std::min(said.aid_type(), 31u));
  return item;
}

// Consoles and displays rely on a range scale of the table.
void fit_range(wire::Settings& settings, const std::optional<SpokeHeader>& spoke) {
  if (!RangeScale::find(settings.range_nm())) {
    const RangeScale scale = spoke ? spoke->range_scale : RangeScale{};
    settings.set_range_nm(scale.in_nautical_miles());
    if (spoke) settings.set_instrumented_range_m(spoke->instrumented_range.in_metres());
  }
  if (!RangeScale::find(settings.radar_range_nm()))
    settings.set_radar_range_nm(settings.range_nm());
}

}  // namespace

bool RelayedState::take(const recording::Topic& topic, UtcTime time,
                        std::span<const std::uint8_t> bytes,
                        const std::map<std::uint32_t, std::uint32_t>& radars) {
  switch (topic.kind) {
    case recording::Kind::settings: {
      wire::Settings settings;
      if (!parse(bytes, settings)) return false;
      settings.set_radar(topic.radar);
      settings.set_view(topic.view);
      const std::lock_guard lock(mutex_);
      settings_[{topic.radar, topic.view}] = std::move(settings);
      ++settings_version_;
      return true;
    }
    case recording::Kind::own_ship: {
      wire::OwnShip ship;
      if (!parse(bytes, ship)) return false;
      ship.set_radar(topic.radar);
      ship.set_mmsi(std::min(ship.mmsi(), kLastMmsi));
      const std::lock_guard lock(mutex_);
      own_ships_[topic.radar] = {time, std::move(ship)};
      return true;
    }
    case recording::Kind::world: {
      wire::World world;
      if (!parse(bytes, world)) return false;
      const std::lock_guard lock(mutex_);
      world_ = std::move(world);
      ++world_version_;
      return true;
    }
    case recording::Kind::traffic: {
      recording::Traffic traffic;
      if (!parse(bytes, traffic)) return false;
      std::vector<TrafficItem> items;
      for (const auto& said : traffic.items()) items.push_back(traffic_item(said, radars));
      const std::lock_guard lock(mutex_);
      traffic_ = {time, std::move(items)};
      return true;
    }
    case recording::Kind::exercise: {
      wire::ExerciseState exercise;
      if (!parse(bytes, exercise)) return false;
      make_tellable(exercise, radars);
      const std::lock_guard lock(mutex_);
      exercise_ = std::move(exercise);
      exercise_time_ = time;
      return true;
    }
    default:
      return false;
  }
}

void RelayedState::take(const SpokeHeader& header) {
  const std::lock_guard lock(mutex_);
  const auto [at, first] = spokes_.try_emplace({header.radar, header.view}, header);
  const bool told = settings_.contains({header.radar, header.view});
  const bool other = !(at->second.range_scale == header.range_scale) ||
                     at->second.instrumented_range != header.instrumented_range;
  at->second = header;
  if (!told && (first || other)) ++settings_version_;
}

void RelayedState::forget(std::uint32_t radar, std::uint32_t view) {
  const std::lock_guard lock(mutex_);
  settings_.erase({radar, view});
  spokes_.erase({radar, view});
}

wire::Settings RelayedState::settings(std::uint32_t radar, std::uint32_t view) const {
  const std::lock_guard lock(mutex_);
  wire::Settings settings;
  if (const auto found = settings_.find({radar, view}); found != settings_.end()) {
    settings = found->second;
  }
  const auto spoke = spokes_.find({radar, view});
  fit_range(settings, spoke == spokes_.end() ? std::nullopt : std::optional(spoke->second));
  settings.set_radar(radar);
  settings.set_view(view);
  return settings;
}

wire::OwnShip RelayedState::own_ship(std::uint32_t radar, UtcTime now,
                                     std::optional<UtcTime> utc) const {
  const std::lock_guard lock(mutex_);
  wire::OwnShip ship;
  ship.set_radar(radar);
  ship.set_no_position(true);
  ship.set_no_motion(true);
  ship.set_no_heading(true);
  if (const auto found = own_ships_.find(radar); found != own_ships_.end()) {
    const auto& [time, said] = found->second;
    ship = said;
    const double since_s = sailed_s(time, now);
    const GeoPoint place =
        moved({said.latitude_deg(), said.longitude_deg()}, said.course_over_ground_deg(),
              said.speed_over_ground_kn() * kKnot * since_s);
    if (!ship.no_position()) {
      ship.set_latitude_deg(place.latitude_deg);
      ship.set_longitude_deg(place.longitude_deg);
    }
    if (!ship.no_heading()) {
      ship.set_heading_deg(
          wrapped_degrees(said.heading_deg() + said.rate_of_turn_deg_min() / 60.0 * since_s));
    }
  } else if (const auto spoke = spokes_.lower_bound({radar, 0});
             spoke != spokes_.end() && spoke->first.first == radar) {
    const GeoPoint antenna = spoke->second.own_ship;
    ship.set_latitude_deg(antenna.latitude_deg);
    ship.set_longitude_deg(antenna.longitude_deg);
    // Spokes whose radar did not know its place have zeros (README.md of protocol/captures).
    ship.set_no_position(antenna.latitude_deg == 0.0 && antenna.longitude_deg == 0.0);
    ship.set_heading_deg(spoke->second.heading.in_degrees());
    ship.set_no_heading(false);
  }
  const Duration since_1970 = utc.value_or(now).time_since_epoch();
  ship.set_utc_ns(static_cast<std::uint64_t>(std::max<std::int64_t>(0, since_1970.count())));
  return ship;
}

wire::World RelayedState::world() const {
  const std::lock_guard lock(mutex_);
  return world_;
}

std::vector<TrafficItem> RelayedState::traffic(UtcTime now) const {
  const std::lock_guard lock(mutex_);
  std::vector<TrafficItem> items = traffic_.value;
  const double since_s = sailed_s(traffic_.time, now);
  for (TrafficItem& item : items) {
    item.position = moved(item.position, item.course_over_ground_deg, item.speed_mps * since_s);
    item.heading_deg =
        wrapped_degrees(item.heading_deg + item.rate_of_turn_deg_min / 60.0 * since_s);
  }
  return items;
}

std::optional<wire::ExerciseState> RelayedState::exercise(UtcTime now) const {
  std::unique_lock lock(mutex_);
  std::optional<wire::ExerciseState> told = exercise_;
  const double since_s = sailed_s(exercise_time_, now);
  lock.unlock();
  if (told) sail_on(*told, since_s);
  return told;
}

std::uint64_t RelayedState::settings_version() const {
  const std::lock_guard lock(mutex_);
  return settings_version_;
}

std::uint64_t RelayedState::world_version() const {
  const std::lock_guard lock(mutex_);
  return world_version_;
}

}  // namespace skerry::server
