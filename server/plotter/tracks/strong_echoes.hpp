// StrongEchoes: which plots may be side lobes of a far stronger echo at the same range.
#pragma once

#include <cstdint>
#include <vector>

#include "server/plotter/plots/plot.hpp"

namespace skerry::server {

// Side lobes show a strong echo all round at its own range, some 40 dB and more below.  So a plot
// is suspect if a strong one at its range, in the last turn or so, stands at least kBelow levels
// over it.  A boat that lies at a ship's range is suspect, too: that is why a suspect plot may
// still be a track's, and only begins none by itself.
class StrongEchoes {
 public:
  static constexpr std::uint8_t kStrong = 200;  // levels of 255
  static constexpr std::uint8_t kBelow = 60;    // levels; 15 dB at 4 levels a dB
  static constexpr double kBin_m = 50.0;
  static constexpr std::size_t kBins = 1000;  // farther, nothing is suspect
  static constexpr double kRemembered_s = 8.0;

  void add(const Plot& plot);
  bool is_suspect(const Plot& plot) const;

 private:
  struct Bin {
    std::uint8_t level = 0;
    ScenarioTime time{};
  };
  std::vector<Bin> bins_ = std::vector<Bin>(kBins);
};

}  // namespace skerry::server
