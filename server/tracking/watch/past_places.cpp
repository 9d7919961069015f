#include "server/tracking/watch/past_places.hpp"

#include <algorithm>

namespace skerry::server {
namespace {

double between(double from, double to, double share) { return from + (to - from) * share; }

}  // namespace

void PastPlaces::add(UtcTime now, const WasAt& was) {
  // The last one moves on with the target until it is a grain behind the one before it.
  if (kept_.size() >= 2 && now - kept_[kept_.size() - 2].utc < kGrain) kept_.pop_back();
  kept_.push_back({now, was});
  if (kept_.size() > kMostKept) kept_.pop_front();
}

std::vector<WasAt> PastPlaces::told(UtcTime now, Duration interval) const {
  std::vector<WasAt> told;
  if (kept_.empty() || interval < kGrain) return told;
  UtcTime utc = now - now.time_since_epoch() % interval;
  for (; told.size() < kTold && utc >= kept_.front().utc; utc -= interval) {
    if (utc <= kept_.back().utc) told.push_back(at(utc));
  }
  return told;
}

WasAt PastPlaces::at(UtcTime utc) const {
  const auto after =
      std::lower_bound(kept_.begin(), kept_.end(), utc,
                       [](const Kept& kept, UtcTime wanted) { return kept.utc < wanted; });
  if (after == kept_.begin()) return after->was;
  const Kept &a = *(after - 1), &b = *after;
  const double share = in_seconds(utc - a.utc) / in_seconds(b.utc - a.utc);
  WasAt was;
  was.place.latitude_deg = between(a.was.place.latitude_deg, b.was.place.latitude_deg, share);
  const double east = wrapped_longitude(b.was.place.longitude_deg - a.was.place.longitude_deg);
  was.place.longitude_deg = wrapped_longitude(a.was.place.longitude_deg + east * share);
  was.from_own_ship = a.was.from_own_ship + (b.was.from_own_ship - a.was.from_own_ship) * share;
  return was;
}

}  // namespace skerry::server
