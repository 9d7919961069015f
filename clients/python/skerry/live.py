"""The native protocol over TCP.  Source: protocol/SPEC.md, section 2."""

import os
import socket

from . import messages
from .spokes import spoke_of, turns_of

_MOST = 1 << 20  # octets of a frame from a server


class Refused(Exception):
    """What the server said to a request."""


class Connection:
    """One thread at a time.  `hello`: the skerry.wire.Hello with which the server began.

    `token`: who one is; without, that of the environment's SKERRY_TOKEN.  Refused: the server does not know it.
    """

    def __init__(self, host="127.0.0.1", port=7410, timeout_s=10.0, token=None):
        self._socket = socket.create_connection((host, port), timeout_s)
        self._rest = bytearray()
        self._request = 0
        self._early = []  # messages that came before a reply
        self.hello = self._next_of("hello")
        token = os.environ.get("SKERRY_TOKEN", "") if token is None else token
        # A server ends connections that ask for nothing in their first 10 s.
        self.request(sign_in={"token": token})
        self._early.clear()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._socket.close()

    def messages(self):
        """The server's messages (skerry.wire.ServerMessage) as they come, until it closes the connection."""
        while True:
            message = self._early.pop(0) if self._early else self._read()
            if message is None:
                return
            yield message

    def request(self, **what):
        """Sends a request (subscribe=..., set=..., get_status=...) and waits for its reply.  Refused: with its text."""
        self._request += 1
        frame = messages.ClientMessage(request=self._request, **what).SerializeToString()
        length, n = bytearray(), len(frame)
        while n >= 128:
            length.append(n & 127 | 128)
            n >>= 7
        self._socket.sendall(bytes(length) + bytes([n]) + frame)
        while True:
            message = self._read()
            if message is None:
                raise ConnectionError("the server closed the connection")
            if message.WhichOneof("kind") == "reply" and message.reply.request == self._request:
                if message.reply.code != messages.Reply.OK:
                    raise Refused(message.reply.text)
                return message.reply
            self._early.append(message)

    def set(self, radar=0, view=0, **controls):
        """Changes controls: set(range_nm=6, gain=55).  Refused: with the allowed values."""
        return self.request(set=dict(radar=radar, view=view, **controls))

    def spokes(self, radar=0, view=0):
        """Subscribes to a view; its Spokes as they come."""
        self.request(subscribe=dict(radar=radar, view=view))
        for message in self.messages():
            if message.WhichOneof("kind") == "spoke":
                yield spoke_of(message.spoke)

    def turns(self, radar=0, view=0):
        """Subscribes to a view; its Turns, each when the next begins."""
        return turns_of(self.spokes(radar, view))

    def _next_of(self, kind):
        for message in self.messages():
            if message.WhichOneof("kind") == kind:
                return getattr(message, kind)
        raise ConnectionError(f"the server closed the connection before {kind} came")

    def _read(self):
        head = self._take_length()
        if head is None:
            return None
        if head > _MOST:
            raise ConnectionError(f"a frame of {head} octets; at most {_MOST}: this is no skerryd")
        while len(self._rest) < head:
            if not self._fill():
                raise ConnectionError("the connection ended within a frame")
        frame = bytes(self._rest[:head])
        del self._rest[:head]
        return messages.ServerMessage.FromString(frame)

    def _take_length(self):
        value = shift = at = 0
        while True:
            while at >= len(self._rest):
                if not self._fill():
                    return None
            octet = self._rest[at]
            at += 1
            value |= (octet & 127) << shift
            shift += 7
            if octet < 128:
                del self._rest[:at]
                return value
            if shift > 28:
                raise ConnectionError("a length that does not end: this is no skerryd")

    def _fill(self):
        more = self._socket.recv(1 << 16)
        self._rest += more
        return bool(more)


def connect(host="127.0.0.1", port=7410, timeout_s=10.0):
    """A Connection.  OSError if nobody listens there."""
    return Connection(host, port, timeout_s)
