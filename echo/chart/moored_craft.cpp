#include "echo/chart/moored_craft.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "echo/chart/land_lookup.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr double kFrameMetresPerDegree =
    111'132.0;  // of latitude; of longitude at the equator 0.2 % more
constexpr double kLatticePerDegree = 1e7;
constexpr float kHighestPontoon = 1.5f;  // metres: hulks and floating docks are higher
constexpr double kBetweenRows = 36.0;    // metres between the middles of double rows in an area
constexpr std::size_t kMostBerths = 100'000;  // looked at, of an area
constexpr double kSpreadDb = 5.0;

struct Habit {
  double pitch_m, off_m;  // from berth to berth, and from what they lie at to the craft's middle
  double taken;
  double median_m2;
  float height_m;
};
constexpr Habit kPleasure{5.0, 5.5, 0.7, 2.5, 2.0f};
constexpr Habit kFishing{7.0, 7.0, 0.6, 10.0, 3.0f};

// Metres about a place.
struct BerthFrame {
  GeoPoint origin;
  double per_longitude;
  explicit BerthFrame(GeoPoint at)
      : origin(at), per_longitude(kFrameMetresPerDegree * sin_cos_degrees(at.latitude_deg).cos) {}
  PlanePoint in(GeoPoint p) const {
    return {wrapped_longitude(p.longitude_deg - origin.longitude_deg) * per_longitude,
            (p.latitude_deg - origin.latitude_deg) * kFrameMetresPerDegree};
  }
  // To the nearest 1e-7 degrees.
  GeoPoint out(PlanePoint p) const {
    const auto rounded = [](double v) {
      return std::round(v * kLatticePerDegree) / kLatticePerDegree;
    };
    const double aside = per_longitude > 1.0 ? p.east_m / per_longitude : 0.0;
    return {rounded(origin.latitude_deg + p.north_m / kFrameMetresPerDegree),
            wrapped_longitude(rounded(origin.longitude_deg + aside))};
  }
};

struct BerthBounds {
  double south = 90.0, north = -90.0, west = 0.0, east = 0.0;  // degrees east of the first place
  double from = 0.0;
  bool empty = true;

  void add(const std::vector<GeoPoint>& places, double margin_deg) {
    for (const GeoPoint p : places) {
      if (empty) from = p.longitude_deg;
      const double x = wrapped_longitude(p.longitude_deg - from);
      west = empty ? x - margin_deg : std::min(west, x - margin_deg);
      east = empty ? x + margin_deg : std::max(east, x + margin_deg);
      south = std::min(south, p.latitude_deg - margin_deg);
      north = std::max(north, p.latitude_deg + margin_deg);
      empty = false;
    }
  }
  bool holds(GeoPoint p) const {
    const double x = wrapped_longitude(p.longitude_deg - from);
    return !empty && x >= west && x <= east && p.latitude_deg >= south && p.latitude_deg <= north;
  }
};

std::uint64_t name_of(GeoPoint p) {
  const auto north = static_cast<std::int64_t>(std::llround(p.latitude_deg * kLatticePerDegree));
  const auto east = static_cast<std::int64_t>(std::llround(p.longitude_deg * kLatticePerDegree));
  return mixed(0x6372616674ull, static_cast<std::uint64_t>(north),
               static_cast<std::uint64_t>(east));
}

// Near a normal deviate: the sum of four even ones.
double deviate(std::uint64_t hash) {
  double sum = -2.0;
  for (std::uint64_t k = 1; k <= 4; ++k) sum += as_unit(mixed(hash, k));
  return sum * 1.7320508075688772;
}

class Harbour {
 public:
  Harbour(const Moorings& moorings, const std::vector<CoastRing>& rings, const BerthBounds& all)
      : moorings_(moorings),
        land_(rings, wrapped_longitude(all.from + all.west), all.east - all.west, all.south) {
    for (const MooringArea& area : moorings.areas) {
      areas_.emplace_back();
      for (const auto& ring : area.rings) areas_.back().add(ring, 0.0);
    }
    used_.assign(moorings.areas.size(), false);
  }

  bool full() const { return craft_.size() >= kMostCraft || work_ >= kMostMooringWork; }
  std::vector<ChartObject> take() { return std::move(craft_); }

  // The habit of the harbour that the line is in; null outside all.
  const Habit* habit_at(const std::vector<GeoPoint>& line) {
    const Habit* found = nullptr;
    for (const GeoPoint p : {line.front(), line[line.size() / 2]}) {
      for (std::size_t i = 0; i < moorings_.areas.size(); ++i) {
        if (!areas_[i].holds(p) || !inside(moorings_.areas[i], p)) continue;
        used_[i] = true;
        if (!found) found = moorings_.areas[i].fishing ? &kFishing : &kPleasure;
      }
    }
    work_ += moorings_.areas.size() + moorings_.places.size();
    for (std::size_t i = 0; !found && i < moorings_.places.size(); ++i) {
      const PlanePoint off = BerthFrame(moorings_.places[i].place).in(line[line.size() / 2]);
      if (dot(off, off) <= kPlaceReach * kPlaceReach)
        found = moorings_.places[i].fishing ? &kFishing : &kPleasure;
    }
    return found;
  }

