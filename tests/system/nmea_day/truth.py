# What the instruments of a ship should say, from the truth of the world in SI units and degrees.
from functools import cached_property
from math import atan2, cos, degrees, hypot, radians, sin

from geodesic import range_and_bearing

KNOT_MPS = 1852 / 3600
NM_M = 1852
DEEPEST_TRANSDUCER_M = 5


def towards(course_deg, length):
    return length * cos(radians(course_deg)), length * sin(radians(course_deg))


class Way:
    """Course and speed over ground, never negative."""

    def __init__(self, course_deg, speed_mps):
        self.course = (course_deg + (180 if speed_mps < 0 else 0)) % 360
        self.speed_kn = abs(speed_mps) / KNOT_MPS
        self.north_mps, self.east_mps = towards(course_deg, speed_mps)


class Target:
    def __init__(self, lat, lon, heading, cog, speed_mps, rot_deg_s):
        self.lat, self.lon, self.heading = lat, lon, heading
        self.way = Way(cog, speed_mps)
        self.rot_deg_min = rot_deg_s * 60

    def seen_from(self, own):
        self.range_m, self.bearing = range_and_bearing(own.lat, own.lon, self.lat, self.lon)
        north, east = towards(self.bearing, self.range_m)
        to_north = self.way.north_mps - own.way.north_mps
        to_east = self.way.east_mps - own.way.east_mps
        self.closing_mps = hypot(to_north, to_east)
        if self.closing_mps < 1e-3:
            self.tcpa_s, self.cpa_m = 0.0, self.range_m
        else:
            self.tcpa_s = -(north * to_north + east * to_east) / self.closing_mps ** 2
            self.cpa_m = hypot(north + to_north * self.tcpa_s, east + to_east * self.tcpa_s)
        return self


class Truth:
    """Of one tick."""

    def __init__(self, row, about):
        values = row.split(",")
        self.ms = int(values[0])
        self.about = about
        self.values = [float(value) for value in values[1:]]
        (self.lat, self.lon, self.heading, self.cog, self.speed_mps, self.rot_deg_s, self.u_mps,
         self.v_mps, self.rudder, self.shaft_rps, self.below_keel_m, self.wind_from, self.wind_mps,
         self.set, self.current_mps, self.waypoint, self.cross_track_m) = self.values[:17]

    @cached_property
    def way(self):
        return Way(self.cog, self.speed_mps)

    @cached_property
    def targets(self):
        rest = self.values[17:]
        return [Target(*rest[i:i + 6]).seen_from(self) for i in range(0, len(rest), 6)]

    rot_deg_min = property(lambda t: t.rot_deg_s * 60)
    drift = property(lambda t: radians(t.cog - t.heading))
    ground_ahead_kn = property(lambda t: t.speed_mps * cos(t.drift) / KNOT_MPS)
    ground_starboard_kn = property(lambda t: t.speed_mps * sin(t.drift) / KNOT_MPS)
    transducer_m = property(lambda t: min(DEEPEST_TRANSDUCER_M, t.about["draught_m"]))
    depth_m = property(lambda t: max(t.below_keel_m, 0) + t.about["draught_m"] - t.transducer_m)

    @cached_property
    def felt(self):
        """Whence the wind comes as it is felt on board, off the bow, and its speed, m/s."""
        north, east = towards(self.wind_from, self.wind_mps)
        north, east = north + self.way.north_mps, east + self.way.east_mps
        return (degrees(atan2(east, north)) - self.heading) % 360, hypot(north, east)

    @property
    def off_track_nm(self):
        return max(-99.9, min(99.9, self.cross_track_m / NM_M)) if self.waypoint else None
