// The ranges of another maker's radar on the closed table of ours, and how its spokes lie in our
// rows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/video/range_scale.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Two ranges that differ by less are the same: makers round (232 m for 1/8 NM).
inline constexpr double kSameRange = 0.005;

// The ranges that a family's radar can be set to, and how far its spokes reach.
struct DisplayRanges {
  std::vector<double> ranges_m;  // ascending
  double span_of_range = 1.0;    // a spoke's length over its range, at most 2
};

// How a spoke lies in our rows: they reach `parts` times as far as it, so that they never end
// short of the range scale; it takes their first part.
struct SpokeSpan {
  double range_m = 0.0;
  double span_m = 0.0;
  std::uint32_t parts = 1;
  double reach_m() const { return span_m * parts; }
};

// The smallest range scale that holds `range_m`, or the largest.
RangeScale scale_holding(double range_m);
// The range of the table nearest to `range_m`.
double nearest_range_m(const DisplayRanges& ranges, double range_m);
// The range that a display shows for a scale that somebody else chose: the table's range of that
// length, or the scale itself.
double range_shown_m(const DisplayRanges& ranges, RangeScale scale);

// The span of a spoke at a range.  The spoke lies in rows of the range's scale or of `scale`, at
// most twice as long.
SpokeSpan spoke_span(const DisplayRanges& ranges, double range_m, RangeScale scale);
// The range whose spokes reach as far as the view's rows do by themselves: a recording of such a
// radar, or an instrumented range that somebody has set.  Nothing if the view has none (0), or
// there is no such range.
std::optional<double> range_of_rows(const DisplayRanges& ranges, const wire::Settings& settings);
// The one whose rows reach so far, so that rows tell which range a display has chosen; rows of any
// other length are one spoke.
SpokeSpan span_of_rows(const DisplayRanges& ranges, RangeScale scale, double reach_m);

// The value that a display wrote, kept while the setting is the one it was converted to.  So the
// display reads its own value back, without the rounding of the conversion.  Forgotten as soon as
// observe() sees another setting: who comes back to this one means the setting itself.
template <typename Raw>
class Remembered {
 public:
  void remember(Raw raw, double setting) {
    raw_ = raw;
    setting_ = setting;
  }
  std::optional<Raw> of(double setting) const {
    const double off = setting - setting_;
    return raw_ && off < 1e-6 && off > -1e-6 ? raw_ : std::nullopt;
  }
  void observe(double setting) {
    if (!of(setting)) raw_.reset();
  }

 private:
  std::optional<Raw> raw_;
  double setting_ = 0.0;
};

}  // namespace skerry::server
