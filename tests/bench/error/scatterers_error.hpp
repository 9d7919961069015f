// Scatterers per ship: time against the error of the mean echo.
#pragma once

#include <cstdio>

namespace skerry::bench {

// Against 4096 scatterers per ship in double: ships of 9 to 300 m at four aspects, 0.8 and 2.7 NM,
// on 1.5 and 6 NM.  Time: laying one ship into all spokes that see her, per such spoke.
void print_scatterers_error(std::FILE* out);

}  // namespace skerry::bench
