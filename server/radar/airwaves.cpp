#include "server/radar/airwaves.hpp"

#include <utility>

namespace skerry::server {

EmissionsPtr Airwaves::get() const {
  const std::lock_guard lock(mutex_);
  return emissions_;
}

void Airwaves::set(std::size_t radar, const Emission& emission) {
  EmissionsPtr before;  // released outside the lock
  const std::lock_guard lock(mutex_);
  if (emissions_->at(radar) == emission) return;
  auto changed = std::make_shared<std::vector<Emission>>(*emissions_);
  (*changed)[radar] = emission;
  before = std::exchange(emissions_, std::move(changed));
}

}  // namespace skerry::server
