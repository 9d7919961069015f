# Reads the logs that nmea_day wrote, with pynmea2 and gpsdecode where they know a sentence, and
# compares every field with the truth beside it.  Usage: compare.py FOLDER VOYAGE...
#
# A field may be off by half a unit of its last digit and by the rounding of numbers on the way
# (DUST, and dust_of() for those that are computed from others); letters, times and dates are exact.
# Every sentence comes at its own rate and in its turn, and the voyages together meet what is easily
# got wrong: see CASES.
import gzip
import json
import re
import sys
from collections import Counter, defaultdict
from multiprocessing import Pool
from time import process_time

try:
    import pynmea2
except ImportError:
    sys.exit("compare.py needs pynmea2 and gpsdecode: apt-get install python3-nmea2 gpsd-clients")

from ais import AisReader
from fields import ANGLE, ANY, FIELDS, LATITUDE, LONGITUDE, PERIODS, TEXT, TURNS
from truth import Truth

DUST = 1e-7  # of a unit of the last digit
MOST_CHARACTERS = 82
TRACKED_NM, TRACKED_UNTIL_NM = 24.0, 24.0 * 1.1
CASES = ["north from the west", "north from the east", "equator", "180th meridian", "Greenwich",
         "south and west", "astern", "speed 0.00", "heading 0.00", "midnight", "new year",
         "29 February", "off track to port", "off track to starboard", "on no track",
         "port rudder", "shaft astern"]
NUMBER_TEXT = {n: re.compile(r"-?\d+\.\d{%d}$" % n) for n in (1, 2, 3)}


class Column:
    """What was seen of a field."""

    def __init__(self, reader, bound, unit):
        self.reader, self.bound, self.unit = reader, bound, unit
        self.count, self.worst = 0, 0.0

    def add(self, other):
        self.count += other.count
        self.worst = max(self.worst, other.worst)


