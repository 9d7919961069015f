#include "echo/sweeps/code_groups.hpp"

#include <algorithm>

#include "echo/kernel/sweep_codes.hpp"

namespace skerry::echo {

void CodeGroups::add(std::span<const std::uint16_t> codes) {
  if (held_ > 0) {
    const std::size_t rest = std::min<std::size_t>(codes.size(), group_ - held_);
    begin_or_end(codes.first(rest));
    codes = codes.subspan(rest);
  }
  const std::size_t whole = std::min(codes.size() / group_, out_.size());
  const std::span<const std::uint16_t> groups = codes.first(whole * group_);
  const std::span<std::uint16_t> made = out_.first(whole);
  switch (mode_) {
    case CodeDecimation::peak:
      decimate_by_peak(groups, group_, made);
      break;
    case CodeDecimation::mean:
      decimate_by_mean(groups, group_, made);
      break;
    case CodeDecimation::sum:
      decimate_by_sum(groups, group_, made);
      break;
  }
  out_ = out_.subspan(whole);
  begin_or_end(codes.subspan(whole * group_));
}

// Less than a group, or the end of one.
void CodeGroups::begin_or_end(std::span<const std::uint16_t> codes) {
  if (codes.empty() || out_.empty()) return;
  for (const std::uint32_t code : codes)
    value_ = mode_ == CodeDecimation::peak ? std::max(value_, code) : value_ + code;
  held_ += static_cast<std::uint32_t>(codes.size());
  if (held_ < group_) return;
  if (mode_ == CodeDecimation::mean) value_ = (value_ + group_ / 2) / group_;
  out_.front() = static_cast<std::uint16_t>(std::min<std::uint32_t>(value_, 65535));
  out_ = out_.subspan(1);
  value_ = held_ = 0;
}

}  // namespace skerry::echo
