// Guesses the type of an untyped coast from its shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/chart/coast_chart.hpp"

namespace skerry::echo {

// A run of coast is judged in stretches of 21 edges and more, 41 on average.  Where one stretch
// ends and the next begins is decided by the vertices there alone: those whose hashed identity is
// less than that of the 20 before and the 20 behind.  So every chart window, ring start and anchor
// that shows the same coast judges the same stretches.
inline constexpr std::size_t kStretchReach = 20;

// Indices of the vertices where stretches begin, ascending, at least one.  `closed`: the last
// vertex joins the first.  An open run begins a stretch at 0 as well; a closed one of 40 vertices
// or fewer is one stretch, begun at its least vertex.
std::vector<std::uint32_t> stretch_starts(std::span<const std::uint64_t> vertex_ids, bool closed);

// rocky: divider dimension at least 1.10 between rulers of 1.5 and 6 mean edges; sandy: at most
// 1.01, over 3 km or more; else unknown, and so is what is shorter than 16 edges.
// On GSHHG full, by length within 40 km: off Bergen 56 % come out rocky and 0.4 % sandy, of the
// Landes' beaches and harbours 35 % and 38 %.  Held by ShoreGuess.TellsNorwaysCoast....
// The dimension is never computed: the two lengths the rulers find are compared, in plain
// arithmetic of latitude and longitude, so that the answer is the same on every machine and for
// every anchor.  Source: divider as in echo/measure/coast_dimension.hpp (Klinkenberg 1994), walked
// once: the ring's direction is the chart's.
CoastType guess_type(std::span<const GeoPoint> stretch);

}  // namespace skerry::echo
