#include "echo/receiver/row_resampler.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/row_resampling.hpp"

namespace skerry::echo {

RowResampler::RowResampler(std::uint32_t cells, RangeScale radar, RangeScale view,
                           Decimation decimation)
    : decimation_(decimation),
      ratio_(view.in_nautical_miles() / radar.in_nautical_miles()),
      reach_(cells) {
  if (view == radar) return;
  const bool shorter = ratio_ < 1.0;
  double left = shorter ? 1.0 / ratio_ : ratio_;
  while (left >= 2.0) {
    left *= 0.5;
    ++octaves_;
  }
  const bool whole = left == 1.0 && cells % (1u << octaves_) == 0;
  if (shorter) {
    way_ = whole ? Way::double_up : Way::interpolate;
    if (whole) return;
    for (std::uint32_t i = 0; i < cells; ++i) {
      const double middle = std::clamp((i + 0.5) * ratio_ - 0.5, 0.0, cells - 1.001);
      at_.push_back(static_cast<std::uint32_t>(middle));
      share_.push_back(static_cast<float>(middle - std::floor(middle)));
    }
    return;
  }
  way_ = whole ? Way::halve : Way::gather;
  reach_ = static_cast<std::uint32_t>(cells / ratio_);
}

void RowResampler::gather(std::span<const float> in, std::span<float> out) const {
  for (std::uint32_t i = 0; i < reach_; ++i) {
    const auto begin = static_cast<std::size_t>(i * ratio_);
    const auto end = std::min(in.size(), static_cast<std::size_t>(std::ceil((i + 1) * ratio_)));
    float peak = 0.0f, sum = 0.0f;
    for (std::size_t k = begin; k < end; ++k) {
      peak = std::max(peak, in[k]);
      sum += in[k];
    }
    out[i] = decimation_ == Decimation::peak ? peak : sum / static_cast<float>(end - begin);
  }
}

void RowResampler::resample(std::span<const float> in, std::span<float> out) const {
  const std::size_t cells = out.size();
  thread_local std::vector<float> scratch;
  scratch.resize(2 * cells);
  // Two scratch rows in turn, so that the last step goes to `out`.
  const auto place = [&](unsigned step, std::size_t size) {
    if (step == octaves_) return out.first(size);
    return std::span(scratch).subspan(step % 2 * cells, size);
  };
  switch (way_) {
    case Way::keep:
      std::copy(in.begin(), in.end(), out.begin());
      return;
    case Way::interpolate:
      return interpolate_cells(in, at_, share_, out);
    case Way::double_up: {
      std::span<const float> row = in.first(cells >> octaves_);
      for (unsigned step = 1; step <= octaves_; ++step) {
        const std::span<float> finer = place(step, row.size() * 2);
        double_cells(row, finer);
        row = finer;
      }
      return;
    }
    case Way::halve: {
      std::span<const float> row = in;
      for (unsigned step = 1; step <= octaves_; ++step) {
        const std::span<float> coarser = place(step, row.size() / 2);
        decimation_ == Decimation::peak ? halve_cells_by_peak(row, coarser)
                                        : halve_cells_by_mean(row, coarser);
        row = coarser;
      }
      break;
    }
    case Way::gather:
      gather(in, out);
      break;
  }
  std::fill(out.begin() + reach_, out.end(), 0.0f);
}

}  // namespace skerry::echo
