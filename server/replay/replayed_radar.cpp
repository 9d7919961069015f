#include "server/replay/replayed_radar.hpp"

#include <fmt/format.h>

#include <utility>

#include "server/replay/input_messages.hpp"

namespace skerry::server {

ReplayedRadar::ReplayedRadar(const RadarConfig& config, std::size_t workers,
                             const RadarInputs& inputs, const echo::ChartSource& chart,
                             const echo::CoastRules& rules, EmissionHistory& emissions)
    : config_(config),
      inputs_(inputs),
      emissions_(emissions),
      maker_(config, workers),
      pictures_(chart, rules) {
  const auto want = [this](const recording::Input::Taken& taken) {
    if (!taken.has_coast()) return;
    wanted_.insert({taken.coast().wish(), taken.coast().laid()});
  };
  want(*inputs_.warm_up);
  for (const auto& [first, taken] : inputs_.taken) want(taken);
  given_.radar = config.radar_controls;
  given_.on_air = config.controls.range_scale;
  given_.views = {{0, config.controls}};
  emissions_.set(config.radar, maker_.emission(config.radar_controls, config.controls.range_scale));
}

void ReplayedRadar::ask_for_coast(const WorldState& state) {
  wishes_[0] = maker_.wish(state.own_ships[config_.own_ship], given_.views, 0);
}

void ReplayedRadar::warm_up(const WorldStatePtr& state) {
  take(*inputs_.warm_up);
  given_.state = state;
  if (!coast_wanted_ || !emissions_wanted_ || *emissions_wanted_ > emissions_.latest()) {
    throw ReplayError("a radar's first inputs are not whole");
  }
  see_coast(*std::exchange(coast_wanted_, std::nullopt));
  given_.emissions = emissions_.at(*emissions_wanted_);
  maker_.warm_up(given_);
}

const recording::Input::Taken* ReplayedRadar::taken_at(std::uint64_t first) const {
  const auto found = inputs_.taken.find(first);
  return found == inputs_.taken.end() ? nullptr : &found->second;
}

void ReplayedRadar::take(const recording::Input::Taken& taken) {
  const auto wrong = [&](const char* what) {
    return ReplayError(
        fmt::format("radar {}, spoke {}: {} that cannot be", config_.radar, taken.first(), what));
  };
  if (taken.has_controls()) {
    auto controls = controls_of(taken.controls());
    if (!controls) throw wrong("controls");
    given_.radar = *std::move(controls);
  }
  if (taken.views_size() > 0) {
    given_.views.clear();
    for (const recording::Input::View& message : taken.views()) {
      const auto view = view_of(message);
      if (!view) throw wrong("a view's controls");
      given_.views.push_back(*view);
    }
    if (given_.views.front().number != 0) throw wrong("a first view with a number");
  }
  if (taken.has_range_scale()) {
    const auto range = RangeScale::from_index(taken.range_scale());
    if (!range) throw wrong("a range scale");
    given_.on_air = *range;
  }
  if (taken.has_coast()) {
    coast_wanted_ = PictureOrigin{taken.coast().wish(), taken.coast().laid()};
  }
  if (taken.has_emissions()) emissions_wanted_ = taken.emissions();
  if (taken.has_numbered_from()) given_.numbered_from = taken.numbered_from();
  if (taken.has_utc()) {
    utc_ = clock_of(taken.utc());
    if (!utc_) throw wrong("a clock");
  }
}

const CoastWish& ReplayedRadar::wish_of(std::uint64_t tag) const {
  const auto found = wishes_.find(tag);
  if (found == wishes_.end()) {
    throw ReplayError(
        fmt::format("radar {}: a picture of the coast that was asked for at spoke "
                    "{}, where nothing was asked",
                    config_.radar, tag - 1));
  }
  return found->second;
}

void ReplayedRadar::see_coast(const PictureOrigin& origin) {
  if (laid_ != origin.laid) {
    pictures_.lay(wish_of(origin.laid));
    laid_ = origin.laid;
  }
  const CoastWish& wish = wish_of(origin.wish);
  if (!pictures_.serves(wish)) {
    throw ReplayError("a picture of a coast that its chart does not reach");
  }
  given_.coast =
      std::make_shared<const CoastInSight>(seen_from(pictures_.picture(wish), wish, origin));
  wishes_.erase(wishes_.begin(), wishes_.lower_bound(std::min(origin.wish, origin.laid)));
}

bool ReplayedRadar::is_ready() const {
  const recording::Input::Taken* taken = taken_at(next_);
  if (taken == nullptr) return true;
  if (taken->emits()) return taken->emissions() == emissions_.latest() + 1;
  return !taken->has_emissions() || taken->emissions() <= emissions_.latest();
}

void ReplayedRadar::step(ReplayedWorld& world, UtcTime epoch, std::vector<ViewSector>& out) {
  out.clear();
  const std::uint64_t first = std::exchange(next_, next_ + SectorMaker::kSectorSpokes);
  const recording::Input::Taken* taken = taken_at(first);
  if (taken != nullptr) take(*taken);
  maker_.turn(first, given_.radar);
  if (inputs_.is_skipped(first)) return;
  given_.state = world.at(maker_.clock().time_of(first));
  if (wanted_.count(first + 1) > 0) {
    wishes_[first + 1] =
        maker_.wish(given_.state->own_ships[config_.own_ship], given_.views, first + 1);
  }
  if (coast_wanted_) see_coast(*std::exchange(coast_wanted_, std::nullopt));
  const bool emits = emissions_.set(config_.radar, maker_.emission(given_.radar, given_.on_air));
  if (emits != (taken != nullptr && taken->emits())) {
    throw ReplayError(fmt::format("radar {}, spoke {}: what it has on the air is not what it had",
                                  config_.radar, first));
  }
  given_.emissions = emissions_.at(*emissions_wanted_);
  given_.utc = utc_.value_or(UtcClock{{}, epoch});
  maker_.make(first, given_, out);
}

}  // namespace skerry::server
