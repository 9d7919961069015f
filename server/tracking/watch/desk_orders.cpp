// What a mariner orders: all of it, or nothing.
#include <fmt/format.h>
#include <charconv>

#include <algorithm>
#include <set>

#include "server/tracking/watch/desk.hpp"
#include "server/tracking/watch/rules.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {
namespace {

wire::Reply reply_of(wire::Reply::Code code, std::string text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(std::move(text));
  return reply;
}

wire::Reply refused(std::string text) { return reply_of(wire::Reply::REFUSED, std::move(text)); }
wire::Reply unknown(std::string text) { return reply_of(wire::Reply::UNKNOWN, std::move(text)); }

}  // namespace

// --- what is wrong

std::optional<wire::Reply> TargetWatch::Desk::refusal_of(const wire::TargetOrder& order,
                                                         const Plotter& plotter) const {
  if (auto refusal = refusal_of_values(order)) return refusal;
  if (auto refusal = refusal_of_zones(order)) return refusal;
  if (auto refusal = refusal_of_cancel(order, plotter)) return refusal;
  if (auto refusal = refusal_of_reference(order)) return refusal;
  if (auto refusal = refusal_of_ais(order)) return refusal;
  if (auto refusal = refusal_of_alerts(order)) return refusal;
  if (auto refusal = refusal_of_trial(order)) return refusal;
  return refusal_of_acquisition(order);
}

std::optional<wire::Reply> TargetWatch::Desk::refusal_of_values(
    const wire::TargetOrder& order) const {
  std::vector<const google::protobuf::Message*> messages;
  if (order.has_rules()) messages.push_back(&order.rules());
  if (order.has_trial()) messages.push_back(&order.trial());
  if (order.has_acquire()) messages.push_back(&order.acquire());
  for (const wire::TargetZone& zone : order.zones()) messages.push_back(&zone);
  for (const google::protobuf::Message* message : messages) {
    if (auto wrong = value_not_allowed(*message)) {
      return reply_of(wire::Reply::OUT_OF_RANGE, *std::move(wrong));
    }
  }
  return std::nullopt;
}

std::optional<wire::Reply> TargetWatch::Desk::refusal_of_zones(
    const wire::TargetOrder& order) const {
  for (const wire::TargetZone& zone : order.zones()) {
    if (zone.inner_nm() < zone.outer_nm()) continue;
    return reply_of(wire::Reply::OUT_OF_RANGE,
                    fmt::format("zone {}: it begins at {} NM and ends at {} NM, so nothing is in "
                                "it; the inner distance must be below the outer one",
                                zone.number(), zone.inner_nm(), zone.outer_nm()));
  }
  for (const std::uint32_t number : order.remove_zones()) {
    if (!zones_.has(number)) return unknown(fmt::format("there is no zone {}", number));
  }
  return std::nullopt;
}

std::optional<wire::Reply> TargetWatch::Desk::refusal_of_cancel(const wire::TargetOrder& order,
                                                                const Plotter& plotter) const {
  if (order.cancel().empty()) return std::nullopt;
  // Those of the plotter: one may have been acquired since the last update.
  std::set<std::uint32_t> shown;
  for (const PlottedTrack& track : plotter.tracks()) shown.insert(track.number);
  for (const Lost& lost : lost_) shown.insert(lost.track.number);
  for (const std::uint32_t number : order.cancel()) {
    if (!shown.contains(number)) return unknown(fmt::format("target {} is not tracked", number));
  }
  return std::nullopt;
}

std::optional<wire::Reply> TargetWatch::Desk::refusal_of_reference(
    const wire::TargetOrder& order) const {
  if (!order.has_reference() || order.reference() == 0) return std::nullopt;
  const Watched* watched = find_watched(order.reference());
  if (watched == nullptr || watched->is_dropped) {
    return unknown(fmt::format("target {} is not tracked", order.reference()));
  }
  if (has_motion(*watched)) return std::nullopt;
  return refused(fmt::format("target {}: its motion is not known; it is after {:.0f} s of tracking",
                             order.reference(), kTrendAfter_s));
}

std::optional<wire::Reply> TargetWatch::Desk::refusal_of_ais(const wire::TargetOrder& order) const {
  for (const auto* numbers : {&order.activate(), &order.let_sleep()}) {
    for (const std::uint32_t mmsi : *numbers) {
      const AisRecord* found = ais_.find(mmsi);
      if (found == nullptr) return unknown(fmt::format("there is no AIS target {}", mmsi));
      if (numbers == &order.let_sleep() && found->guard.is_on()) {
        return refused(fmt::format("AIS target {} is dangerous: it does not sleep", mmsi));
      }
    }
  }
  return std::nullopt;
}

std::optional<wire::Reply> TargetWatch::Desk::refusal_of_alerts(
    const wire::TargetOrder& order) const {
  for (const auto& key : order.acknowledge()) {
    const AlertRow* row = find_alert_row(key.number());
    if (row == nullptr) return unknown(fmt::format("there are no alerts {}", key.number()));
    if (row->priority == wire::ALERT_CAUTION) {
      return refused(fmt::format("alert {} is a caution: it is not acknowledged", key.number()));
    }
    if (key.instance() != 0 && !alerts_.has(key.number(), key.instance())) {
      return unknown(fmt::format("there is no alert {}.{}", key.number(), key.instance()));
    }
  }
  return std::nullopt;
}

