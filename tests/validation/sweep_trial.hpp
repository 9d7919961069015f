// SweepTrial: a board without its hardware: triggers at exact azimuths, sweeps of a radar's echo,
// and the spokes that a digitiser forms of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/spoke_returns.hpp"
#include "echo/sweeps/sweep_receiver.hpp"
#include "protocol/board/spoke_former.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::validation {

inline constexpr std::uint32_t kRows = 4096;  // in a turn, and spokes

// Error: std::out_of_range.
const scenes::NamedScene& scene_named(const std::vector<scenes::NamedScene>& all,
                                      const std::string& name);

// Something to look at, by one pulse, in cells of one length.
struct Site {
  std::string name;
  echo::ScenePtr scene;
  echo::RadarModel model;

  echo::SweepEchoes::Grid grid() const;
};

// cells of `cell_m`; the set's pulse for that choice on the scale of the scene.
Site site_of(std::string name, const scenes::NamedScene& named, std::uint32_t cells, double cell_m,
             echo::PulseChoice choice);

// Rows of spokes first - 16 .. first + count + 16 of a site, as SpokeReturns makes them.
class RowStore {
 public:
  RowStore(const Site& site, std::uint32_t first, std::uint32_t count);
  std::span<const float> row(std::uint64_t spoke) const;

 private:
  std::uint32_t cells_;
  std::uint64_t first_;
  std::vector<float> rows_;
};

// Every sample of sweeps whose clock has one tick to a cell.
echo::SweepChannel channel_on(const Site& site, echo::VideoDetector detector, unsigned bits);

struct FormedSpoke {
  std::uint64_t spoke = 0;  // from the antenna's start
  std::uint32_t pulses = 0;
  std::vector<std::uint16_t> samples;
};

// Spokes of first .. first + count - 1 formed of `pulses_per_spoke` triggers each in the mean, the
// first of them that much after the boundary between two spokes that half a trigger is.
// change: what becomes of a sweep's samples before they are summed; null: nothing.
using ChangeOfSamples = void (*)(std::vector<std::uint16_t>&);
std::vector<FormedSpoke> formed_spokes(const RowStore& rows, const echo::SweepEchoes::Grid& grid,
                                       const echo::SweepChannel& channel, double pulses_per_spoke,
                                       std::uint32_t first, std::uint32_t count,
                                       ChangeOfSamples change = nullptr);

}  // namespace skerry::validation
