#include "echo/chart/gshhg_bin.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace skerry::echo {
namespace {

constexpr std::int32_t kSide = GshhgGrid::kUnits;
constexpr std::int32_t kPerimeter = 4 * kSide;

bool bounds_land(int depth) { return depth % 2 == 1; }
int depth_of(std::uint8_t level) { return level == kIceFront ? 1 : level; }

// A line across the bin, turned so that what its level bounds lies on the left.
struct Line {
  std::vector<BinPoint> points;
  bool used = false;
};

// A line's beginning or end, as met on a walk counter-clockwise around the border.
struct BorderEvent {
  std::int32_t at = 0;  // units from the south-west corner
  bool entry = false;
  std::size_t line = 0;
};

bool on_side(BinPoint p, std::uint8_t side) {
  switch (side) {
    case 0:
      return p.y == 0;
    case 1:
      return p.x == kSide;
    case 2:
      return p.y == kSide;
    default:
      return p.x == 0;
  }
}

std::int32_t border_position(BinPoint p) {
  if (p.y == 0) return p.x;
  if (p.x == kSide) return kSide + p.y;
  if (p.y == kSide) return 3 * kSide - p.x;
  return kPerimeter - p.y;
}

BinPoint corner(std::int32_t index) {
  constexpr BinPoint kCorners[4] = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}};
  return kCorners[index % 4];
}

// Twice the area in square units, positive if counter-clockwise.
std::int64_t twice_area(std::span<const BinPoint> ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const BinPoint a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
    sum += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
  }
  return sum;
}

class RingBuilder {
 public:
  void go_to(BinPoint p, EdgeKind kind) {
    if (!ring_.points.empty()) {
      if (ring_.points.back() == p) return;
      ring_.edges.push_back(kind);
    }
    ring_.points.push_back(p);
  }
  // Around the corners of the border from one position to the other, counter-clockwise.
  void follow_border(std::int32_t from, std::int32_t to) {
    const std::int32_t distance = (to - from + kPerimeter) % kPerimeter;
    for (std::int32_t next = from / kSide + 1; next * kSide < from + distance; ++next)
      go_to(corner(next), EdgeKind::bin_border);
  }
  BinRing close(std::uint8_t level, EdgeKind kind) {
    if (ring_.points.size() > 1 && ring_.points.back() == ring_.points.front()) {
      ring_.points.pop_back();
    } else {
      ring_.edges.push_back(kind);
    }
    ring_.level = level;
    return std::move(ring_);
  }

 private:
  BinRing ring_;
};

// The same ring the other way round.
void reverse(BinRing& ring) {
  std::reverse(ring.points.begin(), ring.points.end());
  std::reverse(ring.edges.begin(), ring.edges.end());
  if (!ring.edges.empty())
    std::rotate(ring.edges.begin(), ring.edges.begin() + 1, ring.edges.end());
}

BinRing whole_bin(std::uint8_t level) {
  BinRing ring;
  ring.level = level;
  for (int i = 0; i < 4; ++i) ring.points.push_back(corner(i));
  ring.edges.assign(4, EdgeKind::bin_border);
  return ring;
}

// Puts events into the order of the walk, starting behind an exit.  Where lines touch on the border
// the stored order is lost; that entries and exits take turns gives it back.
std::vector<BorderEvent> in_walking_order(std::vector<BorderEvent> events) {
  std::sort(events.begin(), events.end(),
            [](const BorderEvent& a, const BorderEvent& b) { return a.at < b.at; });
  const std::size_t n = events.size();
  const auto lone_exit = [&](std::size_t i) {
    return !events[i].entry && events[i].at != events[(i + 1) % n].at &&
           events[i].at != events[(i + n - 1) % n].at;
  };
  std::size_t start = 0;
  while (start < n && !lone_exit(start)) ++start;
  if (start == n) throw BinError("lines cross the bin border but touch at every crossing");
  std::rotate(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(start), events.end());

  bool entry_is_next = true;
  for (std::size_t i = 1; i < n; ++i, entry_is_next = !entry_is_next) {
    std::size_t k = i;
    while (k < n && events[k].at == events[i].at && events[k].entry != entry_is_next) ++k;
    if (k == n || events[k].at != events[i].at)
      throw BinError(
          fmt::format("lines do not enter and leave in turns at border position {}", events[i].at));
    std::swap(events[i], events[k]);
  }
  return events;
}

