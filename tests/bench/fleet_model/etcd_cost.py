#!/usr/bin/env python3
"""What grants, orders and watching hosts cost an etcd: the constants of fleet_model.py (constants.py).

Usage: etcd_cost.py [--members 3] [--watchers 0 50 200 500] [--rate 50] [--seconds 4] [--callers 1 16 64]

Starts an etcd of so many members on 127.0.0.1 in a folder of its own, and ends it. Hosts are connections of this
process: gRPC, written by hand, so that a thousand take little. Prints for each number of watchers what all members
together take for a grant (CPU) and when the first and the last watcher have it; and for each number of callers, who call
again when they are answered, calls a second, how long one takes, and CPU for one: to append an order, to ask who holds
a name, to keep a lease.
"""
import argparse
import itertools
import os
import re
import selectors
import socket
import struct
import subprocess
import sys
import tempfile
import time

GRANT = b"/skerry/bench/grant"
PREFIX, BEHIND = b"/skerry/bench/", b"/skerry/bench0"
SERIAL = re.compile(rb"#(\d{26})")  # a grant's value, as long as a LogGrant
ORDER_VALUE = bytes(90)  # LogOrder with 60 bytes
BIG = 2**31 - 1


def varint(n):
    out = b""
    while n > 127:
        out += bytes([n & 127 | 128])
        n >>= 7
    return out + bytes([n])


def field(number, value):  # of protobuf: bytes or a number
    if isinstance(value, bytes):
        return varint(number << 3 | 2) + varint(len(value)) + value
    return varint(number << 3) + varint(value)


def put(key, value):
    return field(1, key) + field(2, value)


def append(key):
    """As OrderStore::append: three compares, one put. That a key was never created holds for all three here."""
    compares = b"".join(field(1, field(2, 1) + field(3, k) + field(5, 0))
                        for k in (key, b"/skerry/bench/name/none", b"/skerry/none/grant"))
    return compares + field(2, field(2, put(key, ORDER_VALUE)))


READ = field(2, field(1, field(1, b"/skerry/bench/name/none")))  # as Holding::take() of who holds: no compare, no put
WATCH = field(1, field(1, PREFIX) + field(2, BEHIND))


