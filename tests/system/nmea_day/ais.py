# AIS and RMC of a log, as gpsdecode reads them.
import json
import subprocess
from collections import deque
from datetime import datetime, timezone
from threading import Lock, Thread

from truth import KNOT_MPS

AIS_RANGE_NM = 60.0
STATIC_MS = 60_000  # names and sizes
ANCHORED_KN = 0.1
PENDING = 20_000    # messages that gpsdecode may be behind


def interval_ms(speed_kn, rot_deg_min):
    """ITU-R M.1371-5 table 1, class A: how often a ship tells her position."""
    turns = abs(rot_deg_min) > 20
    if speed_kn < ANCHORED_KN:
        return 180_000
    if speed_kn > 23 or (speed_kn > 14 and turns):
        return 2000
    return 6000 if speed_kn > 14 else 10_000 / 3 if turns else 10_000


class Said:
    """What a message of AIS should say."""

    def __init__(self, mmsi, second, lat, lon, heading, way, rot_deg_min,
                 range_m=0.0):
        self.range_nm = range_m / 1852
        self.mmsi, self.second, self.lat, self.lon = mmsi, second, lat, lon
        self.heading, self.course, self.speed_kn = heading, way.course, way.speed_kn
        self.rot_deg_min = rot_deg_min


class AisReader:
    """One gpsdecode for a voyage.  Its answers come in the order of what it is given."""

    def __init__(self, voyage, about):
        self.voyage, self.about = voyage, about
        self.ships = {about["mmsi"]: about}
        self.ships.update({target["mmsi"]: target for target in about["targets"]})
        self.pending, self.fixes, self.lock = deque(), {}, Lock()
        self.first_fix_ms = None
        self.part = {}
        self.next_ms, self.last = {}, {}
        self.program = subprocess.Popen(["/usr/bin/gpsdecode", "-u"], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True, encoding="ascii",
                                        errors="replace")
        self.thread = Thread(target=self.take, daemon=True)
        self.thread.start()

    def read_rmc(self, sentence, t):
        with self.lock:
            # It reports a moment when the next one comes: the first has no moment before it.
            if self.first_fix_ms is None:
                self.first_fix_ms = t.ms
            else:
                self.fixes[t.ms] = (t.lat, t.lon, t.way.course, t.way.speed_kn, sentence)
        self.program.stdin.write(sentence)

    def read(self, sentence, t):
        count, number = int(sentence[7]), int(sentence[9])
        if number == count:
            with self.lock:
                self.pending.append((sentence[3:6], t, sentence))
            if len(self.pending) > PENDING:
                self.voyage.fault("gpsdecode does not answer", sentence)
        self.program.stdin.write(sentence)

    def end(self):
        self.program.stdin.close()
        self.thread.join()
        self.program.wait()
        for kind, t, sentence in self.pending:
            self.voyage.fault(f"gpsdecode leaves a {kind} out", sentence)
        for fix in self.fixes.values():
            self.voyage.fault("gpsdecode leaves an RMC out", fix[-1])

    def take(self):
        for line in self.program.stdout:
            report = json.loads(line)
            if report["class"] == "TPV":
                self.take_fix(report)
            elif report["class"] == "AIS":
                with self.lock:
                    kind, t, sentence = self.pending.popleft()
                self.take_ais(kind, report, t, sentence.strip())

    def take_fix(self, report):
        moment = datetime.strptime(report["time"], "%Y-%m-%dT%H:%M:%S.%fZ")
        ms = round(moment.replace(tzinfo=timezone.utc).timestamp() * 1000)
        with self.lock:
            expected = self.fixes.pop(ms, None)
        if expected is None:
            if ms != self.first_fix_ms:
                self.voyage.fault("gpsdecode reads another time", json.dumps(report))
            return
        lat, lon, course, speed_kn, example = expected
        near = self.voyage.near
        # It writes 9 decimals of a degree, 4 of the course and 3 of m/s.
        near("RMC", "lat", "gpsdecode", abs(report["lat"] - lat) * 60, 0.5e-5, "min", 4e-8, example)
        off = abs(report["lon"] - lon)
        near("RMC", "lon", "gpsdecode", min(off, 360 - off) * 60, 0.5e-5, "min", 4e-8, example)
        if "speed" in report:
            near("RMC", "speed", "gpsdecode", abs(report["speed"] / KNOT_MPS - speed_kn), 0.005,
                 "kn", 0.001, example)
        else:
            self.voyage.fault("gpsdecode finds no speed", example)
        if "track" in report:
            off = abs(report["track"] - course)
            near("RMC", "track", "gpsdecode", min(off, 360 - off), 0.05, "deg", 1e-4, example)

    def truth_of(self, mmsi, t):
        second = t.ms // 1000 % 60
        if mmsi == self.about["mmsi"]:
            return Said(mmsi, second, t.lat, t.lon, t.heading, t.way, t.rot_deg_min)
        index = [target["mmsi"] for target in self.about["targets"]].index(mmsi)
        target = t.targets[index]
        return Said(mmsi, second, target.lat, target.lon, target.heading, target.way,
                    target.rot_deg_min, target.range_m)

    def take_ais(self, kind, report, t, example):
        mmsi = report["mmsi"]
        if mmsi not in self.ships or (kind == "VDO") != (mmsi == self.about["mmsi"]):
            self.voyage.fault(f"{kind} of a ship that is not there", example)
            return
        self.rate(kind, report["type"], mmsi, t, example)
        if report["type"] == 5:
            self.take_static(kind, report, example)
            return
        said = self.truth_of(mmsi, t)
        near = self.voyage.near

        def round_about(field, off, whole, bound, unit, scale):
            off = abs(off) % whole
            near(kind, field, "gpsdecode", min(off, whole - off) / scale, bound / scale, unit, 1e-6,
                 example)

        round_about("lat", report["lat"] - said.lat * 600_000, 1e12, 0.5, "min", 1e4)
        round_about("lon", report["lon"] - said.lon * 600_000, 216e6, 0.5, "min", 1e4)
        round_about("course", report["course"] - said.course * 10, 3600, 0.5, "deg", 10)
        round_about("speed", report["speed"] - said.speed_kn * 10, 1e12, 0.5, "kn", 10)
        round_about("heading", report["heading"] - said.heading, 360, 0.5, "deg", 1)
        if not (0 <= report["course"] < 3600 and 0 <= report["heading"] < 360):
            self.voyage.fault(f"{kind} course or heading is no angle", example)
        turn = 4.733 * abs(said.rot_deg_min) ** 0.5 * (-1 if said.rot_deg_min < 0 else 1)
        round_about("turn", report["turn"] - max(-126, min(126, turn)), 1e12, 0.5, "units", 1)
        self.voyage.same(kind, "second", "gpsdecode", report["second"], said.second, example)
        status = 1 if said.speed_kn < ANCHORED_KN else 0
        self.voyage.same(kind, "status", "gpsdecode", report["status"], status, example)

    def take_static(self, kind, report, example):
        ship = self.ships[report["mmsi"]]
        same = self.voyage.same
        same(kind, "shipname", "gpsdecode", report["shipname"], ship["name"].upper(), example)
        for field, ends in (("length_m", ("to_bow", "to_stern")),
                            ("beam_m", ("to_port", "to_starboard"))):
            metres = sum(report[end] for end in ends)
            same(kind, field, "gpsdecode", metres, -int(-ship[field] // 1), example)

    def rate(self, kind, message, mmsi, t, example):
        """A ship tells her position as often as M.1371 says; what was late is not made up for."""
        static = message == 5
        key = (static, mmsi)
        due = self.next_ms.get(key)
        if kind == "VDM" and self.truth_of(mmsi, t).range_nm > AIS_RANGE_NM - 0.1:
            due = None  # she comes back into reach
        late, early = 100, 0.01  # the talker looks every tick, and counts whole nanoseconds
        if due is not None and not due - early <= t.ms < due + late:
            # One that gathers way, or turns, need not wait for her old interval to end.
            sooner = kind == "VDM" and not static and t.ms < due - early
            if not sooner:
                self.voyage.fault(f"{kind} of type {message} is out of its rate",
                                  f"{t.ms - due} ms late: {example}")
        if static:
            self.next_ms[key] = (t.ms if due is None else due) + STATIC_MS
            return
        said = self.truth_of(mmsi, t)
        begin = t.ms if due is None or t.ms < due - early else due
        self.next_ms[key] = begin + interval_ms(said.speed_kn, said.rot_deg_min)
