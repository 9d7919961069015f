"""The messages of protocol/wire and protocol/recording, by their full names.

They are read from messages.desc, which the build makes of the .proto files beside this file.
"""

import pathlib

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

_FILE = pathlib.Path(__file__).with_name("messages.desc")


def _load():
    if not _FILE.exists():
        raise ImportError(f"{_FILE} is missing: build the target skerry_python, and use its folder")
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(_FILE.read_bytes()).file:
        pool.Add(file)
    return pool, message_factory.MessageFactory(pool)


_pool, _factory = _load()


def message(name):
    """The class of a message: message("skerry.wire.Spoke").  KeyError if there is none."""
    return _factory.GetPrototype(_pool.FindMessageTypeByName(name))


ServerMessage = message("skerry.wire.ServerMessage")
ClientMessage = message("skerry.wire.ClientMessage")
Reply = message("skerry.wire.Reply")
Spoke = message("skerry.wire.Spoke")
PackedSpokes = message("skerry.recording.PackedSpokes")
