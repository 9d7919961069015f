// A relative bearing says nothing of a true one without the heading.
#include "protocol/quantity/bearing.hpp"

using namespace skerry;

Angle off_course(TrueBearing course, RelativeBearing target, TrueBearing heading) {
#ifdef SKERRY_BREACH
  return course - target;
#else
  return course - to_true(target, heading);
#endif
}
