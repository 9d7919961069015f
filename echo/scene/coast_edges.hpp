// CoastEdges: a chart's coast laid into a plane, with what is known of every edge.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/local_plane.hpp"
#include "echo/fractal/clearance.hpp"
#include "echo/scene/coast_rules.hpp"
#include "echo/scene/picture_shore.hpp"

namespace skerry::echo {

// Shoreline and seams in the order of the chart's rings; an edge begins where the one before it
// ended if their vertex ids say so.  Bin borders are left out, and so is what bounds nothing: rings
// of fewer than three vertices and edges whose ends are one vertex.
//
// Type of an edge: the chart's, or where that is unknown what shore_guess.hpp makes of its stretch
// (if rules.guess_types); over either that of the last place that holds the edge's middle and
// states a type.  Style: of the last place that holds its middle and states one, else of its type.
struct CoastEdges {
  std::vector<ShoreEdge> edges;
  std::vector<std::uint8_t> shores;    // by edge, index into `kinds`
  std::vector<std::uint16_t> styles;   // by edge, index into `all_styles`
  std::vector<PictureShore> kinds;     // [0] is PictureShore{}; at most 256
  std::vector<CoastStyle> all_styles;  // distinct
};

// Edges are left out that are farther from the plane's anchor than kKeptBeyond + the chart's radius
// with all of their length: a whole continent costs only what is near, and nothing from the other
// side of the Earth, where the plane is torn apart, runs across it.
inline constexpr double kKeptBeyond = 500e3;  // metres: no shorter edge is cleared of less

// More than 255 kinds of shore are made fewer by rounding heights, to 0.25 m or coarser.
// Error: std::invalid_argument, naming the ring and the vertex, for a chart that contradicts itself
// (lists of different lengths, positions off the globe), and for more than 65535 different styles.
CoastEdges lay_edges(const CoastChart& chart, const LocalPlane& plane, const CoastRules& rules);

}  // namespace skerry::echo
