// AzimuthMemory: the stages of a receiver that look at earlier spokes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/kernel/coherent_receiver.hpp"

namespace skerry::echo {

// How many spokes the two-way beam is wide at -3 dB, and what follows for the stages.
struct AzimuthStages {
  double rejection_db = 0.0;     // a cell this far above the two spokes before is replaced; 0: off
  std::uint32_t integrated = 1;  // spokes
  std::uint32_t stretch = 0;     // spokes to either side
  std::uint32_t smoothing = 1;   // spokes averaged, twice (smooth_video()); 1: none
  friend bool operator==(const AzimuthStages&, const AzimuthStages&) = default;
};

// rejection and integration, 0 to 100.  Rejection: from 20 dB at 0+ to 6 dB at 100, and off where a
// beam is not at least two spokes wide, as a ship would then look like a strobe.  Integration: up
// to the beam's spokes, at most kMaxIntegrated.  Stretch in bearing: at most half a degree.
inline constexpr std::uint32_t kMaxIntegrated = 64;
inline constexpr double kLeastRejectionDb = 20.0, kMostRejectionDb = 6.0;
AzimuthStages azimuth_stages(double beam_width_deg, std::uint32_t spokes_per_turn, double rejection,
                             double integration, unsigned stretch);

// The memory that one view keeps of its last spokes.  Columns are independent of each other: any
// split of the cells gives the same video.  Thread: receive() of different columns at the same
// time, each column in the order of spokes; set_up(), forget() and end_spokes() alone.
class AzimuthMemory {
 public:
  void set_up(const AzimuthStages& stages, std::uint32_t cells, double mean_noise);
  void forget();  // as if no spoke had been

  const AzimuthStages& stages() const { return stages_; }
  // How many spokes an integrated and smoothed echo lies behind the newest of those it is made of.
  std::uint32_t lag() const { return (stages_.integrated - 1) / 2 + stages_.smoothing - 1; }
  bool is_empty() const { return spokes_ == 0; }
  bool detects() const { return stages_.rejection_db > 0.0 || stages_.integrated > 1; }
  bool stretches() const { return stages_.stretch > 0; }
  bool smooths() const { return stages_.smoothing > 1; }

  // Cells begin .. begin + video.size() - 1 of the k-th spoke of this call, spoke number `spoke`.
  // power, noise, offset and video begin at cell `begin`.
  void receive(std::uint64_t spoke, std::uint32_t k, std::size_t begin,
               std::span<const float> power, float gain, const NoiseRow& noise,
               std::span<const float> offset, QuantiserScale scale, std::span<std::uint8_t> video);
  // Stretches `count` finished spokes, `cells` bytes apart in `video`, in these columns.
  void stretch(std::span<std::uint8_t> video, std::uint32_t count, std::size_t begin,
               std::size_t columns);
  // Smooths them, likewise.
  void smooth(std::span<std::uint8_t> video, std::uint32_t count, std::size_t begin,
              std::size_t columns);
  void end_spokes(std::uint32_t count);
  // Brings the memory near, for a receive() some microseconds later.
  void fetch() const;

 private:
  void close_group(std::size_t begin, std::size_t columns);
  template <typename Show>
  void with_earlier(std::vector<std::uint8_t>& earlier, std::size_t kept,
                    std::span<std::uint8_t> video, std::uint32_t count, std::size_t begin,
                    std::size_t columns, const Show& show) const;

  AzimuthStages stages_;
  std::vector<float>
      octaves_;  // log2 of 1 / n, from n = 0, where it is of 1, to stages_.integrated
  std::size_t cells_ = 0, pitch_ = 0;
  float ratio_ = 1.0f, floor_ = 1.0f;
  AlignedFloats totals_;  // three spokes by number
  AlignedFloats group_;   // `integrated` spokes by number: powers, then sums of what follows
  AlignedFloats so_far_;
  std::vector<std::uint8_t> shown_;  // 2 * stretch spokes before this call, oldest first
  std::vector<std::uint8_t> rough_;  // 2 * smoothing - 2 spokes before they are smoothed
  std::uint64_t spokes_ = 0;         // since it began
};

}  // namespace skerry::echo
