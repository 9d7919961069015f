// Two directions have no sum; a direction and a turn have.
#include "protocol/quantity/bearing.hpp"

using namespace skerry;

TrueBearing sum(TrueBearing a, TrueBearing b) {
#ifdef SKERRY_BREACH
  return a + b;
#else
  return a + (b - TrueBearing());
#endif
}
