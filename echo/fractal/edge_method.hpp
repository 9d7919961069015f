// EdgeMethod: the one interface behind which the methods of refinement stand.
#pragma once

#include <memory>
#include <vector>

#include "echo/fractal/edge_refiner.hpp"

namespace skerry::echo {

// Thread: immutable, any number.
class EdgeMethod {
 public:
  virtual ~EdgeMethod() = default;
  // With the guarantees of EdgeRefiner::refine().
  virtual void refine(const GrowingEdge& edge, const DetailLimit& limit,
                      std::vector<PlanePoint>& out) const = 0;
};

// For a valid style of that method.  Koch: the dimension is the similarity dimension in the widest
// envelope; the amplitude is a factor on the height of the apexes, up to what the envelope allows.
std::unique_ptr<const EdgeMethod> make_straight_method();
std::unique_ptr<const EdgeMethod> make_koch_method(const CoastStyle& style);
std::unique_ptr<const EdgeMethod> make_midpoint_method(const CoastStyle& style);
std::unique_ptr<const EdgeMethod> make_weierstrass_method(const CoastStyle& style);

}  // namespace skerry::echo
