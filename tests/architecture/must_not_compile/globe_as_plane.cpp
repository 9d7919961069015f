// A place on the Earth reaches a plane only through a LocalPlane.
#include "protocol/quantity/geo_point.hpp"

using namespace skerry;

PlanePoint offset(PlanePoint own_ship, GeoPoint there, PlanePoint there_in_plane) {
#ifdef SKERRY_BREACH
  return there - own_ship;
#else
  (void)there;
  return there_in_plane - own_ship;
#endif
}
