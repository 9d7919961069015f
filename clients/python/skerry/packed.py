"""Compact spokes unpacked.  Source: protocol/RECORDING.md, "Compact mode"."""

import numpy

from . import messages

_MASK = (1 << 64) - 1
# Fields 1 .. 15 in the order of their numbers on the wire: index before scan.
_FIELDS = ("radar", "view", "sequence", "index", "scan", "spokes_per_turn", "range_scale", "bits", "cell_count",
           "cell_size_m", "heading", "latitude_deg", "longitude_deg", "utc_ns", "scenario_ns")
_BITS = {"radar": 0, "view": 1, "sequence": 2, "scan": 3, "index": 4, "spokes_per_turn": 5, "range_scale": 6, "bits": 7,
         "cell_count": 8, "cell_size_m": 9, "heading": 10, "latitude_deg": 11, "longitude_deg": 12, "utc_ns": 13,
         "scenario_ns": 14}
_DOUBLES = ("cell_size_m", "latitude_deg", "longitude_deg")
_LINES = ("heading", "latitude_deg", "longitude_deg", "utc_ns", "scenario_ns")
_WIDTH = {"sequence": 64, "cell_size_m": 64, "latitude_deg": 64, "longitude_deg": 64, "utc_ns": 64, "scenario_ns": 64}


def _varint(data, at):
    value = shift = 0
    while True:
        if at >= len(data) or shift > 63:
            raise ValueError("packed spokes: a number that does not end")
        octet = data[at]
        at += 1
        value |= (octet & 127) << shift
        shift += 7
        if octet < 128:
            return value & _MASK, at


def _rows(octets, count, width):
    """The picture whose differences, column by column, these are."""
    if count == 0 or width == 0:
        return numpy.zeros((count, width), numpy.uint8)
    differences = numpy.frombuffer(octets, numpy.uint8).reshape(width, count).T.astype(numpy.int16)
    out = numpy.zeros((count + 1, width + 1), numpy.int16)
    # Along diagonals everything that a cell is predicted from is known.
    for diagonal in range(count + width - 1):
        row = numpy.arange(max(0, diagonal - width + 1), min(count, diagonal + 1))
        column = diagonal - row
        west, north, corner = out[row + 1, column], out[row, column + 1], out[row, column]
        gradient = west + north - corner
        low, high = numpy.minimum(west, north), numpy.maximum(west, north)
        out[row + 1, column + 1] = (numpy.clip(gradient, low, high) + differences[row, column]) & 255
    return out[1:, 1:].astype(numpy.uint8)


def unpacked(packed):
    """The skerry.wire.Spoke messages of a skerry.recording.PackedSpokes.  ValueError if it is damaged."""
    data, count = packed.data, packed.count
    cells, at = _varint(data, 0)
    doppler, at = _varint(data, at)
    numbers, at = _varint(data, at)
    if at + numbers + count * (cells + doppler) != len(data):
        raise ValueError("packed spokes: of another length than they say")
    end = at + numbers
    rows = _rows(data[end:end + count * cells], count, cells)
    classes = _rows(data[end + count * cells:], count, doppler)
    before = before_that = dict.fromkeys(_FIELDS, 0)
    spokes = []
    for i in range(count):
        mask, at = _varint(data, at)
        now = {}
        for field in _FIELDS:
            guess = before[field]
            if field == "sequence":
                guess += 1
            elif field == "index":
                guess = 0 if guess + 1 == before["spokes_per_turn"] else guess + 1
            elif field == "scan":
                guess += now["index"] < before["index"]
            elif field in _LINES:
                guess = 2 * guess - before_that[field]
            if mask >> _BITS[field] & 1:
                zigzag, at = _varint(data, at)
                guess += (zigzag >> 1) ^ -(zigzag & 1)
            now[field] = guess & _MASK
        before_that, before = before, now
        spokes.append(_spoke(now, rows[i].tobytes(), classes[i].tobytes()))
    if at != end:
        raise ValueError("packed spokes: numbers are left over")
    return spokes


def _spoke(numbers, cells, doppler):
    spoke = messages.Spoke(cells=cells, doppler=doppler)
    for field, value in numbers.items():
        if field in _DOUBLES:
            value = numpy.uint64(value).view(numpy.float64).item()
        elif _WIDTH.get(field, 32) == 32 and value >= 1 << 32:
            raise ValueError(f"packed spokes: {field} is {value}")
        setattr(spoke, field, value)
    return spoke
