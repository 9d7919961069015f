#include "server/net/outputs/datagram_pacer.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace skerry::server {

void DatagramPacer::on_sector(SteadyTime arrival, ScenarioTime first, ScenarioTime last) {
  const Duration behind = arrival.time_since_epoch() - last.time_since_epoch();
  if (!begun_ || behind < behind_ || behind > behind_ + kStep) behind_ = behind;
  begun_ = true;
  first_ = first;
  length_ = last - first;
  latest_ = arrival + kMargin + length_;
}

DatagramPacer::SteadyTime DatagramPacer::leaves(ScenarioTime at) const {
  Duration into = at - first_;
  if (burst_ > Duration::zero()) into = into / burst_ * burst_;
  const Duration when = first_.time_since_epoch() + into + length_ + behind_ + kMargin;
  return std::min(latest_, SteadyTime(when));
}

SectorEncoder timed_encoder(SectorEncoder inner) {
  return [inner = std::move(inner), one = Sector{}](const Sector& sector) mutable {
    auto whole = std::make_shared<EncodedSector>();
    if (!sector.spokes.empty()) {
      whole->reach_m = sector.spokes.front()->header.reach().in_metres();
    }
    for (const SpokePtr& spoke : sector.spokes) {
      one.spokes.assign(1, spoke);
      const EncodedSectorPtr part = inner(one);
      if (part == nullptr || part->spoke_ends.empty()) continue;
      if (whole->spoke_ends.empty()) {
        whole->first_sequence = part->first_sequence;
        whole->scan = part->scan;
      }
      const auto shift = static_cast<std::uint32_t>(whole->bytes.size()) - part->begin;
      for (const std::uint32_t end : part->spoke_ends) {
        whole->spoke_ends.push_back(end + shift);
        whole->times.completed.push_back(spoke->header.scenario_time);
      }
      whole->bytes.insert(whole->bytes.end(), part->bytes.begin() + part->begin,
                          part->bytes.begin() + part->spoke_ends.back());
    }
    one.spokes.clear();
    if (!sector.spokes.empty()) {
      whole->times.first = sector.spokes.front()->header.scenario_time;
      whole->times.last = sector.spokes.back()->header.scenario_time;
    }
    return EncodedSectorPtr(std::move(whole));
  };
}

}  // namespace skerry::server
