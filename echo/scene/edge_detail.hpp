// How finely an edge is refined, as a whole.
#pragma once

#include "echo/fractal/edge_refiner.hpp"

namespace skerry::echo {

// An edge is refined by one of three rules, chosen by its distance and length alone:
//  - straight: it lies out of range, or all its room stands out less than the radar can tell;
//  - as a whole: down to one cell size for all its pieces.  A function of the edge's distance
//  class,
//    a quarter of an octave, so that it stays the same for most edges while the own ship sails;
//  - by piece: near edges longer than half their distance (of a coarse chart), where the detail
//    wanted differs from end to end.
// The detail made is never less than DetailLimit::visible_m asks of each piece, and at most what it
// would ask 1.19 times nearer and from the edge's nearest place on.
struct EdgeDetail {
  enum class Rule { straight, whole, by_piece };
  Rule rule = Rule::straight;
  double cell_m = 0.0;  // whole: refine as in such cells; see whole_edge_limit()
};

// `middle` and `length_m` of a straight edge; `limit` as for the radar.
EdgeDetail detail_of(PlanePoint middle, double length_m, const DetailLimit& limit);

// The limit by which an edge is refined as a whole: the same for all pieces, everywhere.
DetailLimit whole_edge_limit(double cell_m);

// The largest power of 2^(1/4) that is not greater than x; 0 for x <= 0.  Exact, no logarithm.
double quarter_octave_floor(double x);

}  // namespace skerry::echo
