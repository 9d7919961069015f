"""The Python package against skerryd and skerry: python_test.py SKERRYD SKERRY PACKAGE EXAMPLES

What it reads is compared with what the C++ programs write of the same spokes.
"""

import itertools
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

SKERRYD, SKERRY, PACKAGE, EXAMPLES = sys.argv[1:5]
sys.path.insert(0, PACKAGE)

import numpy  # noqa: E402
import skerry  # noqa: E402

# Of 512 spokes of a turn. A machine that is busy may lose some on the way.
MOST = 400

SCENARIO = """
name: Small
own_ships:
  - name: Tern
    position: {lat: 60.425, lon: 5.040}
    course_deg: 335
    speed_kn: 12
    radars:
      - {name: Eight bits, spokes: 512, cells: 512, bits: 8, rpm: 60, range_nm: 6}
      - {name: Four bits, spokes: 512, cells: 512, bits: 4, rpm: 60, range_nm: 6}
"""


def run(*arguments):
    return subprocess.run(arguments, check=True, capture_output=True, text=True, timeout=120).stdout


class Server:
    def __init__(self, folder):
        scenario = pathlib.Path(folder, "small.yaml")
        scenario.write_text(SCENARIO)
        self.process = subprocess.Popen(
            [SKERRYD, "--scenario", scenario, "--tcp-port", "0", "--http-port", "0", "--print-ports", "--no-udp",
             "--no-cat240", "--no-signalk", "--record-folder", folder],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.port = int(self.process.stdout.readline().split()[1])

    def stop(self):
        self.process.terminate()
        code = self.process.wait(60)
        self.process.stdout.close()
        return code


class PythonPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.server = Server(cls.folder.name)
        port = str(cls.server.port)
        run(SKERRY, "record", "start", "plain", "--port", port)
        with skerry.connect(port=cls.server.port) as live:
            # A machine that is busy may lose a spoke on the way: whole turns.
            whole = (turn for turn in live.turns(radar=1) if turn.there.all())
            cls.live = list(itertools.islice(whole, 2))
        cls.raw = pathlib.Path(cls.folder.name, "turn.pgm")
        run(SKERRY, "snapshot", "--raw", str(cls.raw), "-o", str(cls.raw) + ".png", "--port", port)
        run(SKERRY, "record", "stop", "--port", port)
        cls.plain = str(next(pathlib.Path(cls.folder.name).glob("*.mcap")))

    @classmethod
    def tearDownClass(cls):
        code = cls.server.stop()
        cls.folder.cleanup()
        assert code == 0, code

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_turns_live_are_those_recorded(self):
        with skerry.open_recording(self.plain) as recording:
            self.assertEqual([radar.name for radar in recording.hello().radars], ["Eight bits", "Four bits"])
            recorded = {turn.number: turn for turn in recording.turns(radar=1)}
            self.assertEqual(recording.damage, [])
        for turn in self.live:
            self.assertTrue(turn.there.all())
            self.assertEqual(turn.cells.shape, (512, 512))
            self.assertEqual(turn.cells.max(), 15)
            there = recorded[turn.number].there
            self.assertGreater(there.sum(), MOST)
            numpy.testing.assert_array_equal(turn.cells[there], recorded[turn.number].cells[there])
            numpy.testing.assert_array_equal(turn.headings_deg[there], recorded[turn.number].headings_deg[there])

    def test_cells_are_those_that_the_command_line_writes(self):
        cells = numpy.frombuffer(self.raw.read_bytes()[-512 * 512:], numpy.uint8).reshape(512, 512)
        self.assertGreater(cells.max(), 200)
        drawn = cells.any(axis=1)
        self.assertGreater(drawn.sum(), MOST)
        with skerry.open_recording(self.plain) as recording:
            turns = list(recording.turns(radar=0))
        both = [(turn, turn.there & drawn) for turn in turns]
        self.assertTrue(any(rows.sum() > MOST and (turn.cells[rows] == cells[rows]).all() for turn, rows in both),
                        [(turn.number, int(rows.sum()), int((turn.cells[rows] == cells[rows]).all(axis=1).sum()))
                         for turn, rows in both])

    def test_compact_spokes_are_octet_for_octet_those_packed(self):
        def octets(path):
            with skerry.open_recording(path) as recording:
                spokes = [item.message.SerializeToString() for item in recording.items({"radar/0/view/0/spokes"})]
                self.assertEqual(recording.damage, [])
                return spokes
        expected = octets(self.plain)
        self.assertGreater(len(expected), 1000)
        for compression in ("none", "lz4", "zstd"):
            out = self.path(f"{compression}.mcap")
            run(SKERRY, "recording", "cut", self.plain, "--from", "0", "--compact", "--compression", compression,
                "-o", out)
            self.assertEqual(octets(out), expected, compression)

    def test_items_come_in_order_of_time(self):
        with skerry.open_recording(self.plain) as recording:
            times = [item.time_ns for item in recording.items()]
        self.assertEqual(times, sorted(times))

    def test_damage_costs_a_chunk_and_is_told(self):
        octets = bytearray(pathlib.Path(self.plain).read_bytes())
        with skerry.open_recording(self.plain) as recording:
            whole = sum(1 for _ in recording.spokes())
            chunks = recording._reader.chunks
            chunk = chunks[len(chunks) // 2]
        length, = struct.unpack_from("<Q", octets, chunk.at + 1)
        octets[chunk.at + 9 + length // 2] ^= 255
        bad = pathlib.Path(self.path("bad"))
        bad.write_bytes(octets)
        with skerry.open_recording(bad) as recording:
            left = sum(1 for _ in recording.spokes())
            self.assertEqual(len(recording.damage), 1)
        self.assertTrue(0 < left < whole)
        bad.write_bytes(octets[:len(octets) * 2 // 3])
        with skerry.open_recording(bad) as recording:
            self.assertGreater(sum(1 for _ in recording.spokes()), 0)
        bad.write_bytes(b"no recording")
        with self.assertRaises(skerry.DamagedRecording):
            skerry.open_recording(bad)

    def test_controls_are_set_and_refused(self):
        with skerry.connect(port=self.server.port) as live:
            live.set(radar=0, gain=61)
            with self.assertRaisesRegex(skerry.Refused, "0 to 100"):
                live.set(radar=0, gain=101)
            live.request(subscribe={"radar": 0})
            gain = next(m.settings.gain for m in live.messages() if m.WhichOneof("kind") == "settings")
            self.assertEqual(gain, 61)

    def test_nobody_there(self):
        with self.assertRaises(OSError):
            skerry.connect(port=1, timeout_s=1)

    def test_examples_run(self):
        env = dict(os.environ, PYTHONPATH=PACKAGE)
        picture = self.path("ppi.pgm")
        subprocess.run([sys.executable, f"{EXAMPLES}/ppi.py", self.plain, picture], check=True, env=env, timeout=60)
        pixels = numpy.frombuffer(pathlib.Path(picture).read_bytes()[-640000:], numpy.uint8)
        self.assertGreater((pixels > 128).sum(), 500)
        with subprocess.Popen([sys.executable, f"{EXAMPLES}/bearing.py", "90", str(self.server.port)], env=env,
                              stdout=subprocess.PIPE, text=True) as example:
            self.assertRegex(example.stdout.readline(), r"^\d+ \d+ \d+ m$")
            example.terminate()


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result
    bad = len(result.failures) + len(result.errors)
    # As the C++ test programs say it, for tests/run.
    for test, text in result.failures + result.errors:
        print(f"{test.id()}: Failure", *text.rstrip().splitlines()[-7:], sep="\n")
    print(f"[  PASSED  ] {result.testsRun - bad} tests.")
    if bad:
        print(f"[  FAILED  ] {bad} tests.")
    sys.exit(bad != 0)
