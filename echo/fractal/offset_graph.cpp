#include "echo/fractal/offset_graph.hpp"

#include "echo/fractal/dimension.hpp"
#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

namespace {

// At dimension 1 nothing stands off the edge, but the bridge needs a limit to be taken.
constexpr double kMostHurst = 1.0 - 1e-9;

// Pieces no longer along the edge than this many visible_m are not halved.
constexpr double kAlong = 3.0;

}  // namespace

GraphStyle::GraphStyle(const CoastStyle& style)
    : bridge(std::min(2.0 - style.dimension, kMostHurst)),
      profile(bridge),
      spread(self_similar_spread(style.dimension)),
      amplitude(style.amplitude) {
  for (int level = 0; level <= kDeepest; ++level) {
    scale[static_cast<std::size_t>(level)] = exact_exp2(-bridge.hurst() * level);
  }
}

OffsetGraph::OffsetGraph(const GraphStyle& style, const GrowingEdge& edge)
    : style_(style),
      edge_(edge),
      along_(edge.to - edge.from),
      left_{-along_.north_m, along_.east_m},
      length_m_(length_of(along_)) {
  const double most = room(0.5);
  amplitude_ = most > 0.0 ? style.amplitude * std::min(style.spread / most, 1.0) : 0.0;
}

OffsetGraph::Vertex OffsetGraph::vertex(double t, double bridge) const {
  const double e = room(t);
  const double share = amplitude_ * style_.profile.reciprocal(t);
  const double free = share * bridge;
  return {edge_.from + along_ * t + left_ * (e * fold(free)), t, free, e, e * share};
}

double OffsetGraph::stands_out_m(int level, const Vertex& a, const Vertex& b) const {
  // The gain rises towards the middle, so that it is greatest at an end but for the whole edge.
  const double gain = level == 0 ? amplitude_ * room(0.5) : std::max(a.gain, b.gain);
  const double most_room = level == 0 ? room(0.5) : std::max(a.room, b.room);
  double out = 2.0 * gain * style_.scale[static_cast<std::size_t>(level)];
  const bool unfolded = std::max(std::fabs(a.free), std::fabs(b.free)) <= 1.0;
  if (!unfolded && std::floor(0.5 * (a.free + 1.0)) != std::floor(0.5 * (b.free + 1.0))) {
    out += 0.5 * most_room * std::fabs(a.free - b.free);
  }
  return length_m_ * std::min(out, 2.0 * most_room);
}

bool OffsetGraph::is_halved(int level, const Vertex& a, const Vertex& b,
                            const DetailLimit& limit) const {
  if (level >= GraphStyle::kDeepest) return false;
  const double out = stands_out_m(level, a, b);
  const double along = length_m_ * half_to_the(level);
  const double least = limit.least_visible_m();
  if (out <= least || along <= kAlong * least)
    return false;  // most pieces end here, without a square root
  const PlanePoint chord = b.at - a.at;
  const double reach = 0.5 * (std::fabs(chord.east_m) + std::fabs(chord.north_m)) + out;
  const double visible = limit.visible_about((a.at + b.at) * 0.5, reach);
  return out > visible && along > kAlong * visible;
}

}  // namespace skerry::echo
