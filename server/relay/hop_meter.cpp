#include "server/relay/hop_meter.hpp"

#include <algorithm>
#include <cmath>

#include "server/relayed/sendable_text.hpp"

namespace skerry::server {
namespace {

constexpr int kMostBefore = 16;               // hops
constexpr std::size_t kLongestHopText = 300;  // bytes

double seconds_of(std::chrono::steady_clock::duration time) {
  return std::max(0.0, std::chrono::duration<double>(time).count());
}

}  // namespace

void HopMeter::connected(const std::string& server, Time now) {
  const std::lock_guard lock(mutex_);
  status_.set_server(sendable(server, kLongestHopText));
  status_.set_connected(true);
  status_.clear_problem();
  if (was_connected_) status_.set_reconnects(status_.reconnects() + 1);
  was_connected_ = true;
  since_ = now;
  round_trips_ms_.clear();
}

void HopMeter::gone(const std::string& why, Time now) {
  const std::lock_guard lock(mutex_);
  if (status_.connected()) since_ = now;
  status_.set_connected(false);
  status_.set_problem(sendable(why, kLongestHopText));
  before_.clear();
}

void HopMeter::set_problem(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  status_.set_problem(sendable(problem, kLongestHopText));
}

void HopMeter::received(std::uint64_t spokes, std::uint64_t lost, std::uint64_t bytes, Time now) {
  const std::lock_guard lock(mutex_);
  status_.set_spokes(status_.spokes() + spokes);
  status_.set_spokes_lost(status_.spokes_lost() + lost);
  status_.set_bytes(status_.bytes() + bytes);
  bytes_.emplace_back(now, status_.bytes());
  while (bytes_.size() > 2 && now - bytes_[1].first >= kRateOver) bytes_.pop_front();
}

void HopMeter::set_thin(std::uint32_t level) {
  const std::lock_guard lock(mutex_);
  status_.set_thin(level);
}

void HopMeter::round_trip(std::chrono::steady_clock::duration time) {
  const std::lock_guard lock(mutex_);
  round_trips_ms_.push_back(1000.0 * seconds_of(time));
  if (round_trips_ms_.size() > kRoundTrips) round_trips_ms_.pop_front();
}

void HopMeter::asked() {
  const std::lock_guard lock(mutex_);
  status_.set_requests(status_.requests() + 1);
}

void HopMeter::refused() {
  const std::lock_guard lock(mutex_);
  status_.set_requests_refused(status_.requests_refused() + 1);
}

void HopMeter::set_before(const wire::Hops& before) {
  const std::lock_guard lock(mutex_);
  before_.clear();
  for (const wire::HopStatus& hop : before.hops()) {
    if (before_.size() == kMostBefore) break;
    before_.push_back(hop);
    wire::HopStatus& kept = before_.back();
    kept.DiscardUnknownFields();
    if (!std::isfinite(kept.since_s())) kept.clear_since_s();
    if (!std::isfinite(kept.bytes_per_second())) kept.clear_bytes_per_second();
    if (!std::isfinite(kept.round_trip_ms())) kept.clear_round_trip_ms();
    kept.set_upstream(sendable(kept.upstream(), kLongestHopText));
    kept.set_server(sendable(kept.server(), kLongestHopText));
    kept.set_problem(sendable(kept.problem(), kLongestHopText));
  }
}

std::vector<wire::HopStatus> HopMeter::tell(Time now) const {
  const std::lock_guard lock(mutex_);
  std::vector<wire::HopStatus> hops = {status_};
  wire::HopStatus& own = hops.front();
  own.set_since_s(seconds_of(now - since_));
  if (status_.connected() && !bytes_.empty() && now - bytes_.back().first < kRateOver) {
    const double over = seconds_of(now - bytes_.front().first);
    const auto came = static_cast<double>(status_.bytes() - bytes_.front().second);
    if (over > 0.0) own.set_bytes_per_second(came / over);
  }
  if (!round_trips_ms_.empty()) {
    std::vector<double> sorted(round_trips_ms_.begin(), round_trips_ms_.end());
    std::sort(sorted.begin(), sorted.end());
    own.set_round_trip_ms(sorted[sorted.size() / 2]);
  }
  hops.insert(hops.end(), before_.begin(), before_.end());
  return hops;
}

}  // namespace skerry::server
