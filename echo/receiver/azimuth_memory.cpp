#include "echo/receiver/azimuth_memory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/video_stages.hpp"
#include "protocol/video/scan_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr float kUnknown = 1e30f;  // before the first spoke: nothing is far above it

constexpr std::size_t kLineFloats = 16, kMostFetched = 1u << 14;  // of a cache line; worth it

// Zeros for a whole row, one for all radars.
const float* row_of_zeros() {
  static const AlignedFloats row(ScanGeometry::kMaxCells, 0.0f);
  return row.data();
}

}  // namespace

AzimuthStages azimuth_stages(double beam_width_deg, std::uint32_t spokes_per_turn, double rejection,
                             double integration, unsigned stretch) {
  const double spoke_deg = 360.0 / spokes_per_turn;
  const double beam = beam_width_deg / std::numbers::sqrt2 / spoke_deg;
  AzimuthStages stages;
  if (rejection > 0.0 && beam >= 2.0) {
    stages.rejection_db =
        kLeastRejectionDb + (kMostRejectionDb - kLeastRejectionDb) * rejection / 100.0;
  }
  const double most = std::clamp(std::floor(beam), 1.0, static_cast<double>(kMaxIntegrated));
  stages.integrated = 1 + static_cast<std::uint32_t>((most - 1.0) * integration / 100.0 + 0.5);
  stages.stretch = std::min(stretch, static_cast<unsigned>(0.5 / spoke_deg));
  return stages;
}

void AzimuthMemory::set_up(const AzimuthStages& stages, std::uint32_t cells, double mean_noise) {
  floor_ = static_cast<float>(mean_noise);
  if (stages == stages_ && cells == cells_) return;
  stages_ = stages;
  cells_ = cells;
  // Rows must not lie a multiple of 4 KiB apart, nor a line or two beside one: what is read of one
  // row would wait for what has just been written of another at the same place of its page.
  pitch_ = (cells + 15) / 16 * 16 + 80;
  ratio_ = static_cast<float>(ratio_from_decibels(stages.rejection_db));
  totals_.resize(stages.rejection_db > 0.0 ? 3 * pitch_ : 0);
  const bool sums = stages.integrated > 1;
  group_.resize(sums ? stages.integrated * pitch_ : 0);
  so_far_.resize(sums ? pitch_ : 0);
  shown_.resize(2 * std::size_t{stages.stretch} * cells);
  rough_.resize((2 * std::size_t{stages.smoothing} - 2) * cells);
  octaves_.clear();
  for (std::uint32_t n = 0; n <= stages.integrated; ++n)
    octaves_.push_back(-static_cast<float>(exact_log2(static_cast<double>(std::max(1u, n)))));
  forget();
}

void AzimuthMemory::forget() {
  std::fill(totals_.begin(), totals_.end(), kUnknown);
  std::fill(group_.begin(), group_.end(), 0.0f);
  std::fill(so_far_.begin(), so_far_.end(), 0.0f);
  std::fill(shown_.begin(), shown_.end(), std::uint8_t{0});
  std::fill(rough_.begin(), rough_.end(), std::uint8_t{0});
  spokes_ = 0;
}

// A group of spokes is full: each becomes the sum of itself and those behind it in the group.
void AzimuthMemory::close_group(std::size_t begin, std::size_t columns) {
  for (std::size_t j = stages_.integrated - 1; j-- > 0;) {
    const auto row = std::span(group_).subspan(j * pitch_ + begin, columns);
    add_row(row, std::span(group_).subspan((j + 1) * pitch_ + begin, columns));
  }
  std::fill_n(so_far_.begin() + static_cast<std::ptrdiff_t>(begin), columns, 0.0f);
}

