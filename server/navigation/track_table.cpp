#include "server/navigation/track_table.hpp"

#include <algorithm>
#include <unordered_map>

namespace skerry::server {
namespace {

bool is_trackable(const TrafficItem& item) {
  return item.kind == TrafficKind::ship || item.kind == TrafficKind::boat;
}

}  // namespace

std::vector<Track> TrackTable::update(GeoPoint own, std::span<const TrafficItem> traffic,
                                      ScenarioTime now) {
  struct Seen {
    const TrafficItem* item;
    TargetPlace place;
    bool tracked = false;
  };
  std::unordered_map<std::uint32_t, Seen> seen;  // by the scenario's number
  for (const TrafficItem& item : traffic) {
    if (!is_trackable(item)) continue;
    const TargetPlace place = place_of(item.position, own);
    if (place.range_m <= range_m_ * kHysteresis) seen.insert({item.number, {&item, place}});
  }

  std::size_t tracked = 0;
  for (auto at = tracks_.begin(); at != tracks_.end();) {
    Kept& kept = at->second;
    const auto found = seen.find(kept.track.target.number);
    if (!kept.track.lost && found != seen.end()) {
      kept.track.target = *found->second.item;
      kept.track.place = found->second.place;
      found->second.tracked = true;
      ++tracked;
    } else if (!kept.track.lost) {
      kept.track.lost = true;
      kept.lost_at = now;
    } else if (now - kept.lost_at >= lost_for_) {
      at = tracks_.erase(at);
      continue;
    }
    ++at;
  }

  std::vector<const Seen*> found;
  for (const auto& [number, one] : seen) {
    if (!one.tracked && one.place.range_m <= range_m_) found.push_back(&one);
  }
  std::sort(found.begin(), found.end(), [](const Seen* a, const Seen* b) {
    return a->place.range_m != b->place.range_m ? a->place.range_m < b->place.range_m
                                                : a->item->number < b->item->number;
  });
  unsigned number = 1;
  for (const Seen* one : found) {
    if (tracked == most_) break;
    while (tracks_.contains(number)) ++number;
    if (number > 99) break;
    tracks_[number] = {.track = {.number = number, .target = *one->item, .place = one->place}};
    ++tracked;
  }

  std::vector<Track> tracks;
  for (const auto& [unused, kept] : tracks_) tracks.push_back(kept.track);
  return tracks;
}

}  // namespace skerry::server
