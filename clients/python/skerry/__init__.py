"""Skerry's recordings and live streams as numpy arrays.

    import skerry
    for turn in skerry.open_recording("exercise.mcap").turns(radar=0):
        print(turn.number, turn.cells.shape, turn.cells.max())

    with skerry.connect() as radar:
        for spoke in radar.spokes(radar=0):
            print(spoke.index, spoke.cells.mean())
"""

from .live import Connection, Refused, connect
from .mcap import DamagedRecording
from .recording import Item, Recording, open_recording
from .spokes import Spoke, Turn, spoke_of, turns_of

__all__ = ["Connection", "DamagedRecording", "Item", "Recording", "Refused", "Spoke", "Turn", "connect",
           "open_recording", "spoke_of", "turns_of"]
