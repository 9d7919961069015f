#!/usr/bin/env python3
"""A storm of sign-ins by password while radars turn: what the radars and the other clients notice of it.

Usage, as root: login_storm.py SKERRYD SKERRY [--rate 100] [--seconds 20] [--hosts 250]

Runs in a network namespace of its own, where one host has the addresses of many. Half of the passwords are right.
Prints a table: without and with the storm, spokes that were late, sectors that were never made, the greatest lateness,
and how long a page takes meanwhile. Exit code 1 if a sector was skipped in the storm and none without it.
"""
import argparse
import http.client
import json
import os
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

SERVER = "10.99.0.1"
PASSWORD = "correct horse"


def in_namespace():
    if os.environ.get("LOGIN_STORM") == "1":
        return
    os.environ["LOGIN_STORM"] = "1"
    os.execvp("unshare", ["unshare", "--net", sys.executable, *sys.argv])


def add_addresses():
    for command in (["link", "set", "lo", "up"], ["addr", "add", f"{SERVER}/16", "dev", "lo"],
                    ["route", "add", "local", "10.99.0.0/16", "dev", "lo"]):
        done = subprocess.run(["ip", *command], capture_output=True, text=True)
        if done.returncode != 0 and "File exists" not in done.stderr:
            sys.exit(f"login_storm.py: ip {' '.join(command)}: {done.stderr.strip()}")


def ask(port, method, path, body=None, token=None, host=None):
    source = (host, 0) if host else None
    link = http.client.HTTPConnection(SERVER, port, timeout=30, source_address=source)
    headers = {"Connection": "close"} | ({"Authorization": f"Bearer {token}"} if token else {})
    try:
        link.request(method, path, body=body, headers=headers)
        answer = link.getresponse()
        return answer.status, answer.read()
    finally:
        link.close()


class Server:
    def __init__(self, skerryd, skerry, folder):
        users, tokens = os.path.join(folder, "users.yaml"), os.path.join(folder, "tokens.yaml")
        subprocess.run([skerry, "user", "add", "Anna", "--users", users], input=PASSWORD + "\n", text=True, check=True,
                       stderr=subprocess.DEVNULL)
        self.token = subprocess.run([skerry, "token", "new", "admin", "--role", "admin", "--tokens", tokens], text=True,
                                    check=True, capture_output=True).stdout.strip()
        self.child = subprocess.Popen(
            [skerryd, "--insecure", "--bind", SERVER, "--users", users, "--tokens", tokens, "--tcp-port", "0", "--http-port", "0",
             "--no-udp", "--no-cat240", "--print-ports"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in self.child.stdout:
            words = line.split()
            if "http" in words:
                self.port = int(words[words.index("http") + 1])
                return
        sys.exit("login_storm.py: skerryd ended before it was ready")

    def status(self):
        return json.loads(ask(self.port, "GET", "/status", token=self.token)[1])

    def end(self):
        self.child.terminate()
        self.child.wait()


def radars(before, after):
    late = sum(int(b["spokes_late"]) - int(a["spokes_late"]) for a, b in zip(before["radars"], after["radars"]))
    made = sum(int(b["spokes"]) - int(a["spokes"]) for a, b in zip(before["radars"], after["radars"]))
    skipped = sum(int(b["sectors_skipped"]) - int(a["sectors_skipped"])
                  for a, b in zip(before["radars"], after["radars"]))
    return made, late, skipped


def measure(server, options, storm):
    counts, pages, stop = Counter(), [], threading.Event()

    def look():
        while not stop.is_set():
            begun = time.monotonic()
            ask(server.port, "GET", "/controls.json")
            pages.append(1000 * (time.monotonic() - begun))
            time.sleep(0.05)

    def sign_in(i):
        right = i % 2 == 0
        body = json.dumps({"name": "Anna", "password": PASSWORD if right else "a guess, a guess"})
        host = f"10.99.1.{1 + i % options.hosts}"
        try:
            counts[ask(server.port, "POST", "/login", body, host=host)[0]] += 1
        except OSError as error:
            counts[type(error).__name__] += 1

    before = server.status()
    looker = threading.Thread(target=look)
    looker.start()
    begun = time.monotonic()
    with ThreadPoolExecutor(128) as pool:
        for i in range(int(options.rate * options.seconds)):
            time.sleep(max(0.0, begun + i / options.rate - time.monotonic()))
            if storm:
                pool.submit(sign_in, i)
    stop.set()
    looker.join()
    made, late, skipped = radars(before, server.status())
    pages.sort()
    p99 = pages[int(0.99 * (len(pages) - 1))]
    print(f"| {'storm' if storm else 'none'} | {made} | {late} | {skipped} | {pages[len(pages) // 2]:.1f}, {p99:.1f} | "
          f"{', '.join(f'{number} x {kind}' for kind, number in sorted(counts.items(), key=str)) or '-'} |")
    return skipped


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("skerryd")
    parser.add_argument("skerry")
    parser.add_argument("--rate", type=float, default=100.0, help="sign-ins a second")
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--hosts", type=int, default=250, choices=range(1, 255), metavar="1..254")
    options = parser.parse_args()
    in_namespace()
    add_addresses()
    with tempfile.TemporaryDirectory() as folder:
        server = Server(options.skerryd, options.skerry, folder)
        try:
            time.sleep(3)  # the first turn
            print(f"{options.rate:g} sign-ins a second from {options.hosts} hosts, {options.seconds:g} s, "
                  f"{len(server.status()['radars'])} radars")
            print("| sign-ins | spokes | late | sectors skipped | page p50, p99 ms | answers |")
            print("|---|---|---|---|---|---|")
            quiet = measure(server, options, False)
            stormy = measure(server, options, True)
        finally:
            server.end()
    sys.exit(1 if stormy > 0 and quiet == 0 else 0)


if __name__ == "__main__":
    main()
