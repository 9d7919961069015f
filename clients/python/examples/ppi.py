"""The last whole turn of a recording as a picture: ppi.py RECORDING [OUT.pgm]"""

import sys

import skerry

with skerry.open_recording(sys.argv[1]) as recording:
    for turn in recording.turns(radar=0):
        if turn.there.all():
            whole = turn
picture = whole.ppi(800) * (255 // (2**whole.bits - 1))
with open(sys.argv[2] if len(sys.argv) > 2 else "ppi.pgm", "wb") as out:
    out.write(b"P5 800 800 255\n" + picture.astype("uint8").tobytes())
