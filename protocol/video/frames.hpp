// The one glossary of coordinate systems and words.  No code; include nothing from here.
//
// GeoPoint         WGS-84 latitude and longitude, degrees.
// PlanePoint       metres east and north of an anchor; azimuthal equidistant (echo/chart).
// TrueBearing      clockwise from true north.
// RelativeBearing  clockwise from the bow of the own ship.
// spoke            one azimuth of finished video: a header and its cells, nearest cell first.
// spoke index      azimuth within the scan, 0 over the bow, clockwise.
// sector           consecutive spokes made and sent together.
// scan             one turn of the antenna relative to the bow.  (Weather radar says sweep.)
// sweep            one pulse's echo before the receiver; lives only in echo.
// ray              an azimuth at which returns are computed; spokes are made of one or more rays.
// cell             one range interval of a spoke, [n, n+1) * cell size.
// radar            antenna and transmitter: what is on the air.
// view             a console's receiver settings on a radar: range scale, gain, sea, rain.
#pragma once