  void add_along(const std::vector<GeoPoint>& line, bool closed, const Habit& habit) {
    const std::size_t n = line.size();
    const BerthFrame frame(line.front());
    double area = 0.0;
    if (closed) {
      for (std::size_t i = 0; i < n; ++i)
        area += cross(frame.in(line[i]), frame.in(line[(i + 1) % n]));
    }
    for (std::size_t i = 0; i + (closed ? 0 : 1) < n && !full(); ++i) {
      const GeoPoint from = line[i];
      const BerthFrame local(from);
      const PlanePoint to = local.in(line[(i + 1) % n]);
      const double length = length_of(to);
      if (!(length >= 0.5 * habit.pitch_m && length < 10'000.0)) continue;
      const PlanePoint along = to * (1.0 / length), right{along.north_m, -along.east_m};
      const auto berths =
          static_cast<std::size_t>(std::max(1.0, std::floor(length / habit.pitch_m)));
      const double pitch = length / static_cast<double>(berths);
      for (const double side : {-1.0, 1.0}) {
        if (closed && (area > 0.0) != (side > 0.0))
          continue;  // counter-clockwise: outside is right
        for (std::size_t k = 0; k < berths && !full(); ++k) {
          const PlanePoint at =
              along * ((static_cast<double>(k) + 0.5) * pitch) + right * (side * habit.off_m);
          put(local.out(at), habit);
        }
      }
    }
  }

  // In rows; false where a bound left some out.
  bool fill(std::size_t index) {
    const MooringArea& area = moorings_.areas[index];
    if (used_[index] || area.rings.empty() || area.rings.front().size() < 3) return true;
    const Habit& habit = area.fishing ? kFishing : kPleasure;
    const std::vector<GeoPoint>& outer = area.rings.front();
    const BerthFrame frame(outer.front());
    PlanePoint longest{1.0, 0.0};
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const PlanePoint side = frame.in(outer[(i + 1) % outer.size()]) - frame.in(outer[i]);
      if (dot(side, side) > dot(longest, longest)) longest = side;
    }
    const PlanePoint along = longest * (1.0 / length_of(longest));
    const PlanePoint left{-along.north_m, along.east_m};
    double low = 0.0, high = 0.0;
    for (const GeoPoint p : outer) {
      low = std::min(low, dot(frame.in(p), left));
      high = std::max(high, dot(frame.in(p), left));
    }
    const std::size_t before = craft_.size();
    std::size_t berths = 0;
    std::vector<double> limits;
    for (double middle = low + 0.5 * kBetweenRows; middle < high; middle += kBetweenRows) {
      for (const double side : {-habit.off_m, habit.off_m}) {
        const double row = middle + side;
        cut(area, frame, along, left, row, limits);
        for (std::size_t i = 0; i + 1 < limits.size(); i += 2) {
          double at = std::ceil(limits[i] / habit.pitch_m) * habit.pitch_m;
          for (; at < limits[i + 1]; at += habit.pitch_m) {
            if (craft_.size() - before >= kMostCraftInArea || ++berths > kMostBerths || full())
              return false;
            put(frame.out(along * at + left * row), habit);
          }
        }
        if (++berths > kMostBerths || full()) return false;
      }
    }
    return true;
  }

 private:
  bool inside(const MooringArea& area, GeoPoint p) {
    bool in = false;
    for (const auto& ring : area.rings) {
      work_ += ring.size();
      const BerthFrame frame(p);
      PlanePoint a = frame.in(ring.back());
      for (const GeoPoint vertex : ring) {
        const PlanePoint b = frame.in(vertex);
        if ((a.north_m > 0.0) != (b.north_m > 0.0) &&
            a.east_m + (b.east_m - a.east_m) * (a.north_m / (a.north_m - b.north_m)) > 0.0)
          in = !in;
        a = b;
      }
    }
    return in;
  }

  // Where the line of places with dot(place, left) = row enters and leaves the area.
  void cut(const MooringArea& area, const BerthFrame& frame, PlanePoint along, PlanePoint left,
           double row, std::vector<double>& limits) {
    limits.clear();
    for (const auto& ring : area.rings) {
      work_ += ring.size();
      PlanePoint a = frame.in(ring.back());
      for (const GeoPoint vertex : ring) {
        const PlanePoint b = frame.in(vertex);
        const double at_a = dot(a, left) - row, at_b = dot(b, left) - row;
        if ((at_a > 0.0) != (at_b > 0.0))
          limits.push_back(dot(a, along) +
                           (dot(b, along) - dot(a, along)) * (at_a / (at_a - at_b)));
        a = b;
      }
    }
    std::sort(limits.begin(), limits.end());
  }

  void put(GeoPoint place, const Habit& habit) {
    const std::uint64_t name = name_of(place);
    if (as_unit(mixed(name, 1)) >= habit.taken || std::abs(place.latitude_deg) > 89.0) return;
    // A square of the Earth with sides of kLeastApart; those around it may hold one too near.
    const double per_longitude = BerthFrame(place).per_longitude;
    const auto row = static_cast<std::int64_t>(
        std::floor(place.latitude_deg * kFrameMetresPerDegree / kLeastApart));
    const auto column =
        static_cast<std::int64_t>(std::floor(place.longitude_deg * per_longitude / kLeastApart));
    const auto square = [](std::int64_t r, std::int64_t c) {
      return static_cast<std::uint64_t>(r) << 32 ^ (static_cast<std::uint64_t>(c) & 0xFFFFFFFFu);
    };
    for (std::int64_t r = row - 1; r <= row + 1; ++r) {
      for (std::int64_t c = column - 2; c <= column + 2; ++c) {
        const auto [first, last] = taken_.equal_range(square(r, c));
        for (auto it = first; it != last; ++it) {
          const PlanePoint off = BerthFrame(place).in(craft_[it->second].outline.front());
          if (dot(off, off) < kLeastApart * kLeastApart) return;
        }
      }
    }
    work_ += land_.cost(place) + 16;
    if (land_.is_land(place)) return;
    taken_.emplace(square(row, column), craft_.size());
    ChartObject craft;
    craft.kind = ObjectClass::craft;
    craft.outline = {place};
    craft.identity = name;
    craft.height_m = habit.height_m * static_cast<float>(0.75 + 0.5 * as_unit(mixed(name, 2)));
    craft.cross_section_m2 = static_cast<float>(
        habit.median_m2 * exact_exp2(kOctavesPerDb * kSpreadDb * deviate(mixed(name, 3))));
    craft_.push_back(std::move(craft));
  }

  const Moorings& moorings_;
  LandLookup land_;
  std::vector<BerthBounds> areas_;
  std::vector<bool> used_;  // areas that have pontoons, piers or berths
  std::vector<ChartObject> craft_;
  std::unordered_multimap<std::uint64_t, std::size_t> taken_;
  std::size_t work_ = 0;
};

bool is_pontoon(const ChartObject& o) {
  return o.kind == ObjectClass::pontoon && o.height_m <= kHighestPontoon && o.outline.size() > 1;
}
bool is_pier(const ChartObject& o) { return o.kind == ObjectClass::pier && o.outline.size() > 1; }

}  // namespace

