#include "server/app/joined_host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace skerry::server {
namespace {

constexpr char kOverlayFormat[] = "laid over";
constexpr char kOverlayOrigin[] = "the input of a real radar";

// Whether it changes the world and nothing of a radar.
bool is_of_the_world(wire::Set set) {
  if (!set.has_world() && !set.has_exercise()) return false;
  set.clear_world();
  set.clear_exercise();
  set.clear_radar();
  set.clear_view();
  set.clear_token();
  set.clear_instructor();
  return set.ByteSizeLong() == 0;
}

// Entries of both in the order of their radars; of one that both have, the real one's.
template <typename Entries>
void join(Entries& all, const Entries& live, const LiveHost& host) {
  Entries joined;
  for (const auto& each : all) {
    if (!host.has(each.radar())) *joined.Add() = each;
  }
  for (const auto& each : live) *joined.Add() = each;
  std::sort(joined.begin(), joined.end(),
            [](const auto& a, const auto& b) { return a.radar() < b.radar(); });
  all = joined;
}

}  // namespace

JoinedHost::JoinedHost(RadarHost& simulated, LiveHost& live)
    : simulated_(simulated),
      live_(live),
      count_(std::max(simulated.radar_count(), live.radar_count())) {
  for (std::uint32_t radar = 0; radar < count_; ++radar) {
    if (radar >= simulated.radar_count() && !live.has(radar)) {
      throw std::runtime_error(fmt::format(
          "input of radar {}: there is no radar {} before it; a real radar takes the place of a "
          "simulated one, 0 to {}, or has the next number",
          count_ - 1, radar, simulated.radar_count() - 1));
    }
    if (live.has(radar) && live.wants_simulated(radar)) lay_over(radar);
    if (!live.has(radar) || radar >= simulated.radar_count() || live.wants_simulated(radar))
      continue;
    wire::Set silent;
    silent.set_radar(radar);
    silent.set_transmit(false);
    silent.set_instructor(true);
    simulated.apply(silent, kOverlayOrigin);
  }
}

void JoinedHost::lay_over(std::uint32_t radar) {
  if (radar >= simulated_.radar_count()) {
    throw std::runtime_error(fmt::format(
        "input of radar {}: simulated=true lays the simulated radar of that number over it; there "
        "are 0 to {}",
        radar, simulated_.radar_count() - 1));
  }
  auto made = std::make_unique<Overlay>();
  Overlay& overlay = *made;
  overlay.radar = radar;
  const auto take = [&overlay](const Sector& sector) -> EncodedSectorPtr {
    overlay.echoes.take(sector);
    auto none = std::make_shared<EncodedSector>();
    none->spoke_ends.assign(sector.spokes.size(), 0);
    return none;
  };
  const auto view = simulated_.open_view(
      radar, 0, true, [&](VideoChannel& video) { video.add_format(kOverlayFormat, take); });
  if (!view) throw std::runtime_error(fmt::format("radar {} has as many views as it may", radar));
  overlay.channel = simulated_.find_channel(radar, *view);
  overlay.registered = overlay.channel->format(kOverlayFormat).on_publish([] {});
  // What the real receiver makes of noise is in its picture already.
  wire::Set quiet;
  quiet.set_radar(radar);
  quiet.set_transmit(true);
  quiet.set_noise_rejection(100.0);
  quiet.set_instructor(true);
  simulated_.apply(quiet, kOverlayOrigin);
  live_.add_to_spokes(radar, [this, &overlay](std::vector<Spoke>& spokes, bool heading_known) {
    follow_range(overlay, spokes.back().header);
    overlay.echoes.add_to(spokes, heading_known);
  });
  overlays_.push_back(std::move(made));
}

// The smallest range scale that holds the real one's spokes.
void JoinedHost::follow_range(Overlay& overlay, const SpokeHeader& real) {
  const double reach_nm = real.reach().in_nautical_miles();
  const auto& scales = RangeScale::kNauticalMiles;
  const auto holds = std::find_if(scales.begin(), scales.end(),
                                  [&](double nm) { return nm >= reach_nm * (1.0 - 1e-9); });
  const double range_nm = holds == scales.end() ? scales.back() : *holds;
  if (std::exchange(overlay.range_nm, range_nm) == range_nm) return;
  wire::Set set;
  set.set_radar(overlay.radar);
  set.set_range_nm(range_nm);
  set.set_instructor(true);
  simulated_.apply(set, kOverlayOrigin);
}

RadarHost& JoinedHost::of(std::uint32_t radar) const {
  return live_.has(radar) ? static_cast<RadarHost&>(live_) : simulated_;
}

wire::Hello JoinedHost::hello() const {
  wire::Hello hello = simulated_.hello();
  join(*hello.mutable_radars(), live_.hello().radars(), live_);
  return hello;
}

VideoChannelPtr JoinedHost::find_channel(std::uint32_t radar, std::uint32_t view) {
  return of(radar).find_channel(radar, view);
}

std::optional<std::uint32_t> JoinedHost::open_view(
    std::uint32_t radar, std::uint32_t like, bool follows,
    const std::function<void(VideoChannel&)>& prepare) {
  return of(radar).open_view(radar, like, follows, prepare);
}

void JoinedHost::close_view(std::uint32_t radar, std::uint32_t view) {
  of(radar).close_view(radar, view);
}

std::vector<RadarHost::View> JoinedHost::views(std::uint32_t radar) {
  return of(radar).views(radar);
}

std::uint64_t JoinedHost::views_version() const {
  return simulated_.views_version() + live_.views_version();
}

BoardPortPtr JoinedHost::find_board(std::uint32_t radar) {
  return live_.has(radar) ? nullptr : simulated_.find_board(radar);
}

wire::Reply JoinedHost::apply(const wire::Set& set, const std::string& origin) {
  if (!live_.has(set.radar())) return simulated_.apply(set, origin);
  if (!is_of_the_world(set)) return live_.apply(set, origin);
  wire::Set world = set;  // any simulated radar will do
  world.set_radar(std::min(set.radar(), simulated_.radar_count() - 1));
  world.clear_view();
  return simulated_.apply(world, origin);
}

std::vector<TrafficItem> JoinedHost::traffic() const {
  std::vector<TrafficItem> items = simulated_.traffic();
  std::erase_if(items, [this](TrafficItem& item) {
    const bool had = !item.radars.empty();
    std::erase_if(item.radars, [this](std::uint32_t radar) { return live_.has(radar); });
    return had && item.radars.empty();
  });
  return items;
}

std::optional<std::string> JoinedHost::drive(std::uint32_t radar, const OwnShipFix& fix) {
  if (live_.has(radar) && live_.wants_simulated(radar)) simulated_.drive(radar, fix);
  return of(radar).drive(radar, fix);
}

wire::Settings JoinedHost::settings(std::uint32_t radar, std::uint32_t view) const {
  return of(radar).settings(radar, view);
}

wire::OwnShip JoinedHost::own_ship(std::uint32_t radar) const { return of(radar).own_ship(radar); }

wire::Status JoinedHost::status() const {
  wire::Status status = simulated_.status();
  const wire::Status live = live_.status();
  join(*status.mutable_radars(), live.radars(), live_);
  status.mutable_outputs()->MergeFrom(live.outputs());
  return status;
}

std::uint64_t JoinedHost::settings_version() const {
  return simulated_.settings_version() + live_.settings_version();
}

}  // namespace skerry::server
