#include "server/live/added_echoes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace skerry::server {
namespace {

// Seven rows, the highest nearest to the antenna; in each the leftmost column is the highest bit.
constexpr std::array<std::uint8_t, 7> kLetter = {0b01110, 0b10001, 0b10000, 0b01110,
                                                 0b00001, 0b10001, 0b01110};
constexpr int kColumns = 5;
constexpr std::uint32_t kMostPassed = 8;  // places from one spoke to the next: more is a gap

constexpr double kLetterBegin = 0.86, kLetterEnd = 0.95;  // of the range scale
constexpr double kColumnDeg = 0.82;                       // as wide as a row is high, there

std::uint8_t greatest_level(const Spoke& spoke) {
  return static_cast<std::uint8_t>((1u << spoke.header.geometry.bits) - 1);
}

}  // namespace

void AddedEchoes::take(const Sector& sector) {
  const std::lock_guard lock(mutex_);
  for (const SpokePtr& spoke : sector.spokes) {
    const std::uint32_t count = spoke->header.geometry.spokes_per_turn;
    if (turn_.size() != count) turn_.assign(count, nullptr);
    const std::uint32_t at = spoke->header.bearing().nearest_spoke(count);
    // Where the ship turns, a place between two spokes is the later one's.
    const std::uint32_t passed = (at + count - newest_ % count) % count;
    for (std::uint32_t back = 0; back < (passed <= kMostPassed ? std::max(passed, 1u) : 1u);
         ++back) {
      turn_[(at + count - back) % count] = spoke;
    }
    newest_ = at;
    heading_ = spoke->header.heading;
  }
}

void AddedEchoes::lay(const Spoke& simulated, Spoke& out) {
  const double cells_per_cell = out.header.cell_size() / simulated.header.cell_size();
  const unsigned from = greatest_level(simulated), to = greatest_level(out);
  const std::size_t known = simulated.cells.size();
  for (std::size_t cell = 0; cell < out.cells.size(); ++cell) {
    const double begin = static_cast<double>(cell) * cells_per_cell;
    const auto first = static_cast<std::size_t>(begin);
    if (first >= known) return;
    const auto end =
        std::min(known, static_cast<std::size_t>(std::ceil(begin + cells_per_cell - 1e-6)));
    unsigned level = 0;
    for (std::size_t i = first; i < std::max(end, first + 1); ++i) {
      level = std::max<unsigned>(level, simulated.cells[i]);
    }
    level = (level * to + from / 2) / from;
    if (level <= out.cells[cell]) continue;
    out.cells[cell] = static_cast<std::uint8_t>(level);
    if (!out.doppler.empty()) out.doppler[cell] = DopplerClass::none;
  }
}

void AddedEchoes::add_to(std::vector<Spoke>& spokes, bool heading_known) const {
  const std::lock_guard lock(mutex_);
  for (Spoke& out : spokes) {
    const SpokeHeader& header = out.header;
    if (!turn_.empty()) {
      const TrueBearing bearing =
          to_true(header.antenna(), heading_known ? header.heading : heading_);
      const auto count = static_cast<double>(turn_.size());
      // The simulated spokes whose middles lie within this one, or the nearest.
      const double middle = bearing.in_degrees() / 360.0 * count;
      const double half = 0.5 * count / header.geometry.spokes_per_turn;
      auto first = static_cast<std::int64_t>(std::ceil(middle - half));
      auto last = static_cast<std::int64_t>(std::floor(middle + half));
      if (last < first) first = last = std::llround(middle);
      for (std::int64_t i = first; i <= last; ++i) {
        const auto size = static_cast<std::int64_t>(turn_.size());
        const SpokePtr& simulated = turn_[static_cast<std::size_t>((i % size + size) % size)];
        if (simulated != nullptr && header.utc - simulated->header.utc < kHeld) {
          lay(*simulated, out);
        }
      }
    }
    mark_as_simulated(out);
  }
}

void mark_as_simulated(Spoke& spoke) {
  // Astern the picture's left is clockwise.
  const double right_deg =
      spoke.header.antenna().in_degrees() - 180.0 + 0.5 * kColumns * kColumnDeg;
  const auto column = static_cast<int>(std::floor(right_deg / kColumnDeg));
  if (column < -1 || column > kColumns) return;  // a margin of a column on either side
  const double scale = spoke.header.range_scale.length() / spoke.header.cell_size();
  const double row_cells = (kLetterEnd - kLetterBegin) * scale / kLetter.size();
  const auto begin = static_cast<std::size_t>(kLetterBegin * scale - row_cells);
  const auto end =
      std::min(spoke.cells.size(), static_cast<std::size_t>(kLetterEnd * scale + row_cells));
  for (std::size_t cell = begin; cell < end; ++cell) {
    const auto row = static_cast<int>(
        std::floor((static_cast<double>(cell) + 0.5 - kLetterBegin * scale) / row_cells));
    const bool inside =
        column >= 0 && column < kColumns && row >= 0 && row < static_cast<int>(kLetter.size());
    const bool lit = inside && (kLetter[static_cast<std::size_t>(row)] >> column & 1) != 0;
    spoke.cells[cell] = lit ? greatest_level(spoke) : 0;
    if (!spoke.doppler.empty()) spoke.doppler[cell] = DopplerClass::none;
  }
}

}  // namespace skerry::server
