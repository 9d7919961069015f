#include <algorithm>
#include <cmath>

#include "echo/fractal/dimension.hpp"
#include "echo/fractal/edge_refiner.hpp"
#include "echo/fractal/koch_edge.hpp"

namespace skerry::echo {
namespace {

class StraightMethod final : public EdgeMethod {
 public:
  void refine(const GrowingEdge& edge, const DetailLimit&,
              std::vector<PlanePoint>& out) const override {
    out.push_back(edge.to);
  }
};

class KochMethod final : public EdgeMethod {
 public:
  explicit KochMethod(const CoastStyle& style)
      : regular_(style.method == CoastMethod::regular_koch),
        apex_factor_(std::min(
            style.amplitude * (regular_ ? regular_apex_factor_for_dimension(style.dimension)
                                        : apex_factor_for_dimension(style.dimension)),
            regular_ ? kMaxRegularApexFactor : kMaxApexFactor)) {}

  void refine(const GrowingEdge& edge, const DetailLimit& limit,
              std::vector<PlanePoint>& out) const override {
    grow({edge.from, edge.to, edge.seed}, {edge.half_angle_tan, apex_factor_}, limit, out);
  }

 private:
  void grow(const CoastPiece& piece, Roughness roughness, const DetailLimit& limit,
            std::vector<PlanePoint>& out) const {
    const PlanePoint along = piece.to - piece.from;
    const double length = length_of(along);
    // The apex stands out by at most half the length times the two factors.
    const double height = 0.5 * length * roughness.half_angle_tan * roughness.apex_factor;
    if (height <= limit.least_visible_m() || height <= limit.visible_m(piece.from, piece.to)) {
      out.push_back(piece.to);
      return;
    }
    CoastPiece pieces[4];
    if (regular_) {
      split_regular(piece, roughness, pieces);
    } else {
      split(piece, roughness, pieces);
    }
    for (const CoastPiece& p : pieces) grow(p, roughness, limit, out);
  }

  bool regular_;
  double apex_factor_;
};

}  // namespace

std::unique_ptr<const EdgeMethod> make_straight_method(const CoastStyle&) {
  return std::make_unique<StraightMethod>();
}

std::unique_ptr<const EdgeMethod> make_koch_method(const CoastStyle& style) {
  return std::make_unique<KochMethod>(style);
}

}  // namespace skerry::echo
