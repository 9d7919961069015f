"""Renders one turn of a radar and draws it as a grey picture (PGM), by ctypes alone.

    ppi.py libskerry_echo.so.1 out.pgm [latitude longitude range_nm [chart files ...]]

Without a place the sound off Bergen.  Charts: GSHHG, ENC cells, GeoJSON or Shapefiles.
"""

import ctypes as c
import math
import sys

SPOKES, CELLS, SECTOR, SIDE = 1024, 512, 64, 500


class RadarOptions(c.Structure):  # skerry_echo_radar_options
    _fields_ = (
        [(name, c.c_uint32) for name in ("struct_size", "number", "spokes_per_turn", "cells", "bits", "reserved")]
        + [(name, c.c_double) for name in ("rpm", "frequency_hz", "peak_power_w", "antenna_gain_db",
                                           "beam_width_deg", "antenna_height_m", "noise_figure_db",
                                           "losses_db")]
    )


class OwnShip(c.Structure):  # skerry_echo_own_ship
    _fields_ = [("struct_size", c.c_uint32), ("reserved", c.c_uint32)] + [
        (name, c.c_double) for name in ("latitude_deg", "longitude_deg", "course_deg", "speed_mps",
                                        "heading_deg", "turn_rate_deg_s")
    ]


class Target(c.Structure):  # skerry_echo_target
    _fields_ = [("struct_size", c.c_uint32), ("reserved", c.c_uint32), ("identity", c.c_uint64)] + [
        (name, c.c_double) for name in ("latitude_deg", "longitude_deg", "course_deg", "speed_mps",
                                        "heading_deg", "turn_rate_deg_s", "length_m", "beam_m", "height_m")
    ]


class Library:
    """The calls used here, with their types; a refused one raises RuntimeError with the reason."""

    SIGNATURES = {
        "chart_open": [c.POINTER(c.c_char_p), c.c_size_t, c.POINTER(c.c_char_p), c.c_size_t,
                       c.POINTER(c.c_void_p)],
        "chart_destroy": [c.c_void_p],
        "coast_create": [c.c_void_p, c.c_uint64, c.POINTER(c.c_void_p)],
        "coast_destroy": [c.c_void_p],
        "radar_defaults": [c.POINTER(RadarOptions), c.c_size_t],
        "radar_create": [c.c_void_p, c.POINTER(RadarOptions), c.POINTER(c.c_void_p)],
        "radar_set_controls": [c.c_void_p, c.c_double, c.c_double, c.c_double, c.c_double],
        "own_ship_defaults": [c.POINTER(OwnShip), c.c_size_t],
        "target_defaults": [c.POINTER(Target), c.c_size_t],
        "radar_set_scene": [c.c_void_p, c.c_int64, c.POINTER(OwnShip), c.POINTER(Target), c.c_size_t],
        "radar_spoke_time": [c.c_void_p, c.c_uint64, c.POINTER(c.c_int64)],
        "radar_render": [c.c_void_p, c.c_uint64, c.c_uint32, c.c_void_p, c.c_size_t, c.c_size_t],
        "radar_destroy": [c.c_void_p],
    }

    def __init__(self, path):
        dll = c.CDLL(path)
        dll.skerry_echo_version_text.restype = c.c_char_p
        dll.skerry_echo_last_error.restype = c.c_char_p
        dll.skerry_echo_version.restype = c.c_uint32
        if dll.skerry_echo_version() >> 16 != 1:
            raise RuntimeError(f"{path} is version {dll.skerry_echo_version_text().decode()}; expected 1")
        for name, arguments in self.SIGNATURES.items():
            call = getattr(dll, "skerry_echo_" + name)
            call.argtypes, call.restype = arguments, c.c_int32
            setattr(self, name, self._checked(call, name, dll))

    @staticmethod
    def _checked(call, name, dll):
        def run(*arguments):
            if call(*arguments) != 0:
                raise RuntimeError(f"{name}: {dll.skerry_echo_last_error().decode()}")

        return run


def draw(video, heading_deg):
    """North up: spoke 0 points over the bow."""
    picture = bytearray(SIDE * SIDE)
    for y in range(SIDE):
        for x in range(SIDE):
            east, north = x + 0.5 - SIDE / 2, SIDE / 2 - (y + 0.5)
            cell = int(math.hypot(east, north) * CELLS / (SIDE / 2))
            if cell < CELLS:
                turns = (math.atan2(east, north) / (2 * math.pi) - heading_deg / 360) % 1.0
                picture[y * SIDE + x] = video[int(turns * SPOKES + 0.5) % SPOKES * CELLS + cell]
    return bytes(picture)


def main(arguments):
    if len(arguments) not in (2,) and len(arguments) < 5:
        sys.exit(__doc__)
    library, out = Library(arguments[0]), arguments[1]
    latitude, longitude, range_nm = map(float, arguments[2:5] or (60.27, 5.15, 6.0))
    # Each over those after it; "" is the finest GSHHG shoreline installed.
    charts = [path.encode() for path in arguments[5:]] or [b""]

    chart, coast, radar = c.c_void_p(), c.c_void_p(), c.c_void_p()
    library.chart_open((c.c_char_p * len(charts))(*charts), len(charts), None, 0, c.byref(chart))
    library.coast_create(chart, 1, c.byref(coast))
    options = RadarOptions()
    library.radar_defaults(c.byref(options), c.sizeof(options))
    options.spokes_per_turn, options.cells = SPOKES, CELLS
    library.radar_create(coast, c.byref(options), c.byref(radar))
    library.radar_set_controls(radar, range_nm, 50.0, 20.0, 0.0)

    own, ship = OwnShip(), Target()
    library.own_ship_defaults(c.byref(own), c.sizeof(own))
    library.target_defaults(c.byref(ship), c.sizeof(ship))
    own.latitude_deg, own.longitude_deg = latitude, longitude
    own.heading_deg = own.course_deg = 20.0
    ship.identity = 1
    ship.latitude_deg, ship.longitude_deg = latitude + range_nm / 180, longitude
    ship.heading_deg = ship.course_deg = 270.0

    video = (c.c_uint8 * (SPOKES * CELLS))()
    time_ns = c.c_int64()
    for first in range(0, SPOKES, SECTOR):
        library.radar_spoke_time(radar, first, c.byref(time_ns))
        # At anchor: the same place at every time.  Under way it would be the simulator's track.
        library.radar_set_scene(radar, time_ns.value, c.byref(own), c.byref(ship), 1)
        library.radar_render(radar, first, SECTOR, c.byref(video, first * CELLS), SECTOR * CELLS, CELLS)

    with open(out, "wb") as file:
        file.write(b"P5\n%d %d\n255\n" % (SIDE, SIDE) + draw(video, own.heading_deg))
    library.radar_destroy(radar)
    library.coast_destroy(coast)
    library.chart_destroy(chart)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except (RuntimeError, OSError) as error:
        sys.exit(f"ppi.py: {error}")
