// Two levels have no sum in decibels; a level and a gain have.
#include "protocol/quantity/decibel.hpp"

using namespace skerry;

PowerDbm amplified(PowerDbm input, PowerDbm other) {
#ifdef SKERRY_BREACH
  return input + other;
#else
  return input + (other - input);
#endif
}
