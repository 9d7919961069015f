#include "server/world/target_kinds.hpp"

namespace skerry::server {

using scenario::Target;

KindSize size_of(Target::Kind kind) {
  switch (kind) {
    case Target::reflector_buoy:
      return {3.5, 10.0, 1.0, Target::rayleigh};
    case Target::small_craft:
      return {2.0, 2.5, 1.4, Target::rayleigh};
    case Target::reflector_craft:
      return {4.0, 7.5, 0.5, Target::rayleigh};
    case Target::channel_marker:
      return {1.0, 1.0, 0.1, Target::rayleigh};
    case Target::reflector:
      return {4.0, 7.5, 0.5, Target::steady};
    default:
      return {3.5, 5.0, 0.5, Target::rayleigh};
  }
}

void fill_in_size(Target& target, bool height_given) {
  const KindSize size = size_of(target.kind());
  if (!height_given) target.set_height_m(size.height_m);
  if (!target.has_x_band_m2()) target.set_x_band_m2(size.x_band_m2);
  if (!target.has_s_band_m2()) target.set_s_band_m2(size.s_band_m2);
  if (!target.has_fluctuation()) target.set_fluctuation(size.fluctuation);
}

std::string name_of(Target::Kind kind) { return Target::Kind_Name(kind); }

}  // namespace skerry::server
