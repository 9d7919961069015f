#include "server/radar/airwaves.hpp"

#include <utility>

namespace skerry::server {

EmissionsPtr Airwaves::get() const {
  const std::lock_guard lock(mutex_);
  return emissions_;
}

Airwaves::Set Airwaves::set(std::size_t radar, const Emission& emission) {
  EmissionsPtr before;  // released outside the lock
  const std::lock_guard lock(mutex_);
  if (emissions_->radars.at(radar) == emission) return {emissions_, false};
  auto changed = std::make_shared<Emissions>(*emissions_);
  changed->radars[radar] = emission;
  ++changed->version;
  before = std::exchange(emissions_, std::move(changed));
  return {emissions_, true};
}

}  // namespace skerry::server
