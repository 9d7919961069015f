// Reads the captures of Navico radars that the picture's estimators are checked against.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace skerry::test {

inline constexpr std::uint32_t kNavicoSpokes = 2048;  // per turn: every other of 4096 azimuth units
inline constexpr std::uint32_t kNavicoCells = 1024;

// One spoke of 4-bit video, a byte a cell.
struct NavicoSpoke {
  std::uint32_t azimuth = 0;  // 4096 units clockwise from the bow
  double range_m = 0.0;       // to the end of the last cell
  std::array<std::uint8_t, kNavicoCells> cells{};
};

enum class NavicoKind { halo, br24 };

// All spokes of a gzipped capture (libpcap, Ethernet, IPv4 with fragments), in order.  Layout:
// SOURCES.md "Pictures".  Error: std::runtime_error naming the file and what was wrong.
std::vector<NavicoSpoke> read_navico(const std::string& file, NavicoKind kind);

// A whole turn on one range scale: kNavicoSpokes spokes of kNavicoCells.  A spoke the radar skipped
// is that of the neighbour before it.
struct NavicoTurn {
  double range_m = 0.0;
  std::uint32_t skipped = 0;
  std::vector<std::uint8_t> video;
};

// The turns at a range scale (to 1 m) of which at most a twentieth of the spokes is missing, from
// bow to bow.
std::vector<NavicoTurn> turns_at(const std::vector<NavicoSpoke>& spokes, double range_m);

// Folder of the recordings; empty where there are none.
std::string recordings_folder();

}  // namespace skerry::test
