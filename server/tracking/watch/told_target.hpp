// What a plotter found, in the words of the protocol (targets.proto).
#pragma once

#include <optional>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/wire/targets.pb.h"
#include "server/plotter/plots/plot.hpp"
#include "server/plotter/tracks/track.hpp"

namespace skerry::server {

// Tracked for so long: courses and speeds are a trend, and then of full accuracy.
inline constexpr double kTrendAfter_s = 60.0, kTrackedAfter_s = 180.0;
wire::TargetState target_state(double tracked_s);
double tracked_s(const PlottedTrack& track);

// m east and north.
PlanePoint from_own_ship(const PlottedTrack& track);

void put_place(GeoPoint place, PlanePoint from_own_ship, wire::Target& target);
// Number, place, echo, hits and how sure they are; nothing of its motion, state and age.
void put_track(const PlottedTrack& track, wire::Target& target);
// `own_mps`: what own ship's motion is in the stabilisation in use; nothing: course and speed are
// absent.
void put_motion(PlanePoint relative_mps, std::optional<PlanePoint> own_mps, wire::Target& target);

// Of tracked and of AIS targets.
template <typename Target>
void put_approach(const PlottedApproach& approach, Target& target) {
  target.set_cpa_nm(approach.range_m / 1852.0);
  if (approach.moves) target.set_tcpa_min(approach.time_s / 60.0);
}

void put_plot(const Plot& plot, wire::TargetPlot& told);

}  // namespace skerry::server
