# Range and bearing on the WGS 84 ellipsoid.
# Source: T. Vincenty, Direct and inverse solutions of geodesics, Survey Review XXII 176, 1975.
from math import atan, atan2, cos, degrees, hypot, radians, sin, tan

EQUATOR_M = 6378137.0
FLATTENING = 1 / 298.257223563
POLE_M = EQUATOR_M * (1 - FLATTENING)


def range_and_bearing(lat1, lon1, lat2, lon2):
    """Metres, and degrees 0 to 360 at the first point, all angles in degrees.  Error: below 1 mm;
    points opposite to each other on the Earth are not for it."""
    u1, u2 = (atan((1 - FLATTENING) * tan(radians(lat))) for lat in (lat1, lat2))
    over = radians((lon2 - lon1 + 180) % 360 - 180)
    turned = over
    for _ in range(100):
        east, north = cos(u2) * sin(turned), cos(u1) * sin(u2) - sin(u1) * cos(u2) * cos(turned)
        sin_s, cos_s = hypot(east, north), sin(u1) * sin(u2) + cos(u1) * cos(u2) * cos(turned)
        if sin_s == 0:
            return 0.0, 0.0
        s = atan2(sin_s, cos_s)
        sin_a = cos(u1) * cos(u2) * sin(turned) / sin_s
        cos2_a = 1 - sin_a * sin_a
        cos_2m = cos_s - 2 * sin(u1) * sin(u2) / cos2_a if cos2_a > 0 else 0.0
        c = FLATTENING / 16 * cos2_a * (4 + FLATTENING * (4 - 3 * cos2_a))
        before, turned = turned, over + (1 - c) * FLATTENING * sin_a * (
            s + c * sin_s * (cos_2m + c * cos_s * (2 * cos_2m * cos_2m - 1)))
        if abs(turned - before) < 1e-13:
            break
    k2 = cos2_a * (EQUATOR_M ** 2 - POLE_M ** 2) / POLE_M ** 2
    a = 1 + k2 / 16384 * (4096 + k2 * (-768 + k2 * (320 - 175 * k2)))
    b = k2 / 1024 * (256 + k2 * (-128 + k2 * (74 - 47 * k2)))
    change = b * sin_s * (cos_2m + b / 4 * (cos_s * (2 * cos_2m ** 2 - 1) - b / 6 * cos_2m * (
        4 * sin_s ** 2 - 3) * (4 * cos_2m ** 2 - 3)))
    return POLE_M * a * (s - change), degrees(atan2(east, north)) % 360
