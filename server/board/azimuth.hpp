// Azimuth: where an antenna points, exact enough for years of turning.
#pragma once

#include <cstdint>

namespace skerry::server {

// Turns clockwise from the bow since the antenna's start.
struct Azimuth {
  std::uint64_t turns = 0;
  std::uint64_t fraction = 0;  // 2^-64 turn

  double in_turns() const { return static_cast<double>(turns) + fraction_of_turn(); }
  double fraction_of_turn() const { return static_cast<double>(fraction) * 0x1p-64; }
  friend auto operator<=>(const Azimuth&, const Azimuth&) = default;
};

// A sector clockwise from `from` to `to`, tenths of a degree from the bow; none where they are
// equal.
struct BlankSector {
  std::uint32_t from = 0, to = 0;
  bool empty() const { return from == to; }
  bool contains(Azimuth azimuth) const {
    const auto place =
        static_cast<std::uint32_t>(static_cast<unsigned __int128>(azimuth.fraction) * 3600 >> 64);
    return (place + 3600 - from) % 3600 < (to + 3600 - from) % 3600;
  }
  friend bool operator==(const BlankSector&, const BlankSector&) = default;
};

}  // namespace skerry::server
