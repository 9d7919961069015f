"""Recordings: their items in order of time, spokes and turns."""

import collections
import heapq

from . import messages
from .mcap import DamagedRecording, Reader
from .packed import unpacked
from .spokes import spoke_of, turns_of

Item = collections.namedtuple("Item", "time_ns topic message")

_KINDS = {"hello": "skerry.wire.Hello", "settings": "skerry.wire.Settings", "own_ship": "skerry.wire.OwnShip",
          "world": "skerry.wire.World", "traffic": "skerry.recording.Traffic", "events": "skerry.recording.Event",
          "log": "skerry.recording.Log", "audit": "skerry.recording.AuditEntry",
          "inputs": "skerry.recording.Input", "exercise": "skerry.wire.ExerciseState",
          "targets": "skerry.wire.TargetList", "plots": "skerry.wire.TargetPlots",
          "spokes": "skerry.wire.Spoke"}


class Recording:
    """A file of skerryd, of `skerry recording`, or of an import.

    Damaged chunks are passed over; `damage` lists them.
    """

    def __init__(self, path):
        self._reader = Reader(path)
        self.damage = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._reader.close()

    def items(self, topics=None):
        """Items in order of time; those of equal time in the order of the file.

        `topics`: a set of topics as RECORDING.md has them; None: all.  Compact spokes come as spokes.
        """
        waiting = []  # a heap of (time, number, topic, octets or message)
        number = 0
        for chunk in self._reader.chunks:
            while waiting and waiting[0][0] < chunk.begin_ns:
                yield self._item(heapq.heappop(waiting))
            for entry in self._entries(chunk, topics):
                heapq.heappush(waiting, (entry[0], number, entry[1], entry[2]))
                number += 1
        while waiting:
            yield self._item(heapq.heappop(waiting))

    def _entries(self, chunk, topics):
        try:
            found = self._reader.messages(chunk)
        except DamagedRecording as damage:
            self.damage.append(str(damage))
            return
        for time, topic, octets in found:
            packed = topic.endswith("/packed_spokes")
            plain = topic[:-len("packed_spokes")] + "spokes" if packed else topic
            if topics is not None and plain not in topics or plain.rsplit("/", 1)[-1] not in _KINDS:
                continue
            if not packed:
                yield time, plain, octets
                continue
            try:
                for spoke in unpacked(messages.PackedSpokes.FromString(octets)):
                    yield spoke.utc_ns, plain, spoke
            except ValueError as error:
                self.damage.append(f"the chunk at {chunk.at}: {error}")

    @staticmethod
    def _item(entry):
        time, _, topic, content = entry
        if isinstance(content, bytes):
            content = messages.message(_KINDS[topic.rsplit("/", 1)[-1]]).FromString(content)
        return Item(time, topic, content)

    def hello(self):
        """The skerry.wire.Hello of the file: its radars; None if it has none."""
        return next((item.message for item in self.items({"hello"})), None)

    def spokes(self, radar=0, view=0):
        """The Spokes of a view."""
        for item in self.items({f"radar/{radar}/view/{view}/spokes"}):
            yield spoke_of(item.message)

    def turns(self, radar=0, view=0):
        """The Turns of a view."""
        return turns_of(self.spokes(radar, view))


def open_recording(path):
    """DamagedRecording if it is no MCAP file."""
    return Recording(path)
