// The scenario's clock is not the world's.
#include "protocol/quantity/time.hpp"

using namespace skerry;

Duration late(ScenarioTime due, ScenarioTime now, UtcTime utc) {
#ifdef SKERRY_BREACH
  return utc - due;
#else
  (void)utc;
  return now - due;
#endif
}
