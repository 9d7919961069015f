#include "echo/targets/reflectors.hpp"

#include <cmath>
#include <numbers>

namespace skerry::echo {
namespace {
using std::numbers::pi;

double squared(double x) { return x * x; }
}  // namespace

double trihedral_cross_section(double edge_m, double wavelength_m) {
  return 4.0 * pi / 3.0 * squared(squared(edge_m) / wavelength_m);
}
double square_trihedral_cross_section(double edge_m, double wavelength_m) {
  return 12.0 * pi * squared(squared(edge_m) / wavelength_m);
}
double dihedral_cross_section(double width_m, double height_m, double wavelength_m) {
  return 8.0 * pi * squared(width_m * height_m / wavelength_m);
}
double plate_cross_section(double area_m2, double wavelength_m) {
  return 4.0 * pi * squared(area_m2 / wavelength_m);
}
double luneburg_cross_section(double radius_m, double wavelength_m) {
  return 4.0 * pi * squared(pi) * squared(squared(radius_m) / wavelength_m);
}
double sphere_cross_section(double radius_m) { return pi * squared(radius_m); }

double trihedral_edge(double cross_section_m2, double wavelength_m) {
  return std::sqrt(std::sqrt(3.0 * cross_section_m2 / (4.0 * pi)) * wavelength_m);
}

double wire_cross_section(double radius_m, double range_m) { return pi * radius_m * range_m; }

}  // namespace skerry::echo