// Joins lines along the border into counter-clockwise rings.
void join(std::vector<Line>& lines, std::uint8_t level, std::vector<BinRing>& rings) {
  std::vector<BorderEvent> events;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    events.push_back({border_position(lines[i].points.front()), true, i});
    events.push_back({border_position(lines[i].points.back()), false, i});
  }
  events = in_walking_order(std::move(events));

  std::vector<const BorderEvent*> exit_of(lines.size());
  for (const BorderEvent& event : events)
    if (!event.entry) exit_of[event.line] = &event;

  for (std::size_t first = 0; first < lines.size(); ++first) {
    if (lines[first].used) continue;
    RingBuilder ring;
    std::size_t at = first;
    do {
      lines[at].used = true;
      ring.go_to(lines[at].points.front(), EdgeKind::bin_border);
      for (const BinPoint p : lines[at].points) ring.go_to(p, EdgeKind::shoreline);
      const BorderEvent& exit = *exit_of[at];
      const BorderEvent& entry = *(&exit + 1);
      ring.follow_border(exit.at, entry.at);
      at = entry.line;
    } while (at != first);
    BinRing closed = ring.close(level, EdgeKind::bin_border);
    if (closed.points.size() > 2) rings.push_back(std::move(closed));
  }
}

void check(const ShoreSegment& segment) {
  if (depth_of(segment.level) < 1 || depth_of(segment.level) > 4)
    throw BinError(fmt::format("a segment has level {}, expected 1 to 4", segment.level));
  if (segment.points.size() < 2)
    throw BinError(fmt::format("a segment has {} points", segment.points.size()));
  const bool closed = segment.entry == ShoreSegment::kClosed;
  if (closed != (segment.exit == ShoreSegment::kClosed) || segment.entry > ShoreSegment::kClosed ||
      segment.exit > ShoreSegment::kClosed)
    throw BinError(
        fmt::format("a segment has the side codes {} and {}", segment.entry, segment.exit));
  if (closed && segment.points.front() != segment.points.back())
    throw BinError("a closed segment does not end where it begins");
  if (!closed && (!on_side(segment.points.front(), segment.entry) ||
                  !on_side(segment.points.back(), segment.exit)))
    throw BinError(fmt::format("a segment does not run from side {} to side {} as stated",
                               segment.entry, segment.exit));
}

void add_closed(const ShoreSegment& segment, std::vector<BinRing>& rings) {
  RingBuilder builder;
  for (const BinPoint p : segment.points) builder.go_to(p, EdgeKind::shoreline);
  BinRing ring = builder.close(segment.level, EdgeKind::shoreline);
  const std::int64_t area = twice_area(ring.points);
  if (area == 0) return;
  if ((area > 0) != bounds_land(depth_of(segment.level))) reverse(ring);
  rings.push_back(std::move(ring));
}

}  // namespace

std::vector<BinRing> assemble_bin(const BinShore& shore, bool antarctic) {
  for (const ShoreSegment& segment : shore.segments) check(segment);

  std::vector<BinRing> rings;
  for (int depth = 1; depth <= 4; ++depth) {
    std::uint8_t level = static_cast<std::uint8_t>(depth);
    std::vector<Line> lines;
    for (const ShoreSegment& segment : shore.segments) {
      if (depth_of(segment.level) != depth || segment.entry == ShoreSegment::kClosed) continue;
      level = std::max(level, segment.level);
      Line line{segment.points};
      if (!bounds_land(depth)) std::reverse(line.points.begin(), line.points.end());
      lines.push_back(std::move(line));
    }
    const std::size_t before = rings.size();
    if (!lines.empty()) {
      join(lines, level, rings);
    } else {
      const auto inside = [depth](std::uint8_t l) { return l >= depth; };
      const auto count =
          std::count_if(shore.corner_levels.begin(), shore.corner_levels.end(), inside);
      if (count == 4) rings.push_back(whole_bin(depth == 1 && antarctic ? kIceFront : level));
      if (count != 0 && count != 4)
        throw BinError(
            fmt::format("corners differ at level {}, yet no shoreline divides them", depth));
    }
    if (!bounds_land(depth))
      std::for_each(rings.begin() + static_cast<std::ptrdiff_t>(before), rings.end(), reverse);
    for (const ShoreSegment& segment : shore.segments) {
      if (depth_of(segment.level) == depth && segment.entry == ShoreSegment::kClosed)
        add_closed(segment, rings);
    }
  }
  return rings;
}

}  // namespace skerry::echo
