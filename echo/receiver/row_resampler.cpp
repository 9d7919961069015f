#include "echo/receiver/row_resampler.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/row_resampling.hpp"

namespace skerry::echo {

RowResampler::RowResampler(std::uint32_t row_cells, std::uint32_t view_cells, double ratio,
                           Decimation decimation)
    : decimation_(decimation), row_cells_(row_cells), ratio_(ratio) {
  reach_ = static_cast<std::uint32_t>(std::min<double>(view_cells, row_cells / ratio_ + 1e-6));
  if (ratio_ == 1.0) return;
  const bool shorter = ratio_ < 1.0;
  double left = shorter ? 1.0 / ratio_ : ratio_;
  while (left >= 2.0) {
    left *= 0.5;
    ++octaves_;
  }
  const std::uint32_t parts = 1u << octaves_;
  if (shorter) {
    const bool whole = left == 1.0 && view_cells % parts == 0 && view_cells / parts <= row_cells;
    way_ = whole ? Way::double_up : Way::interpolate;
    if (whole) return;
    for (std::uint32_t i = 0; i < view_cells; ++i) {
      const double middle = std::clamp((i + 0.5) * ratio_ - 0.5, 0.0, row_cells - 1.001);
      at_.push_back(static_cast<std::uint32_t>(middle));
      share_.push_back(static_cast<float>(middle - std::floor(middle)));
    }
    return;
  }
  way_ = left == 1.0 && row_cells % parts == 0              ? Way::halve
         : ratio_ <= 2.0 && decimation_ == Decimation::peak ? Way::pick_peaks
                                                            : Way::gather;
  if (way_ != Way::pick_peaks) return;
  for (std::uint32_t i = 0; i < reach_; ++i) {
    const Held held = held_by(i);
    at_.push_back(static_cast<std::uint32_t>(std::min(held.begin, std::size_t{row_cells} - 2)));
    last_.push_back(static_cast<std::uint32_t>(held.end - 1));
  }
}

RowResampler::Held RowResampler::held_by(std::uint32_t view_cell) const {
  if (way_ == Way::keep) return {view_cell, std::size_t{view_cell} + 1};
  if (ratio_ < 1.0) {
    const double middle = std::clamp((view_cell + 0.5) * ratio_ - 0.5, 0.0, row_cells_ - 2.0);
    return {static_cast<std::size_t>(middle), static_cast<std::size_t>(middle) + 2};
  }
  const auto begin = static_cast<std::size_t>(view_cell * ratio_);
  const auto end = static_cast<std::size_t>(std::ceil((view_cell + 1) * ratio_ - 1e-9));
  const auto last = std::max<std::size_t>(begin + 1, row_cells_);
  return {begin, std::clamp(end, begin + 1, last)};
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
  const std::size_t room = std::max(cells, in.size());
  scratch.resize(2 * room);
  // Two scratch rows in turn, so that the last step goes to `out`.
  const auto place = [&](unsigned step, std::size_t size) {
    if (step == octaves_) return out.first(size);
    return std::span(scratch).subspan(step % 2 * room, size);
  };
  switch (way_) {
    case Way::keep:
      std::copy_n(in.begin(), cells, out.begin());
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
      std::span<const float> row = in.first(std::size_t{reach_} << octaves_);
      for (unsigned step = 1; step <= octaves_; ++step) {
        const std::span<float> coarser = place(step, row.size() / 2);
        decimation_ == Decimation::peak ? halve_cells_by_peak(row, coarser)
                                        : halve_cells_by_mean(row, coarser);
        row = coarser;
      }
      break;
    }
    case Way::pick_peaks:
      peak_cells(in, at_, last_, out.first(reach_));
      break;
    case Way::gather:
      gather(in, out);
      break;
  }
  std::fill(out.begin() + reach_, out.end(), 0.0f);
}

}  // namespace skerry::echo
