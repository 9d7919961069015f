// PathTable: path_terms.hpp over range and height, for look-ups of a few nanoseconds.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "echo/propagation/path_terms.hpp"

namespace skerry::echo {

// Nodes per octave of range and of height, as powers of two; both evenly within an octave.
struct PathGrid {
  int range_bits = 4;   // 0 to 7
  int height_bits = 3;  // 0 to 7
  friend bool operator==(const PathGrid&, const PathGrid&) = default;
};

// Interpolates smooth terms only: the share of the two rays' difference that the Earth's roundness
// leaves, the mirror's strength, the loss in dB, and how a body's mean differs from that of a
// straight mirror.  The phase follows exactly from range, height and the first, so lobes and nulls
// stand where they belong however coarse the nodes.  Bounds against point_reference() and
// body_reference(), in dB two-way: propagation.hpp.
// Heights beyond 0.25 and 4095 m count as these; ranges under 32 m take the terms of 32 m (but
// their own phase), ranges over `reach_m` those of reach_m.
// Immutable; any thread.
class PathTable {
 public:
  // Requires reach_m <= 1000 km.
  PathTable(const PathConditions& conditions, double reach_m, PathGrid grid = {});

  float point(float range_m, float height_m) const;  // two-way, gas included
  float body(float range_m, float height_m) const;
  float gas(float range_m) const;  // two-way

  std::size_t bytes() const { return nodes_.size() * sizeof(Node); }

 private:
  // Four floats that are interpolated at once.
  typedef float Node __attribute__((vector_size(16)));
  enum Term {
    kBulge,      // metres by which the Earth lowers antenna and target together
    kRho,        // of the mirror, unfaded
    kLoss,       // octaves two-way
    kBodyRatio,  // of a body's mean to that of a straight mirror
  };
  struct Place;
  struct Ray;
  Place place_of(float range_m, float height_m) const;
  Ray ray_at(const Place& place) const;
  Ray ray_of(const Node& node, float range_m, float height_m) const;
  void lay_points(const PathConditions& conditions);
  Node node_of(const PathConditions& conditions, double range_m, double height_m) const;
  void lay_bodies(const PathConditions& conditions);
  double range_of_row(std::size_t row) const;
  double height_of_column(std::size_t column) const;
  double mean_between(const Node& low, const Node& high, double range_m, double bottom_m,
                      double top_m) const;
  double mean_below_first(const PathConditions& conditions, double range_m) const;

  PathGrid grid_;
  float row_share_, column_share_;  // of the rest of a float's bits behind its node
  float antenna_m_;
  float turns_per_metre_;  // of the rays' difference
  float gas_octaves_m_;    // two-way
  float last_range_;       // of the last row
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Node> nodes_;  // [row][column]
};

// The table of these conditions, shared between radars that ask for the same; the four asked for
// last are kept.  Thread: any.
std::shared_ptr<const PathTable> path_table_for(const PathConditions& conditions, double reach_m);

}  // namespace skerry::echo
