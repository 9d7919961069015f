# The fields of every sentence: where they are, with how many decimals, and what they should say.
# Sources of the orders of fields: protocol/nmea/README.md.  A field named by a word is found by
# pynmea2, one named by a number (from 0) by this reader, because pynmea2 does not know it.
from datetime import datetime, timezone

from truth import KNOT_MPS

NUMBER, ANGLE, TEXT, LATITUDE, LONGITUDE = range(5)
ANY = object()  # nothing is expected: it has no meaning there
KMH = 1.852


class Field:
    def __init__(self, where, kind, expected, decimals=0):
        self.where, self.kind, self.expected, self.decimals = where, kind, expected, decimals
        self.unit = 10.0 ** -decimals


def number(where, decimals, expected):
    return Field(where, NUMBER, expected, decimals)


def angle(where, decimals, expected):
    return Field(where, ANGLE, expected, decimals)


def text(where, expected):
    return Field(where, TEXT, expected if callable(expected) else lambda t: expected)


def utc(t):
    return datetime.fromtimestamp(t.ms // 1000, timezone.utc)


def time_of_day(t):
    return utc(t).strftime("%H%M%S") + f".{t.ms // 10 % 100:02}"


def position(at):
    """Latitude, N or S, longitude, E or W, beginning at field `at`."""
    return [Field(at, LATITUDE, lambda t: t.lat, 5), Field(at + 2, LONGITUDE, lambda t: t.lon, 5)]


def places():
    # pynmea2 makes degrees of them.
    return [Field("latitude", LATITUDE, lambda t: t.lat, 5),
            Field("longitude", LONGITUDE, lambda t: t.lon, 5)]


def status(t):
    return "A" if t.waypoint else "V"


def off_track(t):
    return None if t.off_track_nm is None else abs(t.off_track_nm)


def steer_to(t):
    if t.off_track_nm is None:
        return ""
    return "L" if t.off_track_nm > 0 else "R" if t.off_track_nm < 0 else ANY


FIELDS = {
    "RMC": [text("timestamp", time_of_day), text("status", "A"), *places(),
            number("spd_over_grnd", 2, lambda t: t.way.speed_kn),
            angle("true_course", 1, lambda t: t.way.course),
            text("datestamp", lambda t: utc(t).strftime("%d%m%y")), text("mag_variation", ""),
            text("mag_var_dir", ""), text(11, "A"), text(12, "V")],
    "GGA": [text("timestamp", time_of_day), *places(), text("gps_qual", "1"),
            text("num_sats", "12"), text("horizontal_dil", "0.8"), text("altitude", "0.0"),
            text("altitude_units", "M"), text("geo_sep", "0.0"), text("geo_sep_units", "M"),
            text("age_gps_data", ""), text("ref_station_id", "")],
    "VTG": [angle("true_track", 1, lambda t: t.way.course), text("true_track_sym", "T"),
            text("mag_track", ""), text("mag_track_sym", "M"),
            number("spd_over_grnd_kts", 2, lambda t: t.way.speed_kn),
            text("spd_over_grnd_kts_sym", "N"),
            number("spd_over_grnd_kmph", 2, lambda t: t.way.speed_kn * KMH),
            text("spd_over_grnd_kmph_sym", "K"), text("faa_mode", "A")],
    "ZDA": [text("timestamp", time_of_day), text("day", lambda t: utc(t).strftime("%d")),
            text("month", lambda t: utc(t).strftime("%m")),
            text("year", lambda t: utc(t).strftime("%Y")), text("local_zone", "00"),
            text("local_zone_minutes", "00")],
    "HDT": [angle("heading", 2, lambda t: t.heading), text("hdg_true", "T")],
    "THS": [angle(0, 2, lambda t: t.heading), text(1, "A")],
    "ROT": [number("rate_of_turn", 1, lambda t: t.rot_deg_min), text("status", "A")],
    "VHW": [angle("heading_true", 2, lambda t: t.heading), text("true", "T"),
            text("heading_magnetic", ""), text("magnetic", "M"),
            number("water_speed_knots", 2, lambda t: t.u_mps / KNOT_MPS), text("knots", "N"),
            number("water_speed_km", 2, lambda t: t.u_mps / KNOT_MPS * KMH),
            text("kilometers", "K")],
    "VBW": [number("lon_water_spd", 2, lambda t: t.u_mps / KNOT_MPS),
            number("trans_water_spd", 2, lambda t: t.v_mps / KNOT_MPS),
            text("data_validity_water_spd", "A"),
            number("lon_grnd_spd", 2, lambda t: t.ground_ahead_kn),
            number("trans_grnd_spd", 2, lambda t: t.ground_starboard_kn),
            text("data_validity_grnd_spd", "A"), text(6, ""), text(7, "V"), text(8, ""),
            text(9, "V")],
    "RSD": [*(text(i, "") for i in range(10)), number(10, 3, lambda t: t.about["range_nm"]),
            text(11, "N"), text(12, "H")],
    "OSD": [angle("heading", 1, lambda t: t.heading), text("status", "A"),
            angle("course", 1, lambda t: t.way.course), text("course_true", "P"),
            number("speed", 2, lambda t: t.way.speed_kn), text("speed_ref", "P"), text("set", ""),
            text("drift", ""), text("speed_unit", "N")],
    "RSA": [number("rsa_starboard", 1, lambda t: t.rudder), text("rsa_starboard_status", "A"),
            text("rsa_port", ""), text("rsa_port_status", "V")],
    "RPM": [text("source", "S"), text("engine_no", "0"),
            number("speed", 1, lambda t: t.shaft_rps * 60), text("pitch", "100.0"),
            text("status", "A")],
    "DPT": [number("depth", 1, lambda t: t.depth_m),
            number("offset", 1, lambda t: t.transducer_m - t.about["draught_m"]),
            text("range", "")],
    "MWV": [angle("wind_angle", 1, lambda t: t.felt[0] if t.felt[1] > 1e-6 else ANY),
            text("reference", "R"), number("wind_speed", 1, lambda t: t.felt[1] / KNOT_MPS),
            text("wind_speed_units", "N"), text("status", "A")],
    "MWD": [angle("direction_true", 1, lambda t: t.wind_from), text("true", "T"),
            text("direction_magnetic", ""), text("magnetic", "M"),
            number("wind_speed_knots", 1, lambda t: t.wind_mps / KNOT_MPS), text("knots", "N"),
            number("wind_speed_meters", 1, lambda t: t.wind_mps), text("meters", "M")],
    "VDR": [angle("deg_t", 1, lambda t: t.set), text("true", "T"), text("deg_m", ""),
            text("magnetic", "M"), number("current", 2, lambda t: t.current_mps / KNOT_MPS),
            text("unit_kn", "N")],
    "XTE": [text("warning_flag", status), text("lock_flag", status),
            number("cross_track_err_dist", 3, off_track), text("correction_dir", steer_to),
            text("dist_units", "N"), text(5, lambda t: "A" if t.waypoint else "N")],
    # Of a target; `t` is her, and t.own the ship.
    "TTM": [number("distance", 3, lambda t: t.range_m / 1852),
            angle("bearing", 1, lambda t: t.bearing), text("brg_ref", "T"),
            number("speed", 1, lambda t: t.way.speed_kn),
            angle("cog", 1, lambda t: t.way.course), text("cog_unit", "T"),
            number("dist_cpa", 2, lambda t: t.cpa_m / 1852),
            number("time_cpa", 1, lambda t: max(-999.9, min(999.9, t.tcpa_s / 60))),
            text("dist_unit", "N"), text("status", "T"), text("reference", ""),
            text("timestamp", lambda t: time_of_day(t.own)), text("acquisition", "A")],
    "TLL": [*position(1), text("timestamp", lambda t: time_of_day(t.own)),
            text("target_status", "T"), text("reference", "")],
}
# How often each comes, ms: what server/displays/README.md says of an output without `sentences`.
PERIODS = {
    "RMC": 1000, "GGA": 1000, "VTG": 1000, "ZDA": 1000, "HDT": 100, "THS": 100, "ROT": 500,
    "VHW": 1000, "VBW": 1000, "RSD": 1000, "OSD": 1000, "RSA": 500, "RPM": 1000, "DPT": 1000,
    "MWV": 1000, "MWD": 1000, "VDR": 1000, "XTE": 1000, "TTM": 2000, "TLL": 2000,
}
# The order within one moment.
TURNS = ["RMC", "GGA", "VTG", "ZDA", "HDT", "THS", "ROT", "VHW", "VBW", "RSD", "OSD", "VDM", "VDO",
         "TTM", "TLL", "RSA", "RPM", "DPT", "MWV", "MWD", "VDR", "XTE"]
