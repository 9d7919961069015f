// The Navico radars, their addresses and their ranges.  Source: navico/README.md.
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/wire/ipv4_endpoint.hpp"

namespace skerry::navico {

enum class Model : std::uint8_t {
  br24,
  g3,      // "3G" with the spokes of a BR24 (firmware of 2012)
  g4,      // "4G": two ranges at once
  halo20,  // one range
  halo,    // HALO24 and the open arrays: two ranges, Doppler colours
};

constexpr std::string_view name_of(Model model) {
  switch (model) {
    case Model::br24:
      return "BR24";
    case Model::g3:
      return "3G";
    case Model::g4:
      return "4G";
    case Model::halo20:
      return "HALO20";
    case Model::halo:
      return "HALO";
  }
  return "";
}

constexpr bool is_halo(Model model) { return model == Model::halo20 || model == Model::halo; }
constexpr bool has_two_ranges(Model model) { return model == Model::g4 || model == Model::halo; }
constexpr bool has_doppler(Model model) { return model == Model::halo; }
// BR24 and the early 3G: their spokes and their states are told apart from later ones.
constexpr bool is_first_generation(Model model) {
  return model == Model::br24 || model == Model::g3;
}

// The addresses of one range of a radar, all of them multicast groups.
struct Addresses {
  Ipv4Endpoint data;    // radar -> displays: frames
  Ipv4Endpoint send;    // displays -> radar: commands
  Ipv4Endpoint report;  // radar -> displays: reports
  friend bool operator==(const Addresses&, const Addresses&) = default;
};
// Fixed for BR24, 3G and 4G; a HALO's are what its locator says, and often these.
inline constexpr Addresses kAddressesA{
    {ipv4(236, 6, 7, 8), 6678}, {ipv4(236, 6, 7, 10), 6680}, {ipv4(236, 6, 7, 9), 6679}};
inline constexpr Addresses kAddressesB{
    {ipv4(236, 6, 7, 13), 6657}, {ipv4(236, 6, 7, 14), 6658}, {ipv4(236, 6, 7, 15), 6659}};
inline constexpr Ipv4Endpoint kLocatorGroup{ipv4(236, 6, 7, 5), 6878};
// HALO network: "I am here" each second, and own ship's motion.
inline constexpr Ipv4Endpoint kPresenceGroup{ipv4(236, 6, 7, 4), 6768};
inline constexpr Ipv4Endpoint kHeadingGroup{ipv4(239, 238, 55, 73), 7527};
inline constexpr Ipv4Endpoint kSpeedGroups[] = {{ipv4(236, 6, 7, 20), 6690},
                                                {ipv4(236, 6, 7, 15), 6005}};

// Ranges a display may ask for, decimetres; others are not obeyed (a HALO20 asked for 36 NM in the
// recording stays at 24 NM and says nothing).
inline constexpr std::uint32_t kMinRangeDm = 500;
constexpr std::uint32_t max_range_dm(Model model) {
  switch (model) {
    case Model::br24:
    case Model::g3:
    case Model::halo20:
      return 444'480;  // 24 NM
    case Model::g4:
      return 666'720;  // 36 NM
    case Model::halo:
      return 1'333'440;  // 72 NM
  }
  return 0;
}

}  // namespace skerry::navico