std::optional<wire::Reply> TargetWatch::Desk::refusal_of_trial(
    const wire::TargetOrder& order) const {
  if (!order.has_trial()) return std::nullopt;
  if (order.end_trial()) return refused("a trial does not begin and end by one order");
  if (!own_.through_water_mps && !own_.over_ground_mps) {
    return refused("own ship's motion is not known: there can be no trial");
  }
  return std::nullopt;
}

std::optional<wire::Reply> TargetWatch::Desk::refusal_of_acquisition(
    const wire::TargetOrder& order) const {
  if (!order.has_acquire()) return std::nullopt;
  const auto& where = order.acquire();
  const bool polar = where.has_range_nm() && where.has_bearing_deg();
  const bool by_place = where.has_latitude_deg() && where.has_longitude_deg();
  const int given = where.has_range_nm() + where.has_bearing_deg() + where.has_latitude_deg() +
                    where.has_longitude_deg();
  if (polar == by_place || given != 2) {
    return reply_of(wire::Reply::OUT_OF_RANGE,
                    "acquire: give range and bearing, or latitude and longitude");
  }
  if (!plane_ || frozen_since_) {
    return refused("nothing can be acquired: " +
                   (problem().empty() ? "no position yet" : problem()));
  }
  return std::nullopt;
}

// --- doing it

wire::Reply TargetWatch::Desk::order(const wire::TargetOrder& order, Plotter& plotter) {
  if (auto refusal = refusal_of(order, plotter)) return *std::move(refusal);
  // First what may still fail.
  wire::Reply reply;
  if (order.has_acquire()) {
    reply = acquire(order.acquire(), plotter);
    if (reply.code() != wire::Reply::OK) return reply;
  }
  change_rules(order, plotter);
  std::uint32_t acquired = 0;
  std::from_chars(reply.text().data(), reply.text().data() + reply.text().size(), acquired);
  change_targets(order, acquired, plotter);
  if (order.end_trial()) trial_.reset();
  if (order.has_trial()) {
    trial_ = TrialRun{order.trial(), now_ + seconds_as_duration(60.0 * order.trial().delay_min())};
  }
  if (order.has_test_targets()) {
    test_targets_ = order.test_targets();
    if (!test_targets_) test_targets_since_.reset();
  }
  for (const auto& key : order.acknowledge()) alerts_.acknowledge(key.number(), key.instance());
  if (order.silence()) alerts_.silence();
  return reply;
}

wire::Reply TargetWatch::Desk::acquire(const wire::TargetOrder::Acquire& where,
                                       Plotter& plotter) const {
  const GeoPoint place =
      where.has_range_nm()
          ? plane_->to_geo(
                vector_of(where.bearing_deg(), nautical_miles(where.range_nm()).in_metres()))
          : GeoPoint{where.latitude_deg(), wrapped_longitude(where.longitude_deg())};
  const double range_m = length_of(plane_->to_plane(place));
  const std::uint32_t number =
      plotter.tracker().acquire(place, std::max(kReachLeast_m, kReachShare * range_m));
  if (number != 0) return reply_of(wire::Reply::OK, fmt::format("{}", number));
  if (plotter.tracks().size() >= rules_.capacity()) {
    return refused(fmt::format("{} targets are tracked, which is the capacity; cancel one first",
                               rules_.capacity()));
  }
  return unknown("no echo there");
}

void TargetWatch::Desk::change_rules(const wire::TargetOrder& order, Plotter& plotter) {
  if (order.default_rules()) {
    rules_ = default_target_rules();
    zones_.clear();
  }
  rules_.MergeFrom(order.rules());
  for (const std::uint32_t number : order.remove_zones()) zones_.remove(number);
  for (const wire::TargetZone& zone : order.zones()) zones_.put(zone);
  if (order.default_rules() || order.has_rules()) plotter.tracker().change(tracker_rule(rules_));
  plotter.tracker().set_areas(zones_.areas(own_.heading_deg));
}

void TargetWatch::Desk::change_targets(const wire::TargetOrder& order, std::uint32_t acquired,
                                       Plotter& plotter) {
  if (order.has_reference()) set_reference(order.reference());
  for (const std::uint32_t number : order.cancel()) cancel(number, plotter);
  if (order.cancel_all()) {
    std::vector<std::uint32_t> numbers;
    for (const PlottedTrack& track : plotter.tracks()) numbers.push_back(track.number);
    for (const Lost& lost : lost_) numbers.push_back(lost.track.number);
    for (const std::uint32_t number : numbers) {
      if (number != acquired) cancel(number, plotter);
    }
  }
  for (const std::uint32_t mmsi : order.activate()) ais_.records().at(mmsi).is_activated = true;
  for (const std::uint32_t mmsi : order.let_sleep()) ais_.records().at(mmsi).is_activated = false;
}

// A mariner who does so needs no alert of it.
void TargetWatch::Desk::cancel(std::uint32_t number, Plotter& plotter) {
  plotter.tracker().cancel(number);
  if (const auto found = targets_.find(number); found != targets_.end()) {
    if (AisRecord* pair = ais_.find(found->second.mmsi)) pair->target = 0;
    targets_.erase(found);
  }
  std::erase_if(lost_, [&](const Lost& lost) { return lost.track.number == number; });
  alerts_.remove(subject_of_target(number));
  if (reference_ == number) set_reference(0);
}

// What was said of the one before is over.
void TargetWatch::Desk::set_reference(std::uint32_t number) {
  if (number == reference_) return;
  reference_ = number;
  inputs_.erase(kReference);
  alerts_.remove({0, 0, kReference});
}

}  // namespace skerry::server
