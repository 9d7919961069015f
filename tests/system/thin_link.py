#!/usr/bin/env python3
"""Shows what a relay makes of a slow link: level, rate, losses and age of its picture.

Usage, as root: thin_link.py SKERRYD [--rate KBIT] [--seconds N]   Exit code 1 if the picture is not usable, 77 without root.
Example: thin_link.py build/release/bin/skerryd --rate 256 --seconds 60

Origin and relay run in network namespaces of their own with a link of that rate between them (tc tbf), one radar
of 4096 spokes of 1024 cells, with land on both sides, on the one, `--relay-thin auto` on the other. Usable: after 20 s no spoke is missing, whole turns come, and no
spoke is older than 2 s.
"""
import argparse
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request

NEAR, FAR = "10.98.0.1", "10.98.0.2"
SCENARIO = """
name: Thin link
seed: 1
own_ships:
  - name: Tern
    position: {lat: 60.425, lon: 5.040}
    course_deg: 335
    speed_kn: 12
    radars:
      - {name: X band, spokes: 4096, cells: 1024, bits: 8, rpm: 24, range_nm: 6}
"""


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"thin_link.py: {' '.join(command)}: {done.stderr.strip()}")


def start(command, inside=None):
    """A server, once it has printed its ports: process, port of TCP, port of HTTP."""
    enter = ["nsenter", "-t", str(inside), "-n"] if inside else []
    server = subprocess.Popen([*enter, *command, "--tcp-port", "0", "--http-port", "0", "--no-udp", "--no-cat240", "--print-ports"],
                              stdout=subprocess.PIPE, stderr=None if os.environ.get("THIN_LINK_LOG") else subprocess.DEVNULL, text=True)
    ports = {}
    for line in server.stdout:
        ports.update((name, int(port)) for name, port in re.findall(r"(\w+)[ =:]+(\d+)", line))
        if "tcp" in ports and "http" in ports:
            return server, ports["tcp"], ports["http"]
    sys.exit(f"thin_link.py: {' '.join(command)} has not begun")


def varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return value, at


def fields(data):
    at, found = 0, {}
    while at < len(data):
        key, at = varint(data, at)
        if key & 7 == 0:
            value, at = varint(data, at)
        else:
            size = {1: 8, 5: 4}.get(key & 7)
            if size is None:
                size, at = varint(data, at)
            value, at = data[at:at + size], at + size
        found[key >> 3] = value
    return found


def spokes(port, seconds):
    """Of view 0 of radar 0: when it came, sequence, turn, cells, age in s."""
    with socket.create_connection(("127.0.0.1", port)) as console:
        console.sendall(b"\x04\x08\x01\x12\x00")  # ClientMessage {request: 1, subscribe: {}}
        data, end = b"", time.time() + seconds
        while time.time() < end:
            data += console.recv(1 << 20)
            at = 0
            while True:
                try:
                    size, body = varint(data, at)
                except IndexError:
                    break
                if len(data) < body + size:
                    break
                message = fields(data[body:body + size])
                at = body + size
                if 1 in message:
                    spoke = fields(message[1])
                    utc = int.from_bytes(spoke[14], "little") * 1e-9
                    yield time.time(), spoke.get(3, 0), spoke.get(4, 0), spoke[6], spoke[9], time.time() - utc
            data = data[at:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("skerryd")
    parser.add_argument("--rate", type=int, default=256, help="of the link, kbit/s")
    parser.add_argument("--seconds", type=int, default=10, help="that are measured, behind the first 20")
    args = parser.parse_args()
    if os.geteuid() != 0:
        print("thin_link.py: it needs root, for network namespaces")
        sys.exit(77)
    if os.environ.get("THIN_LINK") != "1":
        os.environ["THIN_LINK"] = "1"
        os.execvp("unshare", ["unshare", "--net", sys.executable, *sys.argv])
    run("ip", "link", "set", "lo", "up")
    place = subprocess.Popen(["unshare", "--net", "sleep", "3600"])
    time.sleep(0.5)
    servers, folder = [], tempfile.mkdtemp()
    try:
        inside = ["nsenter", "-t", str(place.pid), "-n"]
        run("ip", "link", "add", "name", "far0", "type", "veth", "peer", "name", "near0", "netns", str(place.pid))
        run("ip", "addr", "add", f"{FAR}/24", "dev", "far0")
        run("ip", "link", "set", "far0", "up")
        for command in (["ip", "link", "set", "lo", "up"], ["ip", "addr", "add", f"{NEAR}/24", "dev", "near0"],
                        ["ip", "link", "set", "near0", "up"]):
            run(*inside, *command)
        run(*inside, "tc", "qdisc", "add", "dev", "near0", "root", "tbf", "rate", f"{args.rate}kbit", "burst", "4kb", "latency", "200ms")
        scenario = os.path.join(folder, "thin.yaml")
        with open(scenario, "w", encoding="utf-8") as file:
            file.write(SCENARIO)
        origin, tcp, _ = start([args.skerryd, "--scenario", scenario, "--bind", NEAR, "--insecure"], place.pid)
        servers.append(origin)
        relay, tcp, http = start([args.skerryd, "--relay", f"{NEAR}:{tcp}", "--relay-thin", "auto"])
        servers.append(relay)
        time.sleep(20)
        came = list(spokes(tcp, args.seconds))
        with urllib.request.urlopen(f"http://127.0.0.1:{http}/status") as answer:
            hop = json.load(answer)["hops"][0]
    finally:
        for server in servers:
            server.terminate()
            server.wait()
        place.kill()
        shutil.rmtree(folder)
    if len(came) < 2:
        sys.exit("thin_link.py: no spokes came")
    missing = came[-1][1] - came[0][1] + 1 - len(came)
    ages = sorted(spoke[5] for spoke in came)
    turns = (came[-1][1] - came[0][1]) / came[0][3]
    print(f"link {args.rate} kbit/s: level {hop.get('thin', 0)}, {came[0][3]} spokes of {came[0][4]} cells, "
          f"{hop['bytes_per_second'] * 8e-3:.0f} kbit/s used, {turns:.1f} turns in {args.seconds} s, {missing} spokes missing, "
          f"age {1e3 * ages[len(ages) // 2]:.0f} ms, at most {1e3 * ages[-1]:.0f} ms, round trip {hop.get('round_trip_ms', 0):.0f} ms")
    if missing or ages[-1] > 2.0 or turns < 0.3 * args.seconds:
        sys.exit("thin_link.py: no usable picture")


if __name__ == "__main__":
    main()
