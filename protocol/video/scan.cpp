#include "protocol/video/scan.hpp"

#include <utility>

namespace skerry {

bool Scan::has_one_range_scale() const {
  const Spoke* last = newest();
  if (!last) return false;
  for (const auto& spoke : spokes) {
    if (spoke && spoke->header.range_scale != last->header.range_scale) return false;
  }
  return true;
}

const Spoke* Scan::newest() const {
  for (auto spoke = spokes.rbegin(); spoke != spokes.rend(); ++spoke) {
    if (*spoke) return &**spoke;
  }
  return nullptr;
}

bool ScanAssembler::belongs(const SpokeHeader& header) const {
  return header.scan == scan_.number && header.geometry == scan_.geometry;
}

void ScanAssembler::begin(const SpokeHeader& header) {
  scan_ = Scan{.radar = header.radar,
               .view = header.view,
               .number = header.scan,
               .geometry = header.geometry,
               .spokes = std::vector<std::optional<Spoke>>(header.geometry.spokes_per_turn),
               .received = 0};
}

Scan ScanAssembler::hand_out() {
  last_number_ = scan_.number;
  return std::exchange(scan_, Scan{});
}

std::optional<Scan> ScanAssembler::feed(Spoke spoke) {
  const SpokeHeader header = spoke.header;
  std::optional<Scan> finished;
  if (scan_.received > 0 && !belongs(header)) {
    if (header.scan == last_number_) {
      ++dropped_;
      return std::nullopt;
    }
    finished = hand_out();
  }
  if (scan_.received == 0) {
    if (header.scan == last_number_ && !finished) {
      ++dropped_;
      return std::nullopt;
    }
    begin(header);
  }
  auto& place = scan_.spokes[header.index];
  if (place) {
    ++dropped_;
    return finished;
  }
  place = std::move(spoke);
  ++scan_.received;
  if (!finished && scan_.is_complete()) finished = hand_out();
  return finished;
}

}  // namespace skerry
