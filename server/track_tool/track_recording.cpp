#include "server/track_tool/track_recording.hpp"

#include <algorithm>
#include <utility>

#include "protocol/quantity/speed.hpp"
#include "server/tracking/watch/told_target.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {
namespace {

using recording::Kind;

constexpr int kMostPlots = 4000;  // of one item

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

wire::Target told(const PlottedTrack& track, ScenarioTime now) {
  wire::Target target;
  put_track(track, target);
  target.set_age_s(in_seconds(now - track.last_seen));
  if (track.status == TrackStatus::lost) {
    target.set_state(wire::TARGET_LOST);
    return target;
  }
  target.set_state(target_state(tracked_s(track)));
  if (target.state() == wire::TARGET_ACQUIRING) return target;
  put_motion(track.relative_velocity_mps, track.velocity_mps - track.relative_velocity_mps, target);
  put_approach(closest_approach(track), target);
  return target;
}

}  // namespace

TrackRecording::TrackRecording(const TrackedView& of, TextSink sink)
    : of_(of),
      sink_(std::move(sink)),
      writer_(
          [this](std::span<const std::uint8_t> bytes) {
            sink_(text_of(bytes));
            return true;
          },
          {}) {
  plots_.set_radar(of_.radar);
  plots_.set_view(of_.view);
}

void TrackRecording::plot(const Plot& plot) {
  last_plot_ = since_of(plot.utc, plot.time);
  put_plot(plot, *plots_.add_plots());
  if (plots_.plots_size() >= kMostPlots) write_plots();
}

void TrackRecording::write_plots() {
  if (plots_.plots_size() == 0) return;
  add(Kind::plots, last_plot_, plots_);
  plots_.set_first(plots_.first() + static_cast<std::uint64_t>(plots_.plots_size()));
  plots_.clear_plots();
}

void TrackRecording::turn(std::span<const PlottedTrack> tracked,
                          std::span<const PlottedTrack> lost) {
  write_plots();
  if (tracked.empty() && lost.empty()) return;
  const wire::TargetList list = list_of(tracked, lost);
  add(Kind::targets, Duration(static_cast<std::int64_t>(list.utc_ns())), list);
}

wire::TargetList TrackRecording::list_of(std::span<const PlottedTrack> tracked,
                                         std::span<const PlottedTrack> lost) const {
  // All that are tracked are of the moment to which the plotter has come.
  const PlottedTrack& newest = tracked.empty() ? lost.back() : tracked.front();
  wire::TargetList list;
  list.set_radar(of_.radar);
  list.set_view(of_.view);
  list.set_utc_ns(static_cast<std::uint64_t>(since_of(newest.utc, newest.time).count()));
  list.set_scenario_ns(static_cast<std::uint64_t>(newest.time.time_since_epoch().count()));
  for (const auto& tracks : {tracked, lost}) {
    for (const PlottedTrack& track : tracks) *list.add_targets() = told(track, newest.time);
  }
  std::sort(list.mutable_targets()->begin(), list.mutable_targets()->end(),
            [](const wire::Target& a, const wire::Target& b) { return a.number() < b.number(); });
  list.set_tracked(static_cast<std::uint32_t>(tracked.size()));
  list.set_stabilised_by("GNSS");
  const PlanePoint own_mps = newest.velocity_mps - newest.relative_velocity_mps;
  list.set_own_course_deg(direction_of(own_mps));
  list.set_own_speed_kn(length_of(own_mps) / kKnot);
  list.set_own_latitude_deg(newest.own_ship.latitude_deg);
  list.set_own_longitude_deg(newest.own_ship.longitude_deg);
  list.set_plots(plots_.first());
  return list;
}

void TrackRecording::finish() {
  write_plots();
  if (!begun_) add(Kind::hello, {}, of_.hello);
  writer_.finish();
}

void TrackRecording::add(Kind kind, Duration since, const google::protobuf::MessageLite& message) {
  if (kind != Kind::hello && !std::exchange(begun_, true)) add(Kind::hello, since, of_.hello);
  const std::string bytes = message.SerializeAsString();
  recording::Topic topic{kind};
  if (kind != Kind::hello) topic = {kind, of_.radar, of_.view};
  writer_.add(
      {topic, UtcTime(since), {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
}

}  // namespace skerry::server
