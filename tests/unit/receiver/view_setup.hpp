// Rows, models and videos for the tests of ViewReceiver.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "echo/kernel/log_receiver.hpp"
#include "echo/receiver/view_receiver.hpp"

namespace skerry::echo {

inline constexpr std::uint32_t kCells = 1024, kSpokes = 4096;

inline RadarModel model_of(double nm, double beam_deg = 1.25, std::uint32_t spokes = kSpokes,
                           std::uint32_t bits = 8) {
  RadarSet set;
  set.beam_width_deg = beam_deg;
  return radar_model(set, {spokes, kCells, bits}, *RangeScale::find(nm), SpokeClock(24.0, spokes),
                     0);
}

inline ViewControls controls_of(double nm, double gain = 50.0) {
  ViewControls controls;
  controls.range_scale = *RangeScale::find(nm);
  controls.gain = gain;
  controls.sea = 0.0;
  return controls;
}

// Echo power of a cell of a spoke.
using Echo = std::function<double(std::uint64_t spoke, std::uint32_t cell)>;
inline double silence(std::uint64_t, std::uint32_t) { return 0.0; }

// An exponential of unit mean that belongs to a cell: a Rayleigh echo's fluctuation.
inline double fluctuation(std::uint64_t spoke, std::uint32_t cell) {
  return unit_noise_reference(
      noise_key(77, 1, static_cast<std::uint32_t>(spoke >> 12), static_cast<std::uint32_t>(spoke)),
      cell);
}

inline std::vector<std::uint8_t> video_of(ViewReceiver& receiver, const Echo& echo,
                                          std::uint64_t first, std::uint32_t count,
                                          std::uint32_t sector = 16,
                                          const ParallelFor& parallel = serial_for) {
  const std::size_t pitch = kCells + 16;
  std::vector<float> rows(sector * pitch);
  std::vector<std::uint8_t> video(std::size_t{count} * kCells);
  for (std::uint32_t done = 0; done < count; done += sector) {
    const std::uint32_t n = std::min(sector, count - done);
    for (std::uint32_t k = 0; k < n; ++k) {
      for (std::uint32_t i = 0; i < kCells; ++i)
        rows[k * pitch + i] = static_cast<float>(echo(first + done + k, i));
    }
    receiver.receive(rows, pitch, first + done, n, 1, parallel,
                     std::span(video).subspan(std::size_t{done} * kCells, std::size_t{n} * kCells));
  }
  return video;
}

inline std::vector<std::uint8_t> video_of(const RadarModel& model, const ViewControls& controls,
                                          const Echo& echo, std::uint32_t count,
                                          std::uint32_t sector = 16,
                                          const ParallelFor& parallel = serial_for) {
  ViewReceiver receiver(model, controls);
  return video_of(receiver, echo, 0, count, sector, parallel);
}

// Share of cells that show something among `begin` .. `end`.
inline double share_on(std::span<const std::uint8_t> video, std::uint32_t begin = 0,
                       std::uint32_t end = kCells) {
  double on = 0.0, all = 0.0;
  for (std::size_t s = 0; s < video.size(); s += kCells) {
    for (std::uint32_t i = begin; i < end; ++i) on += video[s + i] > 0, all += 1.0;
  }
  return on / all;
}

inline constexpr double kStepDb = kLogVideoDb / 256.0;

}  // namespace skerry::echo
