// ChartAnswer: what a host tells of its chart, or why it tells nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

namespace skerry::server {

enum class NoChart : std::uint8_t {
  none_here,  // the host has no chart, or cannot read it
  busy,       // too many ask at once
};

template <typename Told>
class ChartAnswer {
 public:
  // Of either, so that hosts hand over one or the other.
  ChartAnswer(Told told) : told_(std::move(told)) {}  // NOLINT(google-explicit-constructor)
  ChartAnswer(NoChart why) : why_(why) {}             // NOLINT(google-explicit-constructor)

  bool has_value() const { return told_.has_value(); }
  explicit operator bool() const { return has_value(); }
  // Requires one.
  Told& operator*() { return *told_; }
  const Told& operator*() const { return *told_; }
  // Requires none.
  NoChart why() const { return why_; }

 private:
  std::optional<Told> told_;
  NoChart why_ = NoChart::none_here;
};

}  // namespace skerry::server
