#include "server/plotter/judge/sticky_pairing.hpp"

#include <algorithm>
#include <stdexcept>

#include "server/plotter/assignment/assignment.hpp"

namespace skerry::server {

StickyPairing::StickyPairing(double cut_m, double keep_m) : cut_m_(cut_m), keep_m_(keep_m) {
  if (!(cut_m > 0.0)) throw std::invalid_argument("cut_m: must be more than 0 m");
  if (!(keep_m >= 0.0 && keep_m < cut_m))
    throw std::invalid_argument("keep_m: must be 0 m to less than the cut");
}

std::vector<std::size_t> StickyPairing::pair(std::span<const Named> truth,
                                             std::span<const Named> told) {
  std::vector<double> costs;
  costs.reserve(truth.size() * told.size());
  for (const Named& target : truth) {
    const auto held = held_.find(target.name);
    for (const Named& track : told) {
      const double apart_m = length_of(target.place - track.place);
      const bool keeps = held != held_.end() && held->second == track.name;
      costs.push_back(!(apart_m <= cut_m_) ? kNoPair
                      : keeps              ? std::max(0.0, apart_m - keep_m_)
                                           : apart_m);
    }
  }
  auto pairs = cheapest_pairs(costs, truth.size(), told.size(), cut_m_);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i] != kUnpaired) held_[truth[i].name] = told[pairs[i]].name;
  return pairs;
}

}  // namespace skerry::server
