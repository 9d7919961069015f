#include "server/tracking/watch/ais_book.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "protocol/wire/printable_text.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kLongestName = 34;
constexpr double kFastestAis_mps = 200.0 * 1852.0 / 3600.0;

bool is_usable(const AisContact& contact, UtcTime now) {
  return contact.mmsi != 0 && is_on_the_earth(contact.place) &&
         contact.utc <= now + std::chrono::minutes(1) && contact.utc >= now - std::chrono::hours(1);
}

void drop_nonsense(AisContact& contact) {
  const auto is_number = [](double v) { return std::isfinite(v) && std::fabs(v) <= 720.0; };
  if (contact.course_deg && !is_number(*contact.course_deg)) contact.course_deg.reset();
  if (contact.heading_deg && !is_number(*contact.heading_deg)) contact.heading_deg.reset();
  if (contact.speed_mps && !(*contact.speed_mps >= 0.0 && *contact.speed_mps <= kFastestAis_mps)) {
    contact.speed_mps.reset();
  }
  contact.name = printable(contact.name, kLongestName);
}

// Over ground by true north where it is; a ship that lies still needs no course for that.
std::optional<PlanePoint> motion_of(const AisContact& contact) {
  if (!contact.speed_mps) return std::nullopt;
  if (*contact.speed_mps < 0.25) return PlanePoint{};
  if (!contact.course_deg) return std::nullopt;
  return vector_of(*contact.course_deg, *contact.speed_mps);
}

}  // namespace

void AisBook::take(std::span<const AisContact> contacts, UtcTime now) {
  for (const AisContact& contact : contacts) {
    if (!is_usable(contact, now)) continue;
    auto found = records_.find(contact.mmsi);
    if (found == records_.end()) {
      if (records_.size() >= kMostKnown) continue;
      found = records_.emplace(contact.mmsi, AisRecord{}).first;
    } else {
      if (contact.utc <= found->second.contact.utc) continue;
      const double interval_s = in_seconds(contact.utc - found->second.contact.utc);
      double& usual_s = found->second.interval_s;
      usual_s = usual_s == 0.0 ? interval_s : usual_s + 0.3 * (interval_s - usual_s);
    }
    found->second.contact = contact;
    drop_nonsense(found->second.contact);
  }
}

bool AisBook::is_fresh(const AisRecord& record) {
  const auto& speed = record.contact.speed_mps;
  const bool is_quick = speed && *speed >= kSlow_mps && record.interval_s > 0.0;
  return record.age_s <=
         (is_quick ? std::clamp(kIntervals * record.interval_s, kLeastFresh_s, kMostFresh_s)
                   : kMostFresh_s);
}

void AisBook::place(AisRecord& record, const GroundPlane& plane,
                    const std::optional<PlanePoint>& own_over_ground_mps, UtcTime now) {
  record.age_s = std::max(0.0, in_seconds(now - record.contact.utc));
  record.motion_mps = motion_of(record.contact);
  record.from_own_ship = plane.to_plane(record.contact.place);
  if (record.motion_mps) {
    const double north_deg = -plane.true_less_plane_degrees(record.contact.place);
    record.motion_mps = echo::turned(*record.motion_mps, echo::sin_cos_degrees(north_deg));
    record.from_own_ship =
        record.from_own_ship + *record.motion_mps * std::min(record.age_s, kMostFresh_s);
  }
  record.approach.reset();
  if (record.motion_mps && own_over_ground_mps) {
    record.approach =
        closest_approach(record.from_own_ship, *record.motion_mps - *own_over_ground_mps);
  }
}

void AisBook::place(const GroundPlane& plane, const std::optional<PlanePoint>& own_over_ground_mps,
                    UtcTime now) {
  for (auto& [mmsi, record] : records_) {
    place(record, plane, own_over_ground_mps, now);
    record.is_listed = record.is_listed || is_fresh(record);
  }
  forget_old_ones();
  leave_out_far_ones();
}

// Those that may not come back by the same report.
void AisBook::forget_old_ones() {
  std::erase_if(records_, [](const auto& known) {
    const AisRecord& record = known.second;
    return !record.is_listed && !(record.age_s <= kMostFresh_s);
  });
}

void AisBook::leave_out_far_ones() {
  std::vector<std::pair<double, AisRecord*>> near;  // by range, squared
  for (auto& [mmsi, record] : records_) {
    const double range2 = dot(record.from_own_ship, record.from_own_ship);
    if (!(range2 <= kReach_m * kReach_m)) record.is_listed = false;
    if (record.is_listed) near.emplace_back(range2, &record);
  }
  left_out_ = near.size() > kMostListed ? static_cast<std::uint32_t>(near.size() - kMostListed) : 0;
  if (left_out_ == 0) return;
  const auto last = near.begin() + static_cast<std::ptrdiff_t>(kMostListed);
  std::nth_element(near.begin(), last, near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto at = last; at != near.end(); ++at) at->second->is_listed = false;
}

const AisRecord* AisBook::find(std::uint32_t mmsi) const {
  const auto found = records_.find(mmsi);
  return found != records_.end() && found->second.is_listed ? &found->second : nullptr;
}

AisRecord* AisBook::find(std::uint32_t mmsi) {
  return const_cast<AisRecord*>(std::as_const(*this).find(mmsi));
}

}  // namespace skerry::server
