"""The chunks of an MCAP file.  Source: https://mcap.dev/spec, and protocol/RECORDING.md."""

import dataclasses
import struct
import zlib

_MAGIC = b"\x89MCAP0\r\n"
_MOST = 64 << 20  # octets of a chunk, unpacked


class DamagedRecording(Exception):
    """What is wrong with a file, and at which octet."""


@dataclasses.dataclass
class Chunk:
    at: int  # of its record
    begin_ns: int
    end_ns: int


def _text(data, at):
    length, = struct.unpack_from("<I", data, at)
    if at + 4 + length > len(data):
        raise DamagedRecording(f"a text of {length} octets at {at} does not fit its record")
    return bytes(data[at + 4:at + 4 + length]).decode(), at + 4 + length


def _unpack(compression, data, size):
    if size > _MOST:
        raise DamagedRecording(f"a chunk of {size} octets; at most {_MOST}")
    if compression == "":
        return bytes(data)
    if compression == "lz4":
        import lz4.frame
        return lz4.frame.decompress(data)
    if compression == "zstd":
        import zstandard
        return zstandard.ZstdDecompressor().decompress(data, max_output_size=size)
    raise DamagedRecording(f"a chunk is compressed by '{compression}'; expected lz4, zstd or nothing")


class Reader:
    """An open file.  A file that ends early is read up to its last whole chunk."""

    def __init__(self, path):
        self._file = open(path, "rb")
        if self._file.read(8) != _MAGIC:
            self._file.close()
            raise DamagedRecording(f"{path}: it does not begin as an MCAP file does")
        self._file.seek(0, 2)
        self._size = self._file.tell()
        self.chunks = sorted(self._find_chunks(), key=lambda chunk: (chunk.begin_ns, chunk.at))

    def close(self):
        self._file.close()

    def _record(self, at):
        """Kind, where its content begins, and its length; None at the end or where it is cut off."""
        self._file.seek(at)
        head = self._file.read(9)
        if len(head) < 9:
            return None
        kind, length = struct.unpack("<BQ", head)
        return (kind, at + 9, length) if at + 9 + length <= self._size else None

    def _find_chunks(self):
        at = 8
        while True:
            record = self._record(at)
            if record is None or record[0] == 0x0F:  # DataEnd
                return
            kind, content, length = record
            if kind == 0x06 and length >= 16:
                begin, end = struct.unpack("<QQ", self._file.read(16))
                yield Chunk(at, begin, end)
            at = content + length

    def messages(self, chunk):
        """(log_time_ns, topic, octets) of a chunk, in its order.  DamagedRecording if it is not whole."""
        record = self._record(chunk.at)
        if record is None:
            raise DamagedRecording(f"the chunk at {chunk.at} is cut off")
        data = memoryview(self._file.read(record[2]))
        try:
            _, _, size, crc = struct.unpack_from("<QQQI", data, 0)
            compression, at = _text(data, 28)
            packed, = struct.unpack_from("<Q", data, at)
            content = _unpack(compression, data[at + 8:at + 8 + packed], size)
        except DamagedRecording:
            raise
        except Exception as error:  # of the compressors
            raise DamagedRecording(f"the chunk at {chunk.at}: {error}") from error
        if len(content) != size or (crc and zlib.crc32(content) != crc):
            raise DamagedRecording(f"the chunk at {chunk.at} is not what its checksum says")
        return self._messages_in(memoryview(content))

    @staticmethod
    def _messages_in(content):
        topics, out, at = {}, [], 0
        while at + 9 <= len(content):
            kind, length = struct.unpack_from("<BQ", content, at)
            begin, at = at + 9, at + 9 + length
            if at > len(content):
                raise DamagedRecording("a record reaches beyond its chunk")
            if kind == 0x04:  # Channel
                number, = struct.unpack_from("<H", content, begin)
                topics[number], _ = _text(content[:at], begin + 4)
            elif kind == 0x05 and length >= 22:  # Message
                number, _, time = struct.unpack_from("<HIQ", content, begin)
                if number in topics:
                    out.append((time, topics[number], bytes(content[begin + 22:at])))
        return out
