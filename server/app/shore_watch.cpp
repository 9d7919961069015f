#include "server/app/shore_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "server/world/hull_outline.hpp"
#include "server/world/short_way.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

double metres_of_way(GeoPoint from, GeoPoint to) {
  const ShortWay way = short_way_between(from, to);
  return std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
}

// The ship a share of the way from one look to the next.
ShipState between(const ShipState& from, const ShipState& to, double share) {
  const ShortWay way = short_way_between(from.position, to.position);
  ShipState ship = to;
  ship.position = advanced(from.position, {share * way.north_m, share * way.east_m});
  ship.heading_deg =
      from.heading_deg + share * std::remainder(to.heading_deg - from.heading_deg, 360.0);
  return ship;
}

}  // namespace

bool is_on_land(const ShipState& ship, const LandAround& land) {
  const HullOutline outline = hull_outline(ship.length_m, ship.beam_m, ship.heading_deg);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PlanePoint from = outline[i], side = outline[(i + 1) % outline.size()] - from;
    const int points = 1 + static_cast<int>(length_of(side) / ShoreWatch::kSpacing_m);
    for (int k = 0; k < points; ++k) {
      const PlanePoint at = from + side * (static_cast<double>(k) / points);
      if (land.is_land(advanced(ship.position, {at.north_m, at.east_m}))) return true;
    }
  }
  return false;
}

ShoreWatch::ShoreWatch(Survey survey, Aground aground)
    : survey_(std::move(survey)), aground_(std::move(aground)) {}

void ShoreWatch::take_answer(const WorldState& state) {
  std::unique_ptr<const Window> window;
  {
    const std::lock_guard lock(answer_->mutex);
    window = std::move(answer_->window);
    if (std::exchange(answer_->failed, false)) patience_ = kPatience;
  }
  if (patience_ > 0) --patience_;
  if (!window) return;
  std::erase_if(windows_, [&](const auto& old) {
    return std::none_of(state.own_ships.begin(), state.own_ships.end(), [&](const auto& ship) {
      return metres_of_way(old->centre, ship.position) < kWindow_m;
    });
  });
  windows_.push_back(std::move(window));
}

const LandAround* ShoreWatch::land_at(GeoPoint place) {
  const Window* nearest = nullptr;
  double nearest_m = kWindow_m - 500.0;  // her outline is within, too
  for (const auto& window : windows_) {
    const double away_m = metres_of_way(window->centre, place);
    if (away_m >= nearest_m) continue;
    nearest_m = away_m;
    nearest = window.get();
  }
  if ((nearest == nullptr || nearest_m > kNewWindow_m) && patience_ == 0) {
    bool ask = false;
    {
      const std::lock_guard lock(answer_->mutex);
      ask = !std::exchange(answer_->asked, true);
    }
    if (ask) {
      survey_(place, metres(kWindow_m),
              [answer = answer_, place](std::optional<echo::CoastChart> chart) {
                std::unique_ptr<const Window> window;
                if (chart) window = std::make_unique<const Window>(*std::move(chart), place);
                const std::lock_guard lock(answer->mutex);
                answer->asked = false;
                answer->failed = !window;
                if (window) answer->window = std::move(window);
              });
    }
  }
  return nearest == nullptr ? nullptr : &nearest->land;
}

void ShoreWatch::look(const WorldState& state) {
  take_answer(state);
  watched_.resize(state.own_ships.size());
  for (std::size_t i = 0; i < watched_.size(); ++i) look(watched_[i], state.own_ships[i], i);
}

void ShoreWatch::look(Watched& watched, const ShipState& ship, std::size_t number) {
  if (ship.aground) {
    watched = {};
    return;
  }
  double gone_m = watched.last ? metres_of_way(watched.last->position, ship.position) : 0.0;
  // What she can have sailed since she was looked at: less than kSpacing_m and a tick.
  const double sailed_m =
      kSpacing_m + 10.0 + 2.0 * std::fabs(ship.speed_mps) * ship.pace * in_seconds(World::kTick);
  if (gone_m > (ship.driven ? kMostStep_m : std::min(kMostStep_m, sailed_m))) {
    watched = {};
    gone_m = 0.0;
  }
  if (watched.last) {
    const double turned =
        std::fabs(std::remainder(ship.heading_deg - watched.last->heading_deg, 360.0));
    const double swung_m = 0.5 * ship.length_m * degrees(turned).in_radians();
    if (std::max(gone_m, swung_m) < kSpacing_m) return;
  }
  const LandAround* const land = land_at(ship.position);
  if (land == nullptr) return;
  const ShipState from = watched.last.value_or(ship);
  const int looks = 1 + static_cast<int>(gone_m / kSpacing_m);
  watched.last = ship;
  for (int k = 1; k <= looks; ++k) {
    const bool touches = is_on_land(between(from, ship, static_cast<double>(k) / looks), *land);
    if (touches && watched.clear) {
      watched.clear = false;
      aground_(number, ship.position);
      return;
    }
    watched.clear = !touches;
  }
}

}  // namespace skerry::server