void AzimuthMemory::receive(std::uint64_t spoke, std::uint32_t k, std::size_t begin,
                            std::span<const float> power, float gain, const NoiseRow& noise,
                            std::span<const float> offset, QuantiserScale scale,
                            std::span<std::uint8_t> video) {
  RejectionRows rejection;
  if (stages_.rejection_db > 0.0) {
    const auto row = [&](std::uint64_t number) {
      return totals_.data() + number % 3 * pitch_ + begin;
    };
    rejection = {row(spoke + 2), row(spoke + 1), row(spoke), ratio_, floor_};
  }
  IntegrationRows integration;
  if (stages_.integrated > 1) {
    const std::uint64_t summed = std::min<std::uint64_t>(stages_.integrated, spokes_ + k + 1);
    const float octaves = octaves_[summed];
    const auto kept = [&](std::uint64_t number) {
      return group_.data() + number % stages_.integrated * pitch_ + begin;
    };
    const std::uint64_t place = spoke % stages_.integrated;
    if (stages_.integrated > kFewPast + 1) {
      if (place == 0) close_group(begin, video.size());
      const float* later =
          place + 1 < stages_.integrated ? kept(place) + pitch_ : row_of_zeros() + begin;
      integration = {later, so_far_.data() + begin, kept(place), octaves};
    } else {
      integration = {nullptr, nullptr, kept(place), octaves};
      for (std::uint32_t j = 0; j < kFewPast; ++j) {
        const bool counts = j + 1 < stages_.integrated;
        integration.past[j] =
            counts ? kept(place + stages_.integrated - j - 1) : row_of_zeros() + begin;
      }
    }
  }
  if (stages_.rejection_db <= 0.0) {
    receive_integrated(power, gain, noise, integration, offset, scale, video);
  } else if (stages_.integrated <= 1) {
    receive_rejected(power, gain, noise, rejection, offset, scale, video);
  } else {
    receive_rejected_and_integrated(power, gain, noise, rejection, integration, offset, scale,
                                    video);
  }
}

// show(rows): makes the newest of `kept` + 1 spokes, oldest first, what is shown.  From the last
// spoke back, so that each still finds those before it as they were.
template <typename Show>
void AzimuthMemory::with_earlier(std::vector<std::uint8_t>& earlier, std::size_t kept,
                                 std::span<std::uint8_t> video, std::uint32_t count,
                                 std::size_t begin, std::size_t columns, const Show& show) const {
  const auto spoke = [&](std::size_t k) {  // the last `kept` spokes, then this call's
    return k < kept ? earlier.data() + k * cells_ + begin
                    : video.data() + (k - kept) * cells_ + begin;
  };
  thread_local std::vector<std::uint8_t> last;
  last.resize(kept * columns);
  for (std::size_t k = 0; k < kept; ++k)
    std::copy_n(spoke(count + k), columns, last.data() + k * columns);
  thread_local std::vector<std::uint8_t*> rows;
  rows.resize(kept + 1);
  for (std::size_t k = count; k-- > 0;) {
    for (std::size_t j = 0; j <= kept; ++j) rows[j] = spoke(k + j);
    show(rows);
  }
  for (std::size_t k = 0; k < kept; ++k) std::copy_n(last.data() + k * columns, columns, spoke(k));
}

void AzimuthMemory::stretch(std::span<std::uint8_t> video, std::uint32_t count, std::size_t begin,
                            std::size_t columns) {
  const std::size_t kept = 2 * std::size_t{stages_.stretch};
  with_earlier(shown_, kept, video, count, begin, columns, [&](const auto& rows) {
    for (std::size_t back = 0; back < kept; back += 2)
      keep_largest({rows[kept], columns}, {rows[back], columns}, {rows[back + 1], columns});
  });
}

void AzimuthMemory::smooth(std::span<std::uint8_t> video, std::uint32_t count, std::size_t begin,
                           std::size_t columns) {
  with_earlier(rough_, 2 * std::size_t{stages_.smoothing} - 2, video, count, begin, columns,
               [&](const auto& rows) {
                 smooth_rows({rows.data(), rows.size()}, {rows.back(), columns});
               });
}

void AzimuthMemory::fetch() const {
  for (const AlignedFloats* rows : {&totals_, &group_, &so_far_}) {
    if (rows->size() > kMostFetched) continue;
    for (std::size_t i = 0; i < rows->size(); i += kLineFloats)
      __builtin_prefetch(rows->data() + i, 1, 2);
  }
}

void AzimuthMemory::end_spokes(std::uint32_t count) { spokes_ += count; }

}  // namespace skerry::echo