class Voyage:
    def __init__(self, folder, name):
        self.folder, self.name = folder, name
        self.columns, self.cases, self.faults = {}, Counter(), Counter()
        self.examples = defaultdict(list)
        self.sentences = Counter()
        self.last_ms, self.was = {}, {}
        self.targets = {}

    def fault(self, what, example):
        self.faults[what] += 1
        if len(self.examples[what]) < 3:
            self.examples[what].append(example)

    def column(self, sentence, field, reader, bound, unit):
        key = (sentence, field)
        if key not in self.columns:
            self.columns[key] = Column(reader, bound, unit)
        return self.columns[key]

    def near(self, sentence, field, reader, off, bound, unit, dust, example):
        column = self.column(sentence, field, reader, bound, unit)
        column.count += 1
        column.worst = max(column.worst, off)
        if not off <= bound + dust:
            self.fault(f"{sentence} {field} is off", f"{off:.9g}: {example}")

    def same(self, sentence, field, reader, said, expected, example):
        self.column(sentence, field, reader, None, None).count += 1
        if said != expected:
            self.fault(f"{sentence} {field} is wrong", f"{said!r} for {expected!r}: {example}")

    # One field of a sentence.
    def judge(self, sentence, field, message, data, t, line):
        known = isinstance(field.where, str)
        reader = "pynmea2" if known else "own"
        if field.kind in (LATITUDE, LONGITUDE):
            said = getattr(message, field.where) if known else degrees_of(data, field.where)
            label = field.where if known else ["latitude", "longitude"][field.kind - LATITUDE]
            off = abs(said - field.expected(t))
            if field.kind == LONGITUDE:
                off = min(off, 360 - off)
            # A unit is 1e-5 of a minute; floats of 180 deg end at 1e-13.
            self.near(sentence, label, reader, off * 60, 0.5e-5, "min", 1e-8, line)
            return
        said = data[message.name_to_idx[field.where] if known else field.where]
        expected = field.expected(t)
        if field.kind == TEXT:
            if expected is not ANY:
                self.same(sentence, field.where, reader, said, expected, line)
            return
        if expected is None:
            self.same(sentence, field.where, reader, said, "", line)
            return
        if not NUMBER_TEXT[field.decimals].match(said) or (said[0] == "-" and float(said) == 0):
            self.fault(f"{sentence} {field.where} is not written so", f"{said}: {line}")
            return
        if expected is ANY:
            return
        value = float(said)
        off = abs(value - expected)
        if field.kind == ANGLE:
            off = min(off, 360 - off)
            if not 0 <= value < 360:
                self.fault(f"{sentence} {field.where} is no angle", line)
        dust = DUST * field.unit + 1e-11 * abs(expected) + dust_of(sentence, field.where, t)
        self.near(sentence, field.where, reader, off, field.unit / 2, "", dust, line)

    def turn(self, formatter, number, ms, line):
        """Rate and order."""
        key = (formatter, number)
        if formatter in PERIODS:
            last = self.last_ms.get(key)
            if last is None and not number and ms != self.first_ms:
                self.fault(f"{formatter} begins late", line)
            if last is not None and ms - last != PERIODS[formatter]:
                self.fault(f"{formatter} is out of its rate", f"{ms - last} ms: {line}")
            self.last_ms[key] = ms
        rank = TURNS.index(formatter)
        if ms == self.turn_ms and rank < self.rank:
            self.fault(f"{formatter} is out of its turn", line)
        self.turn_ms, self.rank = ms, rank

    def changed(self, what, value):
        """What it was before, if it was another."""
        before = self.was.get(what)
        self.was[what] = value
        return before if before is not None and before != value else None

    def note_cases(self, formatter, data, t):
        if formatter == "HDT":
            heading = float(data[0])
            before = self.was.get("heading", heading)
            self.was["heading"] = heading
            self.cases["north from the west"] += before > 350 and heading < 10
            self.cases["north from the east"] += before < 10 and heading > 350
            self.cases["heading 0.00"] += data[0] == "0.00"
        elif formatter == "RMC":
            self.cases["equator"] += self.changed("side", data[3]) is not None
            if self.changed("half", data[5]) is not None:
                self.cases["180th meridian" if int(data[4][:3]) >= 179 else "Greenwich"] += 1
            self.cases["south and west"] += data[3] + data[5] == "SW"
            self.cases["speed 0.00"] += data[6] == "0.00"
        elif formatter == "ZDA":
            if self.changed("day", data[1]) is not None:
                if data[0] != "000000.00":
                    self.fault("ZDA changes its day too late", ",".join(data))
                self.cases["midnight"] += 1
                self.cases["29 February"] += data[1:3] == ["29", "02"]
            self.cases["new year"] += self.changed("year", data[3]) is not None
        elif formatter == "VBW":
            self.cases["astern"] += float(data[0]) < -0.5
        elif formatter == "XTE":
            self.cases["on no track"] += data[0] == "V"
            self.cases["off track to port"] += data[3] == "R" and float(data[2]) > 0
            self.cases["off track to starboard"] += data[3] == "L" and float(data[2]) > 0
        elif formatter == "RSA":
            self.cases["port rudder"] += float(data[0]) < -1
        elif formatter == "RPM":
            self.cases["shaft astern"] += float(data[2]) < -1

    # A sentence about a target, by her number: from 1 in the order in which they were found.
    def judge_target(self, formatter, message, data, t, line):
        name = data[10 if formatter == "TTM" else 5]
        number = data[0]
        if self.targets.setdefault((number, "name"), name) != name:
            self.fault(f"{formatter} calls a target by another name", line)
        index = self.names.index(name)
        target = t.targets[index]
        target.own = t
        if data[11 if formatter == "TTM" else 7] == "L":
            if target.range_m < TRACKED_NM * 1852:
                self.fault(f"{formatter} lost a target that is near", line)
            self.lost += 1
            return
        self.heard[formatter].add(index)
        if target.range_m > TRACKED_UNTIL_NM * 1852:
            self.fault(f"{formatter} tracks a target that is far", line)
        for field in FIELDS[formatter]:
            self.judge(formatter, field, message, data, target, line)

    def end_targets(self, formatter, t):
        """All that are near have been told of."""
        if t.ms % 2000 == self.first_ms % 2000:
            for index, target in enumerate(t.targets):
                if target.range_m < TRACKED_NM * 1852 and index not in self.heard[formatter]:
                    self.fault(f"{formatter} leaves a target out", f"{self.names[index]} at {t.ms}")
        self.heard[formatter].clear()

    def read_line(self, line, t):
        sentence = line[line.index("\\", 1) + 1:]
        if len(sentence) > MOST_CHARACTERS or not sentence.endswith("\r\n"):
            self.fault("a line is too long or does not end with CR LF", line)
        bare = sentence.strip()
        formatter = bare[3:6]
        self.sentences[formatter] += 1
        self.turn(formatter, bare[7:9] if formatter in ("TTM", "TLL") else "", t.ms, bare)
        if bare[0] == "!":
            self.ais.read(sentence, t)
            return
        data = bare[1:-3].split(",")[1:]
        message = None
        try:
            message = pynmea2.parse(bare, check=True)
            if message.data != data:
                self.fault(f"{formatter}: pynmea2 reads other fields", bare)
        except pynmea2.SentenceTypeError:
            if checksum(bare[1:-3]) != bare[-2:]:
                self.fault(f"{formatter} cannot be read", f"its checksum is wrong: {bare}")
                return
        except pynmea2.ParseError as error:
            self.fault(f"{formatter} cannot be read", str(error))
            return
        if formatter in ("TTM", "TLL"):
            self.judge_target(formatter, message, data, t, bare)
            return
        for field in FIELDS[formatter]:
            self.judge(formatter, field, message, data, t, bare)
        if formatter == "RMC":
            self.ais.read_rmc(sentence, t)
        self.note_cases(formatter, data, t)

    def read(self):
        base = f"{self.folder}/{self.name}"
        with gzip.open(f"{base}.truth.gz", "rt") as truth, \
                gzip.open(f"{base}.nmea.gz", "rt", encoding="ascii", newline="") as nmea:
            about = json.loads(next(truth))
            next(truth)
            self.names = [target["name"] for target in about["targets"]]
            self.heard, self.lost = {"TTM": set(), "TLL": set()}, 0
            self.turn_ms, self.rank = None, 0
            self.ais = AisReader(self, about)
            line = next(nmea)
            self.first_ms = time_of(line)
            t = None
            for row in truth:
                t = Truth(row, about)
                while line and time_of(line) == t.ms:
                    self.read_line(line, t)
                    line = next(nmea, "")
                for formatter in ("TTM", "TLL"):
                    self.end_targets(formatter, t)
            if line:
                self.fault("a line is not of any tick, or out of its time", line)
            self.ais.end()
            for formatter, period in PERIODS.items():
                if formatter in ("TTM", "TLL"):
                    continue
                expected = (t.ms - self.first_ms) // period + 1
                if self.sentences[formatter] != expected:
                    self.fault(f"{formatter} is missing",
                               f"{self.sentences[formatter]} instead of {expected}")
        del self.ais
        return self


