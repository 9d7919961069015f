// OffsetGraph: an edge refined as the graph of an offset over it, for the methods that make a
// random function of one variable.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "echo/fractal/edge_refiner.hpp"
#include "echo/fractal/fractional_bridge.hpp"

namespace skerry::echo {

// 2^-level, exactly; level <= 1000.
constexpr double half_to_the(int level) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 - level) << 52);
}

// The settings of a style that hold for all its edges.
struct GraphStyle {
  explicit GraphStyle(const CoastStyle& style);

  FractionalBridge bridge;  // of H = 2 - dimension
  BridgeProfile profile;
  double spread;     // of the middle, as part of the length: self_similar_spread(dimension)
  double amplitude;  // CoastStyle::amplitude

  // Pieces are halved at most this often: 500 km to 0.03 m.
  static constexpr int kDeepest = 24;
  std::array<double, kDeepest + 1> scale;  // 2^(-H level)
};

// vertex(t) = from + t along + h(t) left, t = i 2^-level in [0, 1], where along = to - from, left
// is along turned by 90 deg, and
//   h(t) = e(t) fold(A B(t) / deviation(t)),
// B a bridge of the method's random function (B(0) = B(1) = 0) of H = 2 - D.
//  - e(t) = tan (q + q^2 + 2 q^3 + 5 q^4), q = t (1 - t), the first terms of the series of
//    tan min(t, 1 - t): the room.  All its terms are positive, so |h| stays in the rhombus.
//  - fold(x): x reflected at -1 and 1 as often as it takes.  Unlike a saturating function it keeps
//    the roughness where the room is narrow.
//  - A: the spread of the middle, in terms of the room there: A e(1/2) = amplitude times the
//    self-similar spread, or times e(1/2) if that is less.
// A graph never crosses itself.  e / deviation is smooth, so the dimension is that of B; towards
// the ends it goes as t^(1-H), which makes the corner at a chart vertex look the same at any scale.
class OffsetGraph {
 public:
  struct Vertex {
    PlanePoint at;
    double t;
    double free;  // A B / deviation: before it is folded
    double room;  // e
    double gain;  // A e / deviation: dh / dB where not folded
  };

  OffsetGraph(const GraphStyle& style, const GrowingEdge& edge);

  bool is_straight() const { return amplitude_ == 0.0 || length_m_ == 0.0; }
  double length_m() const { return length_m_; }
  double most_gain_m() const { return length_m_ * amplitude_ * room(0.5); }

  Vertex first() const { return {edge_.from, 0.0, 0.0, 0.0, 0.0}; }
  Vertex last() const { return {edge_.to, 1.0, 0.0, 0.0, 0.0}; }
  // 0 < t < 1; `bridge` is B(t).
  Vertex vertex(double t, double bridge) const;

  // How far the curve between two vertices of a level may stand out from their chord, metres: two
  // standard deviations of the middle's offset, and half of what lies between them when there is a
  // fold there.
  double stands_out_m(int level, const Vertex& a, const Vertex& b) const;

  // Whether the piece between two vertices of a level is to be halved: not when nothing stands out
  // visibly, nor when it is shorter along the edge than 3 visible_m, three tenths of a cell.
  // Error (D 1.15): of what is left out a twentieth stands out by more than visible_m, the worst by
  // half a cell; held by EveryMethod.LeavesOutOnlyWhatIsHardlyVisible.
  bool is_halved(int level, const Vertex& a, const Vertex& b, const DetailLimit& limit) const;

 private:
  double room(double t) const {
    const double q = t * (1.0 - t);
    return edge_.half_angle_tan * (q * (1.0 + q * (1.0 + q * (2.0 + q * 5.0))));
  }
  static double fold(double x) {
    if (std::fabs(x) <= 1.0) return x;
    const double u = x + 1.0 - 4.0 * std::floor((x + 1.0) * 0.25);  // in [0, 4]
    return u < 2.0 ? u - 1.0 : 3.0 - u;
  }

  const GraphStyle& style_;
  const GrowingEdge& edge_;
  PlanePoint along_, left_;
  double length_m_, amplitude_;
};

// Grows an edge by halving.  Function: the random function of one edge, with
//   State: what it knows where it makes the middle of a piece;
//   Halves: room for what it knows of both halves;
//   double middle(const State&, int level, std::int64_t piece, Halves&): B in the middle;
//   void open(const State&, int level, std::int64_t piece, Halves&): called before a half is used;
//   State left(const State&, const Halves&), right(const State&, const Halves&).
template <typename Function>
class GraphGrower {
 public:
  GraphGrower(const OffsetGraph& graph, const Function& function, const DetailLimit& limit,
              std::vector<PlanePoint>& out)
      : graph_(graph), function_(function), limit_(limit), out_(out) {}

  // Piece `piece` of 2^level between a and b, which is to be halved.
  void grow(const typename Function::State& state, int level, std::int64_t piece,
            const OffsetGraph::Vertex& a, const OffsetGraph::Vertex& b) {
    typename Function::Halves halves;
    const double t = 0.5 * (a.t + b.t);
    const OffsetGraph::Vertex middle =
        graph_.vertex(t, function_.middle(state, level, piece, halves));
    const bool goes_on_left = graph_.is_halved(level + 1, a, middle, limit_);
    const bool goes_on_right = graph_.is_halved(level + 1, middle, b, limit_);
    if (goes_on_left || goes_on_right) function_.open(state, level, piece, halves);
    if (goes_on_left) {
      grow(function_.left(state, halves), level + 1, 2 * piece, a, middle);
    } else {
      out_.push_back(middle.at);
    }
    if (goes_on_right) {
      grow(function_.right(state, halves), level + 1, 2 * piece + 1, middle, b);
    } else {
      out_.push_back(b.at);
    }
  }

 private:
  const OffsetGraph& graph_;
  const Function& function_;
  const DetailLimit& limit_;
  std::vector<PlanePoint>& out_;
};

}  // namespace skerry::echo
