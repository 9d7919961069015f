#include "server/plotter/judge/set_distance.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "server/plotter/assignment/assignment.hpp"

namespace skerry::server {
namespace {

void require_sound(double cut_m, double p) {
  if (!(cut_m > 0.0) || std::isinf(cut_m))
    throw std::invalid_argument("cut_m: must be more than 0 m");
  if (!(p >= 1.0) || std::isinf(p)) throw std::invalid_argument("p: must be 1 or more");
}

// Distances to the power of p, of each truth to each that was told.
std::vector<double> powers(std::span<const PlanePoint> truth, std::span<const PlanePoint> told,
                           double p) {
  std::vector<double> out;
  out.reserve(truth.size() * told.size());
  for (const PlanePoint a : truth)
    for (const PlanePoint b : told) out.push_back(std::pow(length_of(a - b), p));
  return out;
}

struct Paired {
  double sum = 0.0;  // of errors to the power of p
  std::size_t count = 0;
};

// Pairs nearer than cut_m; one that is not made costs cut_m^p.
Paired paired(std::span<const PlanePoint> truth, std::span<const PlanePoint> told, double cut_m,
              double p) {
  const std::vector<double> costs = powers(truth, told, p);
  const double most = std::pow(cut_m, p);
  const auto pairs = cheapest_pairs(costs, truth.size(), told.size(), most);
  Paired out;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i] == kUnpaired) continue;
    out.sum += costs[i * told.size() + pairs[i]];
    ++out.count;
  }
  return out;
}

}  // namespace

double ospa_m(std::span<const PlanePoint> truth, std::span<const PlanePoint> told, double cut_m,
              double p) {
  require_sound(cut_m, p);
  const std::size_t larger = std::max(truth.size(), told.size());
  if (larger == 0) return 0.0;
  const Paired pairs = paired(truth, told, cut_m, p);
  const double lacking = std::pow(cut_m, p) * static_cast<double>(larger - pairs.count);
  return std::pow((pairs.sum + lacking) / static_cast<double>(larger), 1.0 / p);
}

Gospa gospa(std::span<const PlanePoint> truth, std::span<const PlanePoint> told, double cut_m,
            double p) {
  require_sound(cut_m, p);
  const Paired pairs = paired(truth, told, cut_m, p);
  Gospa out;
  out.paired = pairs.count;
  out.missed = truth.size() - pairs.count;
  out.made_up = told.size() - pairs.count;
  const double each = std::pow(cut_m, p) / 2.0;
  out.m = std::pow(pairs.sum + each * static_cast<double>(out.missed + out.made_up), 1.0 / p);
  return out;
}

}  // namespace skerry::server
