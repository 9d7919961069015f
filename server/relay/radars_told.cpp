#include "server/relay/radars_told.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/video/range_scale.hpp"
#include "protocol/video/scan_geometry.hpp"
#include "protocol/wire/printable_text.hpp"
#include "server/relayed/values_in_range.hpp"

namespace skerry::server {
namespace {

bool has_own_scales(const wire::Hello& hello) {
  const auto& own = RangeScale::kNauticalMiles;
  return std::equal(own.begin(), own.end(), hello.range_scales_nm().begin(),
                    hello.range_scales_nm().end(),
                    [](double a, double b) { return std::abs(a - b) < 1e-9; });
}

std::string radar_in_words(const wire::RadarInfo& radar) {
  return fmt::format("'{}' on {}", printable(radar.name(), 40), printable(radar.own_ship(), 40));
}

}  // namespace

std::optional<std::string> why_not_relayed(const wire::Hello& hello, const std::string& identity,
                                           const std::string& name) {
  if (!identity.empty() && hello.identity() == identity) {
    return fmt::format("{} is this server itself: a relay needs another server before it", name);
  }
  if (is_in_loop(hello, identity)) {
    return fmt::format(
        "a loop: {} relays this server, directly or through others; give one of them another "
        "server to relay",
        name);
  }
  if (hello.relays_size() >= kMostHops) {
    return fmt::format("{} is the {}th relay in a row; at most {} may follow one another", name,
                       hello.relays_size() + 1, kMostHops);
  }
  if (is_waiting(hello)) {
    return fmt::format("{} has no radars yet: it is a relay that waits for its own server", name);
  }
  if (hello.radars().empty()) return fmt::format("{} has no radars", name);
  if (hello.radars_size() > kMostRadars) {
    return fmt::format("{} has {} radars; at most {} can be relayed", name, hello.radars_size(),
                       kMostRadars);
  }
  for (int i = 0; i < hello.radars_size(); ++i) {
    if (hello.radars(i).radar() == static_cast<std::uint32_t>(i)) continue;
    return fmt::format("the radars of {} are not numbered 0 to {}", name, hello.radars_size() - 1);
  }
  if (!has_own_scales(hello)) return fmt::format("{} has other range scales than this one", name);
  return std::nullopt;
}

bool is_in_loop(const wire::Hello& hello, const std::string& identity) {
  if (identity.empty()) return false;
  const auto& relays = hello.relays();
  return hello.identity() == identity ||
         std::any_of(relays.begin(), relays.end(),
                     [&](const wire::Hop& hop) { return hop.identity() == identity; });
}

bool is_waiting(const wire::Hello& hello) {
  return hello.radars().empty() && !hello.identity().empty();
}

std::vector<wire::RadarInfo> radars_of(const wire::Hello& hello) {
  std::vector<wire::RadarInfo> radars(hello.radars().begin(), hello.radars().end());
  for (wire::RadarInfo& radar : radars) {
    bring_into_range(radar);
    radar.set_spokes_per_turn(
        std::clamp(radar.spokes_per_turn(), ScanGeometry::kMinSpokes, ScanGeometry::kMaxSpokes));
    radar.set_cells(std::clamp(radar.cells(), ScanGeometry::kMinCells, ScanGeometry::kMaxCells));
    radar.set_bits(radar.bits() == 4 ? 4 : 8);
    radar.set_board(false);
  }
  return radars;
}

std::vector<bool> still_there(const std::vector<wire::RadarInfo>& before,
                              const std::vector<wire::RadarInfo>& now) {
  std::vector<bool> there;
  for (std::size_t i = 0; i < before.size(); ++i) {
    there.push_back(i < now.size() && now[i].name() == before[i].name() &&
                    now[i].own_ship() == before[i].own_ship());
  }
  return there;
}

std::string changes_told(const std::vector<wire::RadarInfo>& before,
                         const std::vector<wire::RadarInfo>& now) {
  std::string text;
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  const std::vector<bool> there = still_there(before, now);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (there[i]) continue;
    const std::string is = i < now.size() ? "is now " + radar_in_words(now[i]) : "is gone";
    add(fmt::format("radar {}, {}, {}", i, radar_in_words(before[i]), is));
  }
  if (now.size() > before.size()) {
    add(before.size() + 1 == now.size()
            ? fmt::format("radar {} is new", before.size())
            : fmt::format("radars {} to {} are new", before.size(), now.size() - 1));
  }
  if (text.empty()) return text;
  return text + ": these are not relayed; start this relay again to have them";
}

}  // namespace skerry::server
