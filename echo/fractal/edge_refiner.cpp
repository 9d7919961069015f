#include "echo/fractal/edge_refiner.hpp"

#include "echo/fractal/edge_method.hpp"

namespace skerry::echo {
namespace {

std::unique_ptr<const EdgeMethod> method_of(const CoastStyle& style) {
  require_valid(style);
  switch (style.method) {
    case CoastMethod::straight:
      break;
    case CoastMethod::regular_koch:
    case CoastMethod::random_koch:
      return make_koch_method(style);
    case CoastMethod::midpoint:
      return make_midpoint_method(style);
    case CoastMethod::weierstrass:
      return make_weierstrass_method(style);
  }
  return make_straight_method();
}

}  // namespace

EdgeRefiner::EdgeRefiner(const CoastStyle& style) : style_(style), method_(method_of(style)) {}

void EdgeRefiner::refine(const GrowingEdge& edge, const DetailLimit& limit,
                         std::vector<PlanePoint>& out) const {
  method_->refine(edge, limit, out);
}

}  // namespace skerry::echo
