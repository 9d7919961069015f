#include "echo/scene/polar_index.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

// Error of the bearings below, radians: 1.0e-5 by the polynomial, the rest by float.
constexpr float kBearingError = 2e-5f;

constexpr int kBucketShift = 20;
constexpr std::uint32_t kBucketMask = (std::uint32_t{1} << (32 - kBucketShift)) - 1;

// Buckets [first, first + count) of an edge, around the circle.
struct Span {
  std::uint16_t first = 0, count = 0;
};
constexpr std::uint16_t kOdd = 0xFFFF;  // a count: to be found out exactly

// Bearing of a vector in 2^-32 turns within kBearingError, and its length or up to 2 % less; in
// float, without branches and roots, so that compilers make vector code of it.
// Source: Abramowitz and Stegun (1964) 4.4.49; a concave function lies above its chord.
struct RoughPolar {
  std::int32_t bearing;
  float length;
};
inline RoughPolar rough_polar(float east, float north) {
  const float x = std::fabs(north), y = std::fabs(east);
  const float sum = x + y, difference = std::fabs(x - y);
  const float most = 0.5f * (sum + difference) + 1e-30f, least = 0.5f * (sum - difference);
  const float q = least / most, q2 = q * q;
  const float flat =
      q *
      (0.9998660f + q2 * (-0.3302995f + q2 * (0.1801410f + q2 * (-0.0851330f + q2 * 0.0208351f))));
  const float ahead = flat + static_cast<float>(y > x) * (1.57079633f - 2.0f * flat);
  const float to_right = ahead + static_cast<float>(north < 0.0f) * (3.14159265f - 2.0f * ahead);
  // A little less than 2^31 for half a turn, which would not fit.
  const float units = std::copysign(to_right, east) * 683565000.0f;
  return {static_cast<std::int32_t>(units), most * (1.0f + 0.414213f * q2)};
}

// At least the length of a vector, up to 8 % more.
inline float at_most_length(float east, float north) {
  const float x = std::fabs(north), y = std::fabs(east);
  return 0.5f * (1.414215f * (x + y) + 0.585787f * std::fabs(x - y));
}

// How far to either side of its ends' bearings an edge may be seen that is never nearer than
// `distance_m` (> 2 slack): asin(x) <= 1.0472 x for x <= 1/2.
inline std::int32_t margin_units(float slack_m, float distance_m) {
  return static_cast<std::int32_t>((1.05f * slack_m / distance_m + kBearingError) *
                                   static_cast<float>(kUnitsPerRadian));
}

inline std::int32_t turn_between(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(b) - static_cast<std::uint32_t>(a));
}

// Beyond it, which way round an edge goes may be lost in the rounding.
constexpr std::int32_t kAlmostHalfATurn = 1'900'000'000;

// For turns up to kAlmostHalfATurn and margins up to a sixth of a turn: less than once around.
inline Span span_of(std::int32_t a, std::int32_t b, std::int32_t turn, std::int32_t margin) {
  const auto low =
      static_cast<std::uint32_t>(turn < 0 ? b : a) - static_cast<std::uint32_t>(margin);
  const auto wide =
      (turn < 0 ? 0u - static_cast<std::uint32_t>(turn) : static_cast<std::uint32_t>(turn)) +
      2u * static_cast<std::uint32_t>(margin);
  constexpr std::uint32_t kInBucket = (std::uint32_t{1} << kBucketShift) - 1;
  return {static_cast<std::uint16_t>(low >> kBucketShift),
          static_cast<std::uint16_t>((((low & kInBucket) + wide) >> kBucketShift) + 1)};
}

// The values of vertices, one array each, so that compilers make vector code of the loops.
constexpr std::size_t kEdgesAtOnce = 1024;
struct Block {
  float east[kEdgesAtOnce + 1], north[kEdgesAtOnce + 1], length[kEdgesAtOnce + 1];
  std::int32_t bearing[kEdgesAtOnce + 1];
  Span span[kEdgesAtOnce];
  std::uint8_t is_odd[kEdgesAtOnce];
};

// Spans of `count` edges that begin at consecutive vertices; is_odd for those that pass so near, or
// are so long for their distance, that this is no good.
void rough_spans(const PlanePoint* vertices, std::size_t count, PlanePoint own_ship, float slack_m,
                 Block& block) {
  for (std::size_t v = 0; v <= count; ++v) {
    block.east[v] = static_cast<float>(vertices[v].east_m - own_ship.east_m);
    block.north[v] = static_cast<float>(vertices[v].north_m - own_ship.north_m);
  }
  for (std::size_t v = 0; v <= count; ++v) {
    const RoughPolar polar = rough_polar(block.east[v], block.north[v]);
    block.bearing[v] = polar.bearing;
    block.length[v] = polar.length;
  }
  const float least = 2.0f * slack_m + 0.1f;
  for (std::size_t v = 0; v < count; ++v) {
    const float east = block.east[v + 1] - block.east[v];
    const float north = block.north[v + 1] - block.north[v];
    // No place of an edge is nearer than its nearer end less half its length; 0.1 m and a
    // thousandth are for the rounding.
    const float l0 = block.length[v], l1 = block.length[v + 1];
    const float nearer = 0.5f * (l0 + l1 - std::fabs(l0 - l1));
    const float distance = 0.999f * nearer - 0.501f * at_most_length(east, north) - 0.1f;
    const float allowed = 0.5f * (distance + least + std::fabs(distance - least));  // the greater
    const std::int32_t margin = margin_units(slack_m, allowed);
    const std::int32_t turn = turn_between(block.bearing[v], block.bearing[v + 1]);
    block.span[v] = span_of(block.bearing[v], block.bearing[v + 1], turn, margin);
    block.is_odd[v] =
        static_cast<std::uint8_t>((distance < 0.8f * nearer) | (distance <= least) |
                                  (turn > kAlmostHalfATurn) | (turn < -kAlmostHalfATurn));
  }
}

