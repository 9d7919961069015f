#include "server/exercise_tool/picture_looks.hpp"

#include <algorithm>

#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr Duration kBetweenBeaconTurns = std::chrono::seconds(5);
constexpr double kMetresPerMicrosecond = 149.9;  // of a beacon's signal, on the picture
constexpr double kSartTrail_m = 14'000.0;        // twelve sweeps out and back

}  // namespace

PictureLooks::PictureLooks(const ExercisePlan& plan, std::size_t radar,
                           std::optional<RangeScale> range, const echo::ChartSource& chart,
                           const World& world)
    : plan_(plan), turns_(plan, radar, range, chart, world) {
  const GeoPoint own = world.state().own_ships.at(turns_.config().own_ship).position;
  const double reach_m = turns_.config().controls.range_scale.length().in_metres();
  land_ = std::make_unique<const LandAround>(chart, own, 1.1 * reach_m + 2000.0);
  for (int i = 0; i < kTurns; ++i) look();
}

void PictureLooks::look() {
  scans_.push_back(turns_.turn());
  states_.push_back(turns_.world().state());
}

std::optional<EchoPlace> PictureLooks::place_of(const std::string& name,
                                                const WorldState& state) const {
  EchoPlace place;
  place.beam_deg = turns_.config().set.beam_width_deg;
  for (int i = 0; i < state.scenario->targets_size(); ++i) {
    const scenario::Target& target = state.scenario->targets(i);
    if (target.name() != name) continue;
    const auto number = static_cast<std::size_t>(i);
    place.position = geo_point(target.position());
    if (target.kind() == scenario::Target::ship) {
      const auto ship = std::find_if(state.targets.begin(), state.targets.end(),
                                     [&](const ShipState& s) { return s.number == number; });
      if (ship == state.targets.end()) return std::nullopt;
      place.position = ship->position;
      place.half_length_m = 0.5 * ship->length_m;
    }
    for (const SmallTargetState& small : state.adrift) {
      if (small.number == number) place.position = small.position;
    }
    return place;
  }
  for (const scenario::Racon& racon : state.scenario->racons()) {
    if (racon.name() != name) continue;
    place.sort = EchoPlace::Sort::racon;
    place.position = geo_point(racon.position());
    place.trail_m = (racon.delay_us() + racon.length_us()) * kMetresPerMicrosecond;
    return place;
  }
  const std::size_t carried =
      state.sarts.size() - static_cast<std::size_t>(state.scenario->sarts_size());
  for (int i = 0; i < state.scenario->sarts_size(); ++i) {
    if (state.scenario->sarts(i).name() != name) continue;
    place.sort = EchoPlace::Sort::sart;
    place.position = state.sarts.at(carried + static_cast<std::size_t>(i)).position;
    place.trail_m = kSartTrail_m;
    return place;
  }
  return std::nullopt;
}

EchoStand PictureLooks::seen(const std::string& name) {
  const auto is_land = [this](GeoPoint at) { return land_->is_land(at); };
  EchoStand best{false, "is not on the water"};
  for (std::size_t i = 0; i < kTurns + kBeaconTurns; ++i) {
    if (i == scans_.size()) {
      turns_.pass(kBetweenBeaconTurns);
      look();
    }
    const auto place = place_of(name, states_[i]);
    if (!place) continue;
    if (i >= kTurns && place->sort == EchoPlace::Sort::hull) break;
    best = stand_of(*place, scans_[i], is_land);
    if (best.stands_out) return best;
  }
  return best;
}

LitShares PictureLooks::shares(double within_m) {
  return lit_shares(scans_.front(), within_m, [this](GeoPoint at) { return land_->is_land(at); });
}

}  // namespace skerry::server
