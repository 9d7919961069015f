// Only to_true() and to_relative() cross from one frame to the other.
#include "protocol/quantity/bearing.hpp"

using namespace skerry;

TrueBearing spoke_bearing(RelativeBearing antenna, TrueBearing heading) {
#ifdef SKERRY_BREACH
  return antenna;
#else
  return to_true(antenna, heading);
#endif
}
