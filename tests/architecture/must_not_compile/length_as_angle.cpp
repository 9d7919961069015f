// Lengths and angles do not add up.
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"

using namespace skerry;

double offset(Length range, Angle turn) {
#ifdef SKERRY_BREACH
  return (range + turn).in_metres();
#else
  return range.in_metres() * turn.in_radians();
#endif
}
