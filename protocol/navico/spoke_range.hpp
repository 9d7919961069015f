// SpokeRange: how far a Navico spoke reaches, as its header says it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "protocol/navico/model.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::navico {

inline constexpr std::size_t kSpokeHeader = 24;

// A spoke reaches further than the set range: 1.769 times (BR24, 3G), 1.953 times (4G) or 1.719
// times (HALO); up to the most that the radar says at all, 72,704 m (4G) and 57,860 m (HALO20).
// The header rounds the way those of the recordings do, so the reach of what is sent is exactly
// what the display makes of it, not the product.
struct SpokeRange {
  std::array<std::uint8_t, 4> at_4{};   // octets 4..7 of the spoke header
  std::array<std::uint8_t, 3> at_12{};  // octets 12..14; only the first two except for BR24, 3G
  Length reach;                         // far end of the last cell
};
// Requires kMinRangeDm <= range_dm <= max_range_dm(model).
SpokeRange spoke_range(Model model, std::uint32_t range_dm);

// The reach a spoke header says; zero where the radar has none (a HALO's first spoke).
// Requires header.size() >= kSpokeHeader.
Length reach_of(Model model, std::span<const std::uint8_t> header);

}  // namespace skerry::navico
