// A level is no ratio: 10 dBm is not "ten times".
#include "protocol/quantity/decibel.hpp"

using namespace skerry;

Decibels gain_of(PowerDbm output, PowerDbm input) {
#ifdef SKERRY_BREACH
  return output;
#else
  return output - input;
#endif
}