def time_of(line):
    """Milliseconds since 1970, of the TAG block "\\c:...*hh\\"."""
    tag = line[1:line.index("\\", 1)]
    if not tag.startswith("c:") or checksum(tag[:-3]) != tag[-2:]:
        raise ValueError(f"no TAG block with a time: {line}")
    return int(tag[2:-3])


def checksum(text):
    total = 0
    for character in text.encode("ascii"):
        total ^= character
    return f"{total:02X}"


def degrees_of(data, at):
    """Of two fields, [d]ddmm.mmmmm and its side."""
    digits = data[at].index(".") - 2
    minutes = float(data[at][digits:])
    if not re.fullmatch(r"\d+\.\d{5}", data[at]) or minutes >= 60:
        raise ValueError(f"no angle: {data[at]}")
    return (int(data[at][:digits]) + minutes / 60) * (-1 if data[at + 1] in "SW" else 1)


def dust_of(sentence, field, t):
    # The direction of a wind that is hardly there; ranges of two geodesics (truth 1e-13 relative of
    # degrees, Vincenty 0.1 mm); bearings and approaches that follow from them.
    if sentence == "MWV" and field == "wind_angle":
        return 1e-9 / t.felt[1]
    if sentence != "TTM":
        return 0.0
    metres = 2e-3 if t.range_m > 1000 else 2e-4
    if field == "distance":
        return metres / 1852
    if field == "bearing":
        return 60 * metres / max(t.range_m, 1e-3)
    if field == "dist_cpa":
        return 2 * metres / 1852
    if field == "time_cpa":
        return metres / max(t.closing_mps, 1e-3) / 60
    return 0.0


def read_voyage(arguments):
    begin = process_time()
    voyage = Voyage(*arguments).read()
    voyage.cpu_s = process_time() - begin
    return voyage


def print_table(voyages):
    columns, sentences = {}, Counter()
    for voyage in voyages:
        sentences += voyage.sentences
        for key, column in voyage.columns.items():
            if key in columns:
                columns[key].add(column)
            else:
                columns[key] = column
    print(f"\n{'sentence, field':34}{'read by':12}{'compared':>10}  worst error, bound")
    exact = defaultdict(list)
    for (sentence, field), column in columns.items():
        if column.bound is None:
            exact[sentence, column.reader].append(column.count)
            continue
        print(f"{sentence + ' ' + str(field):34}{column.reader:12}{column.count:10}  "
              f"{column.worst:.9f} {column.bound:g} {column.unit}")
    for (sentence, reader), counts in exact.items():
        print(f"{sentence + ', ' + str(len(counts)) + ' letters, times, ...':34}{reader:12}"
              f"{sum(counts):10}  exact")
    print(f"\n{sum(sentences.values())} lines:", ", ".join(
        f"{name} {count}" for name, count in sorted(sentences.items())))


def main():
    folder, names = sys.argv[1], sys.argv[2:]
    voyages = []
    with Pool(2) as pool:
        for voyage in pool.imap(read_voyage, [(folder, name) for name in names]):
            print(f"{voyage.name}: read, {sum(voyage.faults.values())} faults, "
                  f"{voyage.cpu_s:.0f} s of a core", flush=True)
            voyages.append(voyage)
    print_table(voyages)
    cases = sum((voyage.cases for voyage in voyages), Counter())
    print("Met:", ", ".join(f"{case} {cases[case]}" for case in CASES))
    failed = [f"no voyage met: {case}" for case in CASES if not cases[case]]
    for voyage in voyages:
        for what, count in voyage.faults.items():
            failed.append(f"{voyage.name}: {what}, {count} times")
            failed += [f"    {example.strip()}" for example in voyage.examples[what]]
    print("\n".join(failed) if failed else "All fields are as true as their digits.")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
