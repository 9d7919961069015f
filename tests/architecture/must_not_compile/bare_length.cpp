// A number is no length until its unit is said.
#include "protocol/quantity/length.hpp"

using namespace skerry;

Length far_edge() {
#ifdef SKERRY_BREACH
  return 6.0;
#else
  return nautical_miles(6.0);
#endif
}
