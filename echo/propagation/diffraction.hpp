// Diffraction: what the Earth, or an edge, leaves of a wave that must bend round it.
#pragma once

namespace skerry::echo {

// Loss of a knife edge, dB one way, for the edge's height v in units of the Fresnel parameter.
// 0 below v = -0.78.  Source: ITU-R P.526, single knife edge; SOURCES.md "Vectors": J(0) = 6.03,
// J(1) = 13.93, J(2.4) = 20.54 dB.
double knife_edge_loss_db(double v);

// v of an edge `height_m` over the straight line between two points `to_edge_m` and `beyond_m` from
// it (both > 0): h sqrt(2 (d1 + d2) / (lambda d1 d2)).
double fresnel_parameter(double height_m, double to_edge_m, double beyond_m, double wavelength_m);

// Loss of the smooth Earth against free space, dB one way, beyond the horizon.  Source: ITU-R P.526
// section 3 with beta = 1 (over sea at 3 and 9 GHz).  Requires range and heights > 0.
// Error: the first term of a series, good beyond the horizon; within it, it means nothing (it
// may be negative) and is used only as P.526 section 3.2 does, see path_terms.hpp.
double smooth_earth_loss_db(double range_m, double antenna_height_m, double target_height_m,
                            double wavelength_m, double effective_earth_m);

}  // namespace skerry::echo
