// How large a ship's echo is, and how it is spread over her hull.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/scene/targets.hpp"

namespace skerry::echo {

// Median radar cross-section of a ship, m2: 52 sqrt(f MHz) D^1.5 with D in kilotonnes
// (Skolnik 1974; SOURCES.md "Targets"), D from length, beam and a draught of 0.4 beam at block
// coefficient 0.7.  Error: Skolnik's ships were of 2 to 17 kt; below that it is an extrapolation.
double ship_cross_section(double length_m, double beam_m, double frequency_hz);

// Mean cross-section of a ship, m2, in one passing of the beam.  The median is Skolnik's (or the
// hull's own, given for X band and carried to other bands by the square root of frequency); an
// echo of many scatterers is exponential, whose mean is its median over ln 2.  `side`: sine of the
// aspect, 0 bow on, 1 abeam.  Abeam it stands 10 to 20 dB higher, by ship, in a lobe 24 deg wide at
// half its peak.  Source: SOURCES.md "Targets".  Held by ShipEcho.MedianIsSkolniks,
// ...ABroadside...
double ship_mean_cross_section(const Hull& hull, double frequency_hz, double side);

// How finely a ship is made: `along` her length (a power of two) times `rows` across.
struct ShipDetail {
  std::uint32_t along = 4, rows = 1;
  std::uint32_t count() const { return along * rows; }
};
inline constexpr std::uint32_t kMaxAlong = 64, kMaxRows = 3;

// The radar's resolution, metres: in range (pulse or cell, the longer) and across the beam.
struct ShipResolution {
  double range_m = 1.0, across_m = 1.0;
};
// `per_resolution`: scatterers to each resolvable length.  Error with 2, against 4096 per ship, of
// the mean echo in cells within 10 dB of its peak: p50 0.2 dB, p95 2 dB.  The rest are cells at
// her ends, which stand up to a quarter of a resolvable length, and at her sides, which stand a
// sixth of her beam, too far in; more scatterers along change nothing about the latter.
// scatterers_error prints the curve.  Held by ShipEcho.FewScatterersGiveTheMeanEchoOfMany.
inline constexpr double kScatterersPerResolution = 2.0;
ShipDetail ship_detail(const Hull& hull, double side, double ahead, ShipResolution resolution,
                       double per_resolution = kScatterersPerResolution);

struct ShipScatterer {
  float forward = 0.0f;    // of the length, -1/2 stern to 1/2 bow
  float starboard = 0.0f;  // of the beam, -1/2 to 1/2
  float share = 0.0f;      // of the mean cross-section
  float phase = 0.0f;      // turns, in steps of 1/1024
};

// Mean shares, which add up to 1.  The density along the hull is that of 64 stations by the ship's
// identity, three times as high at the house (four to seven tenths of the way from middle to
// stern), and wanders slowly with the aspect (zones of four stations, knots 11 deg apart): finer
// detail samples the same density.  `aspect_units`: bearing of the radar from the bow.
// Any detail; more than 64 along repeats stations.
void ship_shares(std::uint64_t identity, ShipDetail detail, std::uint32_t aspect_units,
                 std::vector<ShipScatterer>& out);

// The same as one passing of the beam finds them: each a complex Gaussian of its mean share, so
// that any sum of them is exponential (Swerling 1).  `pass_key` names radar and passing.
void fluctuate(std::uint64_t identity, std::uint64_t pass_key, std::vector<ShipScatterer>& figure);

}  // namespace skerry::echo
