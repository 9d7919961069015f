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
    : turn_spokes_(turn_spokes), cells_(cells) {}

std::uint32_t SpokeResampler::target_of(std::uint32_t index) const {
  return share_of(index, last_.geometry.spokes_per_turn, turn_spokes_);
}

bool SpokeResampler::goes_on(const SpokeHeader& next) const {
  return next.sequence == last_.sequence + 1 && next.geometry == last_.geometry &&
         next.range_scale == last_.range_scale &&
         next.instrumented_range == last_.instrumented_range && next.view == last_.view &&
         next.index == (last_.index + 1) % last_.geometry.spokes_per_turn;
}

// Held in the source's cells: the strongest of several spokes are found 32 cells at a time, and
// cells are put together once for each spoke that is given.
void SpokeResampler::take_in(const Spoke& spoke) {
  const bool moves = !spoke.doppler.empty();
  if (!holding_) {
    held_.assign(spoke.cells.begin(), spoke.cells.end());
    held_doppler_.assign(spoke.doppler.begin(), spoke.doppler.end());
    holding_ = true;
    return;
  }
  if (moves && held_doppler_.empty()) held_doppler_.assign(held_.size(), DopplerClass::none);
  for (std::size_t j = 0; moves && j < held_.size(); ++j) {
    const bool as_strong = spoke.cells[j] == held_[j] && held_doppler_[j] == DopplerClass::none;
    if (spoke.cells[j] > held_[j] || as_strong) held_doppler_[j] = spoke.doppler[j];
  }
  const std::uint8_t* const from = spoke.cells.data();
  std::uint8_t* const to = held_.data();
  const std::size_t count = held_.size();
  for (std::size_t j = 0; j < count; ++j) to[j] = std::max(to[j], from[j]);
}

void SpokeResampler::put_cells_together() {
  given_doppler_.clear();
  if (shares_.keeps()) {
    given_.assign(held_.begin(), held_.end());
    given_doppler_.assign(held_doppler_.begin(), held_doppler_.end());
    return;
  }
  given_.resize(cells_);
  const std::uint8_t* const from = held_.data();
  if (shares_.at_most_two()) {  // without a branch: shares of one and two take turns
    for (std::uint32_t c = 0; c < cells_; ++c) {
      given_[c] = std::max(from[shares_.begin(c)], from[shares_.end(c) - 1]);
    }
  } else {
    for (std::uint32_t c = 0; c < cells_; ++c) {
      given_[c] = *std::max_element(from + shares_.begin(c), from + shares_.end(c));
    }
  }
  if (held_doppler_.empty()) return;
  given_doppler_.resize(cells_);
  for (std::uint32_t c = 0; c < cells_; ++c) {
    std::uint32_t shown = shares_.begin(c);
    for (std::uint32_t j = shown + 1; j < shares_.end(c); ++j) {
      const bool as_strong = held_[j] == held_[shown] && held_doppler_[shown] == DopplerClass::none;
      if (held_[j] > held_[shown] || as_strong) shown = j;
    }
    given_doppler_[c] = held_doppler_[shown];
  }
}

void SpokeResampler::give(std::uint32_t index, const Sink& sink) {
  if (holding_) put_cells_together();
  SpokeHeader header = last_;
  header.index = index;
  header.geometry.spokes_per_turn = turn_spokes_;
  header.geometry.cells = cells_;
  sink({header, given_, given_doppler_});
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
