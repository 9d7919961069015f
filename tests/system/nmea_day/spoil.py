# Spoils the logs of nmea_day, a little each time, and looks whether compare.py finds it.
# Usage: spoil.py FOLDER, where nmea_day has written its logs.
import gzip
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


def with_checksum(sentence):
    total = 0
    for character in sentence[1:sentence.index("*")].encode("ascii"):
        total ^= character
    return sentence[:sentence.index("*") + 1] + f"{total:02X}\r\n"


def change(formatter, pattern, replacement, which=30):
    """In the `which`th sentence of the formatter that has the pattern; the checksum is right."""
    def spoil(lines):
        seen = 0
        for number, line in enumerate(lines):
            tag, sentence = line[:line.index("\\", 1) + 1], line[line.index("\\", 1) + 1:]
            if sentence[3:6] != formatter or not re.search(pattern, sentence):
                continue
            seen += 1
            if seen == which:
                lines[number] = tag + with_checksum(re.sub(pattern, replacement, sentence, count=1))
                return
    return spoil


def drop(formatter):
    def spoil(lines):
        places = [i for i, line in enumerate(lines) if formatter in line[:40]]
        del lines[places[len(places) // 2]]
    return spoil


def swap(first, second):
    def spoil(lines):
        for i in range(1000, len(lines)):
            if first in lines[i][:40] and second in lines[i + 1][:40]:
                lines[i], lines[i + 1] = lines[i + 1], lines[i]
                return
    return spoil


def break_checksum(lines):
    i = next(i for i, line in enumerate(lines) if "SDDPT" in line)
    lines[i] = lines[i].replace("SDDPT,", "SDDPT,1")


def up(match):
    """The last digit one more; 9 becomes 8."""
    digit = int(match[2])
    return match[1] + str(digit + 1 if digit < 9 else 8) + match[3]


# What is done to which voyage, and what must be said of it.
SPOILT = [
    ("Wild", change("RMC", ",S,", ",N,"), "RMC latitude is off"),
    ("Wild", change("RMC", ",W,", ",E,"), "RMC longitude is off"),
    ("Dateline", change("GGA", r"(\.\d{4})(\d)(,[EW],)", up), "GGA longitude is off"),
    ("North", change("HDT", r"(\.\d)(\d)(,T)", up), "HDT heading is off"),
    ("North", change("THS", r",\d+\.\d\d,", ",360.00,"), "THS 0 is no angle"),
    ("Wild", change("RSA", r",-", ","), "RSA rsa_starboard is off"),
    ("Wild", change("VBW", r"VBW,-", "VBW,"), "VBW lon_water_spd is off"),
    ("Still", change("VHW", r",0\.00,N", ",-0.00,N"), "VHW water_speed_knots is not written so"),
    ("Wild", change("RPM", r"(\.)(\d)(,100)", up), "RPM speed is off"),
    ("Dateline", change("XTE", ",[LR],", ",,"), "XTE correction_dir is wrong"),
    ("Dateline", change("XTE", ",A,A,", ",V,V,"), "XTE warning_flag is wrong"),
    ("Storm", change("MWV", r"(,\d+\.)(\d)(,R)", up), "MWV wind_angle is off"),
    ("Storm", change("DPT", r"(\.)(\d)(,)", up), "DPT depth is off"),
    ("Storm", change("VDR", r"(\.\d)(\d)(,N)", up), "VDR current is off"),
    ("North", change("ROT", r"(\.)(\d)(,A)", up), "ROT rate_of_turn is off"),
    ("Wild", change("ZDA", r"ZDA,(\d{6})\.00,29,02", r"ZDA,\1.00,28,02", 1), "ZDA day is wrong"),
    ("Wild", change("RMC", ",290228,", ",010328,"), "RMC datestamp is wrong"),
    ("Still", change("ZDA", r"ZDA,000000\.00", "ZDA,240000.00", 1), "ZDA timestamp is wrong"),
    ("Still", change("TTM", r"(\.\d\d)(\d)(,)", up), "TTM distance is off"),
    ("Still", change("TLL", r"(\.\d{4})(\d)(,N,)", up), "TLL latitude is off"),
    ("North", drop("VWVHW"), "VHW is out of its rate"),
    ("North", drop("AIVDO"), "VDO of type"),
    ("North", drop("RATTM"), "TTM leaves a target out"),
    ("North", swap("GPVTG", "GPZDA"), "VTG is out of its turn"),
    ("Storm", break_checksum, "DPT cannot be read"),
]


def main():
    missed = []
    for voyage, spoil, said in SPOILT:
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(f"{sys.argv[1]}/{voyage}.truth.gz", folder)
            with gzip.open(f"{sys.argv[1]}/{voyage}.nmea.gz", "rt", newline="") as log:
                lines = log.readlines()
            spoil(lines)
            with gzip.open(f"{folder}/{voyage}.nmea.gz", "wt", newline="") as log:
                log.writelines(lines)
            ended = subprocess.run([sys.executable, "-B", f"{HERE}/compare.py", folder, voyage],
                                   capture_output=True, text=True)
            found = f"{voyage}: {said}" in ended.stdout and ended.returncode == 1
            print("found: " if found else "MISSED:", said)
            if not found:
                missed.append(said)
                print("\n".join(ended.stdout.splitlines()[-8:]), ended.stderr)
    print(f"{len(SPOILT) - len(missed)} of {len(SPOILT)} found")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