std::vector<ChartObject> moored_craft(const Moorings& moorings,
                                      const std::vector<ChartObject>& objects,
                                      const std::vector<CoastRing>& rings, const std::string& chart,
                                      std::vector<std::string>& reports) {
  constexpr double kMargin = 0.01;  // degrees
  BerthBounds all;
  const bool harbours = !moorings.areas.empty() || !moorings.places.empty();
  for (const MooringArea& area : moorings.areas) {
    for (const auto& ring : area.rings) all.add(ring, kMargin);
  }
  for (const ChartObject& o : objects) {
    if (is_pontoon(o) || (harbours && is_pier(o))) all.add(o.outline, kMargin);
  }
  if (harbours) {
    for (const auto& berth : moorings.berths) all.add(berth, kMargin);
  }
  if (all.empty) return {};
  Harbour harbour(moorings, rings, all);
  for (const ChartObject& o : objects) {
    if (harbour.full()) break;
    if (is_pontoon(o)) {
      const Habit* habit = harbours ? harbour.habit_at(o.outline) : nullptr;
      harbour.add_along(o.outline, o.closed, habit ? *habit : kPleasure);
    } else if (harbours && is_pier(o)) {
      if (const Habit* habit = harbour.habit_at(o.outline))
        harbour.add_along(o.outline, o.closed, *habit);
    }
  }
  for (const auto& berth : moorings.berths) {
    if (harbour.full() || !harbours) break;
    if (berth.size() < 2) continue;
    if (const Habit* habit = harbour.habit_at(berth)) harbour.add_along(berth, false, *habit);
  }
  for (std::size_t i = 0; i < moorings.areas.size() && !harbour.full(); ++i) {
    if (!harbour.fill(i) && !harbour.full())
      reports.push_back(moorings.areas[i].name + ": more than the " +
                        std::to_string(kMostCraftInArea) +
                        " moored craft an area may have; the rest left out");
  }
  if (harbour.full())
    reports.push_back(
        chart + ": more than the " + std::to_string(kMostCraft) +
        " moored craft a chart may have, or too many edges to keep them off the land; "
        "the rest left out");
  return harbour.take();
}

void remove_craft_ashore(CoastChart& chart) {
  BerthBounds all;
  for (const ChartObject& o : chart.objects) {
    if (o.kind == ObjectClass::craft) all.add(o.outline, 0.001);
  }
  if (all.empty) return;
  const LandLookup land(chart.rings, wrapped_longitude(all.from + all.west), all.east - all.west,
                        all.south);
  std::size_t work = 0;
  std::erase_if(chart.objects, [&](const ChartObject& o) {
    if (o.kind != ObjectClass::craft) return false;
    work += land.cost(o.outline.front());
    return work > kMostMooringWork || land.is_land(o.outline.front());
  });
}

}  // namespace skerry::echo
