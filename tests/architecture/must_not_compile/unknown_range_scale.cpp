// A range scale outside the table cannot be made.
#include "protocol/video/range_scale.hpp"

using namespace skerry;

RangeScale chosen() {
#ifdef SKERRY_BREACH
  return RangeScale(std::uint8_t{200});
#else
  return RangeScale::from_index(2).value_or(RangeScale());
#endif
}