class Link:
    """An HTTP/2 connection with gRPC calls; one at a time, or one that streams."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.port, self.next_stream, self.unread, self.grpc, self.trailers = port, 1, b"", b"", 0
        self.socket.sendall(b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + self.frame(4, 0, 0, struct.pack(">HI", 4, BIG)) +
                            self.frame(8, 0, 0, struct.pack(">I", BIG - 65535)))

    @staticmethod
    def frame(kind, flags, stream, body):
        return struct.pack(">I", len(body))[1:] + bytes([kind, flags]) + struct.pack(">I", stream) + body

    def call(self, path, message, ends=True):
        headers = {b":method": b"POST", b":scheme": b"http", b":path": path, b":authority": b"localhost",
                   b"content-type": b"application/grpc", b"te": b"trailers"}
        block = b"".join(b"\0" + varint(len(n)) + n + varint(len(v)) + v for n, v in headers.items())
        body = b"\0" + struct.pack(">I", len(message)) + message
        stream, self.next_stream = self.next_stream, self.next_stream + 2
        self.socket.sendall(self.frame(1, 4, stream, block) + self.frame(0, 1 if ends else 0, stream, body))

    def read(self):
        """The messages that have come; blocks for the first bytes."""
        data = self.socket.recv(1 << 16)
        if not data:
            sys.exit("etcd_cost.py: etcd ended a connection")
        self.unread += data
        messages = []
        while len(self.unread) >= 9:
            size = int.from_bytes(self.unread[:3], "big")
            if len(self.unread) < 9 + size:
                break
            kind, flags, body = self.unread[3], self.unread[4], self.unread[9:9 + size]
            self.unread = self.unread[9 + size:]
            if kind == 0:
                self.grpc += body
                while len(self.grpc) >= 5 and len(self.grpc) >= 5 + int.from_bytes(self.grpc[1:5], "big"):
                    end = 5 + int.from_bytes(self.grpc[1:5], "big")
                    messages.append(self.grpc[5:end])
                    self.grpc = self.grpc[end:]
            elif kind == 1 and flags & 1:
                self.trailers += 1  # a call has ended
            elif kind == 4 and not flags & 1:
                self.socket.sendall(self.frame(4, 1, 0, b""))
            elif kind == 6 and not flags & 1:
                self.socket.sendall(self.frame(6, 1, 0, body))
            elif kind in (3, 7):
                sys.exit(f"etcd_cost.py: etcd ended a call: frame {kind}, {body!r}")
        return messages


class Etcd:
    def __init__(self, members, folder):
        ports = self.free_ports(2 * members)
        self.clients = ports[:members]
        cluster = ",".join(f"m{i}=http://127.0.0.1:{ports[members + i]}" for i in range(members))
        self.children = [subprocess.Popen(
            ["etcd", "--name", f"m{i}", "--data-dir", f"{folder}/m{i}",
             "--listen-client-urls", f"http://127.0.0.1:{ports[i]}",
             "--advertise-client-urls", f"http://127.0.0.1:{ports[i]}",
             "--listen-peer-urls", f"http://127.0.0.1:{ports[members + i]}",
             "--initial-advertise-peer-urls", f"http://127.0.0.1:{ports[members + i]}",
             "--initial-cluster", cluster, "--initial-cluster-token", "bench", "--initial-cluster-state", "new",
             "--heartbeat-interval", "50", "--election-timeout", "500", "--logger", "zap", "--log-level", "error",
             "--log-outputs", "stderr"], stderr=subprocess.DEVNULL) for i in range(members)]
        for port in self.clients:
            self.await_answer(port)

    @staticmethod
    def free_ports(count):
        held = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
        ports = [one.getsockname()[1] for one in held]
        for one in held:
            one.close()
        return ports

    def await_answer(self, port):
        for _ in range(200):
            if any(child.poll() is not None for child in self.children):
                sys.exit("etcd_cost.py: an etcd ended before it answered")
            try:
                one_call(Link(port), b"/etcdserverpb.KV/Put", put(b"/skerry/begin", b"x"))
                return
            except OSError:
                time.sleep(0.1)
        sys.exit("etcd_cost.py: etcd does not answer within 20 s")

    def cpu(self):
        ticks = 0
        for child in self.children:
            with open(f"/proc/{child.pid}/stat", encoding="ascii") as stat:
                ticks += sum(int(n) for n in stat.read().rsplit(")", 1)[1].split()[11:13])
        return ticks / os.sysconf("SC_CLK_TCK")

    def memory_mb(self):
        total = 0
        for child in self.children:
            with open(f"/proc/{child.pid}/statm", encoding="ascii") as statm:
                total += int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        return total / 1e6

    def end(self):
        for child in self.children:
            child.terminate()
        for child in self.children:
            child.wait()


def one_call(link, path, message):
    ended = link.trailers
    link.call(path, message)
    while link.trailers == ended:
        link.read()


def of(values, share):
    values = sorted(values)
    return 1000 * values[int(share * (len(values) - 1))]


SERIALS = itertools.count()


def next_serial(count):
    first = next(SERIALS)
    for _ in range(count - 1):
        next(SERIALS)
    return first


def watch(etcd, count, rate, seconds):
    links, poll = [], selectors.DefaultSelector()
    for i in range(count):
        link = Link(etcd.clients[i % len(etcd.clients)])
        link.call(b"/etcdserverpb.Watch/Watch", WATCH, ends=False)
        while not link.read():  # created
            pass
        links.append(link)
        poll.register(link.socket, selectors.EVENT_READ, link)
    writer, sent, replies = Link(etcd.clients[0]), [], 0
    poll.register(writer.socket, selectors.EVENT_READ, writer)
    first, last, took = {}, {}, []
    total, heard = int(rate * seconds), 0
    before = next_serial(total)
    memory, cpu, begun = etcd.memory_mb(), etcd.cpu(), time.monotonic()
    while len(took) < total or heard < total * count:
        due = begun + len(sent) / rate
        if len(sent) < total and time.monotonic() >= due:
            sent.append(time.monotonic())
            writer.call(b"/etcdserverpb.KV/Put", put(GRANT, b"#%026d" % (before + len(sent) - 1)))
        patience = max(0.0, begun + len(sent) / rate - time.monotonic()) if len(sent) < total else 5.0
        ready = poll.select(patience)
        if not ready and len(sent) == total:
            sys.exit(f"etcd_cost.py: {heard} of {total * count} events came")
        for key, _ in ready:
            link, messages = key.data, key.data.read()
            now = time.monotonic()
            if link is writer:
                while replies < writer.trailers:
                    took.append(now - sent[replies])
                    replies += 1
                continue
            for serial in (int(n) - before for message in messages for n in SERIAL.findall(message)):
                if serial < 0:
                    continue  # of the round before
                first.setdefault(serial, now)
                last[serial] = now
                heard += 1
    cpu = etcd.cpu() - cpu
    for link in [*links, writer]:
        link.socket.close()
    until = [[when[i] - sent[i] for i in when] or [0] for when in (first, last)]
    return {"watchers": count, "events": total, "cpu_ms": 1000 * cpu, "put": took, "first": until[0],
            "last": until[1], "memory": memory}


def lease(etcd):
    link = Link(etcd.clients[0])
    link.call(b"/etcdserverpb.Lease/LeaseGrant", field(1, 60) + field(2, 7))
    while not link.trailers:
        link.read()
    link.socket.close()
    return field(1, 7)


def calls(etcd, count, seconds, path, message):
    """So many links, each of which calls again when it is answered; `message` of a number that no other call has."""
    poll, took, begun_at = selectors.DefaultSelector(), [], {}
    links = [Link(etcd.clients[i % len(etcd.clients)]) for i in range(count)]
    serial = int(time.monotonic() * 1e6)
    for link in links:
        poll.register(link.socket, selectors.EVENT_READ, link)
    cpu, begun = etcd.cpu(), time.monotonic()

    def begin(link):
        nonlocal serial
        serial += 1
        begun_at[link] = (time.monotonic(), link.trailers)
        link.call(path, message(serial))

    for link in links:
        begin(link)
    while time.monotonic() < begun + seconds:
        for key, _ in poll.select(1.0):
            link = key.data
            link.read()
            if link.trailers > begun_at[link][1]:
                took.append(time.monotonic() - begun_at[link][0])
                begin(link)
    elapsed, cpu = time.monotonic() - begun, etcd.cpu() - cpu
    for link in links:
        link.socket.close()
    return took, elapsed, cpu


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--members", type=int, default=3, help="of the etcd (3)")
    parser.add_argument("--watchers", type=int, nargs="*", default=[0, 50, 200, 500], help="hosts (0 50 200 500)")
    parser.add_argument("--rate", type=float, default=50.0, help="grants a second (50; a fleet has 10)")
    parser.add_argument("--seconds", type=float, default=4.0, help="for each number (4)")
    parser.add_argument("--callers", type=int, nargs="*", default=[1, 16, 64], help="hosts that call at once (1 16 64)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        etcd = Etcd(options.members, folder)
        try:
            print(f"etcd of {options.members} members, {options.rate:g} grants/s, load {os.getloadavg()[0]:.0f} on "
                  f"{os.cpu_count()} cores")
            print("| watchers | CPU, all members, ms/grant | us/grant and watcher | reply p50, p99 ms "
                  "| first watcher p50, p99 ms | last watcher p50, p99 ms | memory of all, MB |")
            print("|---|---|---|---|---|---|---|")
            bare = None
            for count in options.watchers:
                r = watch(etcd, count, options.rate, options.seconds)
                each = r["cpu_ms"] / r["events"]
                bare = each if count == 0 else bare
                share = f"{1000 * (each - bare) / count:.1f}" if count and bare is not None else "-"
                spans = [f"{of(r[k], 0.5):.1f}, {of(r[k], 0.99):.1f}" for k in ("put", "first", "last")]
                print(f"| {count} | {each:.2f} | {share} | {' | '.join(spans)} | {r['memory']:.0f} |", flush=True)
            kept = lease(etcd)
            kinds = {"order": (b"/etcdserverpb.KV/Txn", lambda n: append(b"/skerry/bench/order/%d" % n)),
                     "who holds": (b"/etcdserverpb.KV/Txn", lambda n: READ),
                     "lease kept": (b"/etcdserverpb.Lease/LeaseKeepAlive", lambda n: kept)}
            print("\n| call | callers | calls/s | p50, p99 ms | CPU, all members, ms/call |\n|---|---|---|---|---|")
            for kind, (path, message) in kinds.items():
                for count in options.callers:
                    took, elapsed, cpu = calls(etcd, count, options.seconds / 2, path, message)
                    print(f"| {kind} | {count} | {len(took) / elapsed:.0f} | {of(took, 0.5):.1f}, {of(took, 0.99):.1f} | "
                          f"{1000 * cpu / len(took):.2f} |", flush=True)
        finally:
            etcd.end()


if __name__ == "__main__":
    main()
