// A number is no angle until its unit is said.
#include "protocol/quantity/bearing.hpp"

using namespace skerry;

TrueBearing abeam(TrueBearing heading) {
#ifdef SKERRY_BREACH
  return heading + 90.0;
#else
  return heading + degrees(90.0);
#endif
}
