// SuspectEchoes: which plots may be no target but another echo's doing.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "server/plotter/plots/plot.hpp"

namespace skerry::server {

// Side lobes show a strong echo all round at its own range; its ship reflects it to and fro, so
// that it shows again at twice and three times the range; a SART answers with twelve dots, 0.64 NM
// apart (echo/beacons/sart_returns.hpp).  All of that
// moves as steadily as a ship.  A boat may lie at a ship's range, or behind her, too: that is why a
// suspect plot may still be a track's, and only begins none by itself.
//
// Thread: one at a time.
class SuspectEchoes {
 public:
  static constexpr std::uint8_t kStrong = 200;    // levels of 255
  static constexpr std::uint8_t kLobeBelow = 25;  // levels; video that is cut off shows no more
  static constexpr double kBin_m = 50.0;
  static constexpr std::size_t kBins = 1000;  // farther, nothing is a lobe
  static constexpr double kRemembered_s = 8.0;
  static constexpr std::size_t kLately = 512;  // plots that are compared
  static constexpr double kSameBearing_deg = 1.5;
  static constexpr double kSameCause_deg = 3.0;
  static constexpr double kNearLobe_deg = 6.0;  // a main beam's first side lobes; they are strong
  static constexpr std::uint32_t kRingSectors = 32;
  static constexpr int kLeastLobes = 5;  // sectors with a plot where a far lobe is, its cause's too
  static constexpr int kLeastOfRing = 7;            // sectors with a plot at the range
  static constexpr std::uint32_t kLargerByFar = 4;  // times the cells
  static constexpr double kRing_s = 4.0;            // then the next one is begun
  static constexpr double kLongestCause_m = 150.0;  // what is longer is land
  static constexpr double kSartStep_m = 0.64 * 1852.0;
  static constexpr double kSartOff_m = 60.0;  // of a step
  static constexpr int kSartDots = 4;         // with this one

  void add(const Plot& plot);
  // Strong echoes whose side lobes a plot may be: how far each is from it, degrees clockwise.  A
  // lobe keeps that, while a boat at a ship's range is at another ship's a minute later.
  struct Causes {
    static constexpr std::size_t kMost = 6;
    std::array<double, kMost> off_deg{};
    std::size_t count = 0;
    bool shares_one_with(const Causes& others) const;
  };
  // Of one that was added, once the antenna is some degrees past it.
  Causes causes_of(const Plot& plot) const;
  bool is_echo_of_a_cause(const Plot& plot) const;  // to and fro, or a SART's dot
  // Of a ring of side lobes: plots lie at its range all round, and one is much larger.  Video that
  // is cut off shows a lobe as strong as its ship, but never as large.
  bool is_of_a_ring(const Plot& plot) const;
  bool is_suspect(const Plot& plot) const {
    return causes_of(plot).count > 0 || is_echo_of_a_cause(plot) || is_of_a_ring(plot);
  }

 private:
  struct Strong {
    TrueBearing bearing;
    std::uint8_t level = 0;  // 0: none
    std::uint32_t cells = 0;
    ScenarioTime time{};
  };
  // Sectors in which there were plots, in this span of time and in the one before.
  struct Ring {
    std::uint32_t now = 0, before = 0;
    std::uint32_t most_cells = 0, most_before = 0;  // of strong ones
    ScenarioTime began{};
  };
  static void put(Ring& ring, const Plot& plot);
  static int sectors_of(const Ring& ring) { return std::popcount(ring.now | ring.before); }
  using Bin = std::array<Strong, Causes::kMost>;
  static void put(Bin& bin, const Strong& strong);
  struct Late {
    double range_m = 0.0, length_m = 0.0;
    TrueBearing bearing;
    std::uint8_t level = 0;
    ScenarioTime time{};
  };

  std::vector<Bin> bins_ = std::vector<Bin>(kBins);
  std::vector<Ring> rings_ = std::vector<Ring>(kBins);
  std::vector<Late> lately_;  // a ring
  std::size_t next_ = 0;
};

}  // namespace skerry::server
