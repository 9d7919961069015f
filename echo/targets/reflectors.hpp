// Cross-sections of bodies of simple shape, m2, along their axis of greatest return.
#pragma once

namespace skerry::echo {

// Optical region: every edge, side and radius is long against the wavelength.  All in metres.
// Source: SOURCES.md "Targets".  Held by Reflectors.*.
double trihedral_cross_section(double edge_m, double wavelength_m);  // triangular, 4 pi a^4 / 3 l^2
double square_trihedral_cross_section(double edge_m, double wavelength_m);  // 12 pi a^4 / l^2
double dihedral_cross_section(double width_m, double height_m, double wavelength_m);
double plate_cross_section(double area_m2, double wavelength_m);      // 4 pi A^2 / l^2
double luneburg_cross_section(double radius_m, double wavelength_m);  // 4 pi^3 r^4 / l^2
double sphere_cross_section(double radius_m);                         // pi r^2

// Edge of the triangular trihedral that returns as much as `cross_section_m2`.
double trihedral_edge(double cross_section_m2, double wavelength_m);

// A wire square to the line of sight, longer than the zone that echoes in phase (sqrt(l R / 2)):
// pi a R, so that it falls as R^-3.  Physical optics of a smooth round wire; computed from the
// width pi a of a cylinder under a spherical wave.
double wire_cross_section(double radius_m, double range_m);

}  // namespace skerry::echo
