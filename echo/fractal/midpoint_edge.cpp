#include "echo/fractal/midpoint_edge.hpp"

#include <cmath>

#include "echo/fractal/edge_refiner.hpp"

namespace skerry::echo {
namespace {

// A weighted sum of values of the process that vanishes on straight lines.
struct Weight {
  double t, weight;
};

double covariance(const FractionalBridge& bridge, std::span<const Weight> a,
                  std::span<const Weight> b, double shift) {
  double sum = 0.0;
  for (const Weight& p : a) {
    for (const Weight& q : b) {
      sum += p.weight * q.weight * bridge.increment(std::fabs(p.t - q.t - shift));
    }
  }
  return -0.5 * sum;
}

}  // namespace

MidpointTables::MidpointTables(const FractionalBridge& bridge) {
  // The middle of two vertices less their mean, and what the two farther ones tell of it.
  const std::array<Weight, 3> bend{{{-0.5, -0.5}, {0.0, 1.0}, {0.5, -0.5}}};
  const std::array<Weight, 4> told{{{-1.5, 1.0}, {-0.5, -1.0}, {0.5, -1.0}, {1.5, 1.0}}};
  far = covariance(bridge, bend, told, 0.0) / covariance(bridge, told, told, 0.0);
  near = 0.5 - far;

  // Innovations as a moving average (own, next): their variance and that of neighbours follow.
  const std::array<Weight, 5> rest{
      {{-1.5, -far}, {-0.5, -near}, {0.0, 1.0}, {0.5, -near}, {1.5, -far}}};
  const double variance = covariance(bridge, rest, rest, 0.0);
  const double beside = covariance(bridge, rest, rest, 1.0);
  const double own2 =
      0.5 * (variance + std::sqrt(std::fmax(0.0, variance * variance - 2.0 * beside * beside)));
  own = std::sqrt(own2);
  next = beside / (2.0 * own);

  // Cholesky.
  constexpr double kAt[4] = {-2.0, -1.0, 2.0, 3.0};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest_of = bridge.covariance(kAt[i], kAt[j]);
      for (std::size_t k = 0; k < j; ++k) rest_of -= start[i][k] * start[j][k];
      start[i][j] = i == j ? std::sqrt(std::fmax(0.0, rest_of)) : rest_of / start[j][j];
    }
  }
}

MidpointFunction::MidpointFunction(const MidpointTables& tables, std::span<const double> scale,
                                   std::uint64_t seed)
    : tables_(tables), scale_(scale), key_(mixed(seed, 0xF8A2)) {
  std::array<double, 4> outside{};
  for (std::size_t k = 0; k < 4; ++k) {
    const double z = gaussian_of(mixed(key_, k));
    for (std::size_t i = k; i < 4; ++i) outside[i] += tables.start[i][k] * z;
  }
  start_ = {outside[0], outside[1], 0.0, 0.0, outside[2], outside[3]};
}

namespace {

class MidpointMethod final : public EdgeMethod {
 public:
  explicit MidpointMethod(const CoastStyle& style) : style_(style), tables_(style_.bridge) {}

  void refine(const GrowingEdge& edge, const DetailLimit& limit,
              std::vector<PlanePoint>& out) const override {
    const OffsetGraph graph(style_, edge);
    if (graph.is_straight() || !graph.is_halved(0, graph.first(), graph.last(), limit)) {
      out.push_back(edge.to);
      return;
    }
    const MidpointFunction function(tables_, style_.scale, edge.seed);
    GraphGrower(graph, function, limit, out)
        .grow(function.start(), 0, 0, graph.first(), graph.last());
  }

 private:
  GraphStyle style_;
  MidpointTables tables_;
};

}  // namespace

std::unique_ptr<const EdgeMethod> make_midpoint_method(const CoastStyle& style) {
  return std::make_unique<MidpointMethod>(style);
}

}  // namespace skerry::echo
