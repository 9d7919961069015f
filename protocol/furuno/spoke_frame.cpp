#include "protocol/furuno/spoke_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "protocol/wire/byte_order.hpp"

namespace skerry::furuno {
namespace {

using Octets = std::span<const std::uint8_t>;

constexpr std::uint8_t kFrame = 2;
constexpr std::size_t kSweepHead = 4;
constexpr std::size_t kModelReport = 170, kModelAt = 24, kModelLength = 32;
constexpr std::uint8_t kModelKind = 0x0F;

// By the index in a frame; 0: none.
constexpr std::array<double, 22> kRangesNm = {
    0.125, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 72, 96, 120, 36, 64, 0.0625};

// How cells are packed.
enum class Packing : std::uint8_t {
  none = 0,
  runs = 1,        // odd octets repeat the last cell
  copies = 2,      // odd octets copy from the sweep before; the first sweep is packed as runs
  runs_copies = 3  // the lowest two bits: 0 a cell, 1 and 3 a run, 2 a copy
};

// What octets 8 and 9 count: words of four octets behind the twelfth octet.
constexpr std::size_t kWord = 4, kBeforeWords = 12;

struct Header {
  std::uint32_t sweeps = 0, cells = 0, scale = 0, range = 0;
  std::size_t size = 0;  // of the datagram, as it says
  Packing packing = Packing::none;
};

Header header_of(Octets datagram) {
  Header header;
  header.size = kBeforeWords + kWord * (datagram[8] | (datagram[9] & 1u) << 8);
  header.sweeps = datagram[9] >> 1;
  header.cells = datagram[10] | (datagram[11] & 7u) << 8;
  header.packing = static_cast<Packing>(datagram[11] >> 3 & 3);
  header.range = datagram[12] & 0x3Fu;
  header.scale = datagram[14] | (datagram[15] & 7u) << 8;
  return header;
}

// One octet of a packed sweep.
struct Step {
  enum class What : std::uint8_t { cell, run, copy };
  What what = What::cell;
  std::size_t count = 1;
};
Step step_of(std::uint8_t octet, Packing packing) {
  using enum Step::What;
  if (packing == Packing::none) return {cell, 1};
  if (packing == Packing::runs_copies) {
    if ((octet & 3) == 0) return {cell, 1};
    const std::size_t count = octet >> 2;
    return {(octet & 1) != 0 ? run : copy, count == 0 ? 64 : count};
  }
  if ((octet & 1) == 0) return {cell, 1};
  const std::size_t count = octet >> 1;
  return {packing == Packing::runs ? run : copy, count == 0 ? 128 : count};
}

// Where the packed cells of a sweep end, from `begin`; nothing if they go beyond the datagram or
// beyond the sweep.
std::optional<std::size_t> end_of_sweep(Octets datagram, std::size_t begin, std::uint32_t cells,
                                        Packing packing) {
  std::size_t at = begin, made = 0;
  while (made < cells) {
    if (at >= datagram.size()) return std::nullopt;
    made += step_of(datagram[at++], packing).count;
  }
  return made == cells ? std::optional(at) : std::nullopt;
}

Packing packing_of(const Header& header, std::uint32_t sweep) {
  return header.packing == Packing::copies && sweep == 0 ? Packing::runs : header.packing;
}

// False: a copy of a sweep that is not in the datagram.
bool unpack(Octets packed, Packing packing, const std::vector<std::uint8_t>* before,
            std::vector<std::uint8_t>& cells) {
  std::uint8_t last = 0;
  for (const std::uint8_t octet : packed) {
    const auto [what, count] = step_of(octet, packing);
    if (what == Step::What::cell) {
      cells.push_back(last = octet);
    } else if (what == Step::What::run) {
      cells.insert(cells.end(), count, last);
    } else if (before == nullptr) {
      return false;
    } else {
      const auto from = before->begin() + static_cast<std::ptrdiff_t>(cells.size());
      cells.insert(cells.end(), from, from + static_cast<std::ptrdiff_t>(count));
      last = cells.back();
    }
  }
  return true;
}

// Sweeps begin at multiples of four octets.
constexpr std::size_t padded(std::size_t size) { return (size + 3) & ~std::size_t{3}; }

}  // namespace

bool is_spoke_frame(Octets datagram) {
  if (datagram.size() < kFrameHeader + kSweepHead || datagram[0] != kFrame) return false;
  const Header header = header_of(datagram);
  if (header.size != datagram.size()) return false;
  if (header.sweeps == 0 || header.cells == 0 || header.scale == 0) return false;
  std::size_t at = kFrameHeader;
  for (std::uint32_t sweep = 0; sweep < header.sweeps && at < datagram.size(); ++sweep) {
    const auto end =
        end_of_sweep(datagram, at + kSweepHead, header.cells, packing_of(header, sweep));
    if (!end) return false;
    at = kFrameHeader + padded(*end - kFrameHeader);
  }
  return at == datagram.size();
}

Result<SpokeFrame, WireError> decode_spoke_frame(Octets datagram) {
  if (datagram.size() < kFrameHeader + kSweepHead) {
    return failure(WireErrorKind::truncated, datagram.size(),
                   fmt::format("a frame of {} octets; with a sweep it has {} and more",
                               datagram.size(), kFrameHeader + kSweepHead));
  }
  if (datagram[0] != kFrame) {
    return failure(WireErrorKind::unknown_kind, 0,
                   fmt::format("a frame begins with {}, not 2", datagram[0]));
  }
  const Header header = header_of(datagram);
  if (header.sweeps == 0 || header.cells == 0 || header.scale == 0) {
    return failure(WireErrorKind::malformed, 9,
                   fmt::format("{} sweeps of {} cells, {} of them the range", header.sweeps,
                               header.cells, header.scale));
  }
  if (header.size != datagram.size()) {
    return failure(
        header.size > datagram.size() ? WireErrorKind::truncated : WireErrorKind::oversized, 8,
        fmt::format("{} octets; it says {}", datagram.size(), header.size));
  }
  SpokeFrame frame;
  frame.counter = datagram[1];
  frame.has_heading = (datagram[11] & 0x20) != 0;
  frame.range_b = (datagram[15] & 0x40) != 0;
  frame.cells = header.cells;
  frame.scale = header.scale;
  frame.range_m = range_of_index(header.range);
  std::size_t at = kFrameHeader;
  for (std::uint32_t i = 0; i < header.sweeps && at < datagram.size(); ++i) {
    if (datagram.size() < at + kSweepHead) {
      return failure(WireErrorKind::truncated, at, fmt::format("sweep {} has no angle", i));
    }
    Sweep sweep;
    sweep.angle = little_endian_at<std::uint16_t>(datagram, at);
    sweep.heading = little_endian_at<std::uint16_t>(datagram, at + 2);
    if (sweep.angle >= kAnglesPerTurn) {
      return failure(WireErrorKind::out_of_range, at,
                     fmt::format("angle {} of {} a turn", sweep.angle, kAnglesPerTurn));
    }
    const Packing packing = packing_of(header, i);
    const auto end = end_of_sweep(datagram, at + kSweepHead, header.cells, packing);
    if (!end) {
      return failure(WireErrorKind::truncated, at,
                     fmt::format("sweep {} does not end with {} cells", i, header.cells));
    }
    sweep.cells.reserve(header.cells);
    const auto packed = datagram.subspan(at + kSweepHead, *end - at - kSweepHead);
    const auto* before = i == 0 ? nullptr : &frame.sweeps.back().cells;
    if (!unpack(packed, packing, before, sweep.cells)) {
      return failure(WireErrorKind::malformed, at, "the first sweep copies one before it");
    }
    frame.sweeps.push_back(std::move(sweep));
    at = kFrameHeader + padded(*end - kFrameHeader);
  }
  if (at != datagram.size()) {
    return failure(at < datagram.size() ? WireErrorKind::oversized : WireErrorKind::truncated, at,
                   fmt::format("{} octets; its sweeps have {}", datagram.size(), at));
  }
  return frame;
}

std::optional<std::string> decode_model(Octets datagram) {
  if (datagram.size() != kModelReport || datagram[0] != 1 || datagram[8] != kModelKind) {
    return std::nullopt;
  }
  const Octets field = datagram.subspan(kModelAt, kModelLength);
  std::string name(field.begin(), std::find(field.begin(), field.end(), std::uint8_t{0}));
  const bool plain =
      std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c < 127; });
  const bool known = name.starts_with("DRS") || name.starts_with("FAR");
  return plain && known ? std::optional(std::move(name)) : std::nullopt;
}

std::optional<double> range_of_index(std::uint32_t index) {
  constexpr double kMetres = 1852.0;
  return index < kRangesNm.size() ? std::optional(kRangesNm[index] * kMetres) : std::nullopt;
}

}  // namespace skerry::furuno
