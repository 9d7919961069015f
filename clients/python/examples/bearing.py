"""The strongest echo on one true bearing, turn by turn, live: bearing.py DEGREES [PORT]"""

import sys

import skerry

wanted = float(sys.argv[1])
with skerry.connect(port=int(sys.argv[2]) if len(sys.argv) > 2 else 7410) as server:
    for spoke in server.spokes(radar=0):
        if abs((spoke.bearing_deg - wanted + 180) % 360 - 180) < 180 / spoke.spokes_per_turn:
            print(spoke.scan, spoke.cells.max(), round(float(spoke.ranges_m[spoke.cells.argmax()])), "m", flush=True)