// Calls visit(bucket, from, to) for the longest stretches [from, to) of edges that follow one
// another and all have that bucket; ascending for each bucket.  Coast runs on: that is far fewer
// calls than there are pairs of edge and bucket.
template <typename Visit>
void for_each_burst(const std::vector<Span>& spans, const Visit& visit) {
  std::vector<std::uint32_t> begun(kBucketMask + 1);  // by bucket of the edge before
  const auto open = [&](std::int32_t low, std::int32_t high, std::uint32_t edge) {
    for (std::int32_t k = low; k < high; ++k)
      begun[static_cast<std::uint32_t>(k) & kBucketMask] = edge;
  };
  const auto close = [&](std::int32_t low, std::int32_t high, std::uint32_t edge) {
    for (std::int32_t k = low; k < high; ++k) {
      const std::uint32_t bucket = static_cast<std::uint32_t>(k) & kBucketMask;
      visit(bucket, begun[bucket], edge);
    }
  };
  Span last;
  const auto count = static_cast<std::uint32_t>(spans.size());
  for (std::uint32_t v = 0; v <= count; ++v) {
    const Span next = v < count ? spans[v] : Span{};
    // Both unrolled about the beginning of the last: [f, l) and [g, h).
    const std::int32_t f = last.first, l = f + last.count;
    const std::int32_t g = f +
                           ((static_cast<std::int32_t>(next.first) - f + 6144) &
                            static_cast<std::int32_t>(kBucketMask)) -
                           2048;
    const std::int32_t h = g + next.count;
    if (last.count > 1024 || next.count > 1024) {  // might overlap at both ends
      close(f, l, v);
      open(g, h, v);
    } else {
      close(f, std::min(l, g), v);
      close(std::max({f, h, g}), l, v);
      open(g, std::min(h, f), v);
      open(std::max({g, l, f}), h, v);
    }
    last = next;
  }
}

}  // namespace

PolarIndex::PolarIndex(const CoastPicture& picture, PlanePoint own_ship, double slack_m)
    : own_ship_(own_ship), slack_m_(slack_m), starts_(kBuckets + 1, 0) {
  static_assert(kBuckets == kBucketMask + 1);
  const auto slack = static_cast<float>(slack_m * 1.000001);
  const std::vector<PlanePoint>& vertices = picture.vertices;
  std::vector<Span> spans(vertices.size());  // by edge; none between runs and for near edges
  Block block;
  for (std::size_t begin = 0; begin + 1 < vertices.size(); begin += kEdgesAtOnce) {
    const std::size_t count = std::min(kEdgesAtOnce, vertices.size() - 1 - begin);
    rough_spans(&vertices[begin], count, own_ship, slack, block);
    std::copy_n(block.span, count, &spans[begin]);
    for (std::size_t v = 0; v < count; ++v) {
      if (block.is_odd[v]) {
        spans[begin + v] = {0, kOdd};
      }
    }
  }
  for (const std::uint32_t run : picture.run_starts) {
    if (run > 0) spans[run - 1] = {};
  }
  for (std::uint32_t v = 0; v < spans.size(); ++v) {
    if (spans[v].count != kOdd) continue;
    const PlanePoint a = vertices[v] - own_ship, b = vertices[v + 1] - own_ship;
    const double distance = distance_to_segment({}, a, b);
    const auto bearing = [](PlanePoint p) {
      return rough_polar(static_cast<float>(p.east_m), static_cast<float>(p.north_m)).bearing;
    };
    const std::int32_t from = bearing(a), to = bearing(b), turn = turn_between(from, to);
    if (distance <= 2.0 * slack_m || turn > kAlmostHalfATurn || turn < -kAlmostHalfATurn) {
      spans[v] = {};
      near_.push_back(v);
    } else {
      spans[v] = span_of(from, to, turn, margin_units(slack, static_cast<float>(distance)));
    }
  }

  for_each_burst(spans, [&](std::uint32_t bucket, std::uint32_t from, std::uint32_t to) {
    starts_[bucket + 1] += to - from;
  });
  for (std::uint32_t k = 0; k < kBuckets; ++k) starts_[k + 1] += starts_[k];
  edges_ = std::make_unique_for_overwrite<std::uint32_t[]>(starts_[kBuckets]);
  std::vector<std::uint32_t> fill(starts_.begin(), starts_.end() - 1);
  for_each_burst(spans, [&](std::uint32_t bucket, std::uint32_t from, std::uint32_t to) {
    std::uint32_t* out = edges_.get() + fill[bucket];
    fill[bucket] += to - from;
    for (std::uint32_t v = from; v < to; ++v) *out++ = v;
  });
}

bool PolarIndex::serves(PlanePoint own_ship) const {
  const PlanePoint d = own_ship - own_ship_;
  return dot(d, d) <= slack_m_ * slack_m_;
}

std::span<const std::uint32_t> PolarIndex::candidates(std::uint32_t bearing_units) const {
  const std::uint32_t bucket =
      bearing_units / static_cast<std::uint32_t>(0x100000000ull / kBuckets);
  return {edges_.get() + starts_[bucket], starts_[bucket + 1] - starts_[bucket]};
}

}  // namespace skerry::echo
