"""Spokes and turns as numpy arrays."""

import dataclasses
import math

import numpy


@dataclasses.dataclass
class Spoke:
    """The video of one azimuth."""

    radar: int
    view: int
    sequence: int         # +1 per spoke of its view; a gap is a loss
    scan: int             # the turn it belongs to
    index: int            # 0 .. spokes_per_turn - 1, clockwise from the bow
    spokes_per_turn: int
    bits: int             # per cell: 4 or 8
    cell_m: float         # cell n covers [n, n + 1) * cell_m
    heading_deg: float    # the bow, true, [0, 360)
    latitude_deg: float   # of the antenna; 0 and 0 where it is not known
    longitude_deg: float
    utc_ns: int           # since 1970-01-01
    cells: numpy.ndarray  # uint8, nearest first, 0 .. 2^bits - 1
    doppler: object       # uint8 of the same length: 1 approaching, 2 receding; None: there is none

    @property
    def bearing_deg(self):
        """True bearing, [0, 360)."""
        return (self.heading_deg + 360.0 * self.index / self.spokes_per_turn) % 360.0

    @property
    def ranges_m(self):
        """The middle of each cell."""
        return (numpy.arange(len(self.cells)) + 0.5) * self.cell_m


def _spread(octets, count, bits):
    """`count` numbers of `bits` bits, lowest bits first."""
    raw = numpy.frombuffer(octets, numpy.uint8)
    if bits == 8:
        return raw[:count].copy()
    each = 8 // bits
    out = numpy.empty((len(raw), each), numpy.uint8)
    for k in range(each):
        out[:, k] = raw >> (bits * k) & ((1 << bits) - 1)
    return out.reshape(-1)[:count]


def spoke_of(message):
    """The Spoke that a skerry.wire.Spoke is.  ValueError where it contradicts itself."""
    count, bits = message.cell_count, message.bits
    if bits not in (4, 8) or not 0 < count <= 4096:
        raise ValueError(f"a spoke of {count} cells of {bits} bits")
    if len(message.cells) != (count * bits + 7) // 8:
        raise ValueError(f"{len(message.cells)} octets for {count} cells of {bits} bits")
    if message.index >= message.spokes_per_turn:
        raise ValueError(f"spoke {message.index} of {message.spokes_per_turn}")
    if message.doppler and len(message.doppler) != (count + 3) // 4:
        raise ValueError(f"{len(message.doppler)} octets of Doppler for {count} cells")
    return Spoke(
        radar=message.radar, view=message.view, sequence=message.sequence, scan=message.scan,
        index=message.index, spokes_per_turn=message.spokes_per_turn, bits=bits,
        cell_m=message.cell_size_m, heading_deg=message.heading * 360.0 / 2**32,
        latitude_deg=message.latitude_deg, longitude_deg=message.longitude_deg,
        utc_ns=message.utc_ns, cells=_spread(message.cells, count, bits),
        doppler=_spread(message.doppler, count, 2) if message.doppler else None)


@dataclasses.dataclass
class Turn:
    """A turn of one view, with the number of cells and spokes and the range of its first spoke."""

    radar: int
    view: int
    number: int
    bits: int
    cell_m: float
    cells: numpy.ndarray     # uint8, [spokes_per_turn, cells]; 0 where nothing came
    there: numpy.ndarray     # bool, by spoke: whether it came
    headings_deg: numpy.ndarray  # by spoke; NaN where nothing came
    utc_ns: numpy.ndarray    # int64, by spoke; 0 where nothing came

    def ppi(self, size, north_up=True):
        """The picture as [size, size] uint8, the ship in the middle, north or the bow at the top."""
        axis = (numpy.arange(size) - (size - 1) / 2.0) / (size / 2.0)
        east, north = numpy.meshgrid(axis, -axis)
        cell = (numpy.hypot(east, north) * self.cells.shape[1]).astype(int)
        bearing = numpy.degrees(numpy.arctan2(east, north))
        if north_up:
            bearing = bearing - _mean_deg(self.headings_deg[self.there])
        spokes = self.cells.shape[0]
        index = numpy.floor((bearing % 360.0) / 360.0 * spokes).astype(int) % spokes
        inside = cell < self.cells.shape[1]
        return numpy.where(inside, self.cells[index, numpy.minimum(cell, self.cells.shape[1] - 1)], 0)


def _mean_deg(angles):
    if len(angles) == 0:
        return 0.0
    radians = numpy.radians(angles)
    return math.degrees(math.atan2(numpy.sin(radians).mean(), numpy.cos(radians).mean()))


def turns_of(spokes):
    """Turns out of the spokes of one view, each when the next begins; the last one too.

    A turn also ends where the number of cells or spokes or the range changes.
    """
    turn = None
    for spoke in spokes:
        fits = turn is not None and (
            (turn.number, turn.cells.shape, turn.cell_m) ==
            (spoke.scan, (spoke.spokes_per_turn, len(spoke.cells)), spoke.cell_m))
        if not fits:
            if turn is not None:
                yield turn
            n = spoke.spokes_per_turn
            turn = Turn(spoke.radar, spoke.view, spoke.scan, spoke.bits, spoke.cell_m,
                        numpy.zeros((n, len(spoke.cells)), numpy.uint8), numpy.zeros(n, bool),
                        numpy.full(n, numpy.nan), numpy.zeros(n, numpy.int64))
        turn.cells[spoke.index] = spoke.cells
        turn.there[spoke.index] = True
        turn.headings_deg[spoke.index] = spoke.heading_deg
        turn.utc_ns[spoke.index] = spoke.utc_ns
    if turn is not None:
        yield turn
