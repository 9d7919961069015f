#include "protocol/video/spoke_resampler.hpp"

#include <algorithm>

namespace skerry {
namespace {

// The part of `to` in whose middle's share the middle of part `index` of `from` lies.
std::uint32_t share_of(std::uint64_t index, std::uint64_t from, std::uint64_t to) {
  return static_cast<std::uint32_t>((2 * index + 1) * to / (2 * from));
}

}  // namespace

CellShares::CellShares(std::uint32_t from, std::uint32_t to)
    : from_(from), to_(to), gathers_(from > to) {
  if (!gathers_) {
    bounds_.resize(to);
    for (std::uint32_t c = 0; c < to; ++c) bounds_[c] = share_of(c, to, from);
    return;
  }
  bounds_.assign(to + 1, from);
  for (std::uint32_t j = from; j-- > 0;) bounds_[share_of(j, from, to)] = j;
}

SpokeResampler::SpokeResampler(std::uint32_t turn_spokes, std::uint32_t cells)
    : turn_spokes_(turn_spokes), cells_(cells), held_(cells) {}

std::uint32_t SpokeResampler::target_of(std::uint32_t index) const {
  return share_of(index, last_.geometry.spokes_per_turn, turn_spokes_);
}

bool SpokeResampler::goes_on(const SpokeHeader& next) const {
  return next.sequence == last_.sequence + 1 && next.geometry == last_.geometry &&
         next.range_scale == last_.range_scale &&
         next.instrumented_range == last_.instrumented_range && next.view == last_.view &&
         next.index == (last_.index + 1) % last_.geometry.spokes_per_turn;
}

void SpokeResampler::take_in(const Spoke& spoke) {
  const bool moves = !spoke.doppler.empty();
  if (!holding_) {
    std::fill(held_.begin(), held_.end(), std::uint8_t{0});
    held_doppler_.clear();
  }
  if (moves && held_doppler_.empty()) held_doppler_.assign(cells_, DopplerClass::none);
  holding_ = true;
  if (shares_.keeps() && !moves) {
    for (std::uint32_t c = 0; c < cells_; ++c) held_[c] = std::max(held_[c], spoke.cells[c]);
    return;
  }
  for (std::uint32_t c = 0; c < cells_; ++c) {
    std::uint8_t strongest = held_[c];
    for (std::uint32_t j = shares_.begin(c); j < shares_.end(c); ++j) {
      if (moves && (spoke.cells[j] > strongest || (spoke.cells[j] == strongest && strongest > 0 &&
                                                   held_doppler_[c] == DopplerClass::none))) {
        held_doppler_[c] = spoke.doppler[j];
      }
      strongest = std::max(strongest, spoke.cells[j]);
    }
    held_[c] = strongest;
  }
}

void SpokeResampler::give(std::uint32_t index, const Sink& sink) {
  SpokeHeader header = last_;
  header.index = index;
  header.geometry.spokes_per_turn = turn_spokes_;
  header.geometry.cells = cells_;
  sink({header, held_, held_doppler_});
  holding_ = false;
}

void SpokeResampler::add(const Spoke& spoke, const Sink& sink) {
  if (holding_ && !goes_on(spoke.header)) give(target_of(last_.index), sink);
  if (shares_.from() != spoke.header.geometry.cells) {
    shares_ = CellShares(spoke.header.geometry.cells, cells_);
  }
  last_ = spoke.header;
  take_in(spoke);

  const std::uint32_t source_spokes = spoke.header.geometry.spokes_per_turn;
  if (source_spokes >= turn_spokes_) {
    const std::uint32_t mine = target_of(spoke.header.index);
    const bool is_last =
        spoke.header.index + 1 == source_spokes || target_of(spoke.header.index + 1) != mine;
    if (is_last) give(mine, sink);
    return;
  }
  // Every target spoke whose middle lies in this one of the source.
  std::uint32_t index = share_of(spoke.header.index, source_spokes, turn_spokes_);
  while (index > 0 && share_of(index - 1, turn_spokes_, source_spokes) == spoke.header.index) {
    --index;
  }
  for (; index < turn_spokes_ && share_of(index, turn_spokes_, source_spokes) == spoke.header.index;
       ++index) {
    give(index, sink);
  }
}

}  // namespace skerry
