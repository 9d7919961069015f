#!/usr/bin/env python3
"""Lists what a server with TLS offers, by asking with openssl s_client for each protocol, cipher, group and habit.

Usage, as root: tls_offers.py SKERRYD SKERRY   Exit code 1 if it offers more or less than it should, 77 without root.

Runs in a network namespace of its own: each question comes from another address, as a peer may begin only so many
handshakes a minute. Both ports are asked, HTTPS and the native protocol's. The certificate is that of `skerry tls init`
(ECDSA, P-256), so of TLS 1.2 the three ciphers by ECDSA are left. What is expected is what server/net/common/tls_keys.hpp says.
"""
import itertools
import os
import re
import subprocess
import sys
import tempfile
import threading

SERVER = "10.99.0.1"
PROTOCOLS = {"tls1": False, "tls1_1": False, "tls1_2": True, "tls1_3": True}
CIPHERS = {"ECDHE-ECDSA-AES128-GCM-SHA256", "ECDHE-ECDSA-AES256-GCM-SHA384", "ECDHE-ECDSA-CHACHA20-POLY1305"}
SUITES = {"TLS_AES_128_GCM_SHA256", "TLS_AES_256_GCM_SHA384", "TLS_CHACHA20_POLY1305_SHA256"}
ALL_SUITES = SUITES | {"TLS_AES_128_CCM_SHA256", "TLS_AES_128_CCM_8_SHA256"}
GROUPS = {"X25519": True, "P-256": True, "P-384": True, "P-521": False, "X448": False, "ffdhe2048": False}
WEAK = ["-cipher", "ALL:COMPLEMENTOFALL:@SECLEVEL=0"]  # a client that takes anything
NEXT_PEER = itertools.count(1)


def in_namespace():
    if os.environ.get("TLS_OFFERS") != "1":
        if os.geteuid() != 0:
            print("tls_offers.py: it needs root, for a network namespace")
            sys.exit(77)
        os.environ["TLS_OFFERS"] = "1"
        os.execvp("unshare", ["unshare", "--net", sys.executable, *sys.argv])
    for command in (["link", "set", "lo", "up"], ["addr", "add", f"{SERVER}/16", "dev", "lo"],
                    ["route", "add", "local", "10.99.0.0/16", "dev", "lo"]):
        done = subprocess.run(["ip", *command], capture_output=True, text=True, check=False)
        if done.returncode != 0 and "File exists" not in done.stderr:
            sys.exit(f"tls_offers.py: ip {' '.join(command)}: {done.stderr.strip()}")


def s_client(port, *options):
    peer = next(NEXT_PEER)
    return ["openssl", "s_client", "-bind", f"10.99.{1 + peer // 250}.{1 + peer % 250}:0", "-connect", f"{SERVER}:{port}", *options]


def ask(port, *options):
    """The cipher agreed on, or nothing."""
    run = subprocess.run(s_client(port, *options), stdin=subprocess.DEVNULL, capture_output=True, timeout=60, check=False)
    text = (run.stdout + run.stderr).decode(errors="replace")
    agreed = re.search(r"^New, (\S+), Cipher is (\S+)", text, re.MULTILINE)
    is_agreed = agreed is not None and agreed.group(2) != "(NONE)" and "Verify return code" in text
    return agreed.group(2) if is_agreed else None


def renegotiates(port):
    """At a line "R" s_client asks for another handshake; where it is refused one, it ends and says so."""
    with subprocess.Popen(s_client(port, "-tls1_2"), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT) as asking:
        for line in asking.stdout:
            if b"Extended master secret" in line:  # the last of what it tells of the first handshake
                break
        asking.stdin.write(b"R\n")
        asking.stdin.flush()
        killer = threading.Timer(60, asking.kill)
        killer.start()
        told = asking.stdout.read()
        killer.cancel()
    if b"RENEGOTIATING" not in told:
        sys.exit("tls_offers.py: s_client has not asked for another handshake")
    return b"no renegotiation" not in told


class Server:
    def __init__(self, skerryd, skerry, folder):
        tls = f"{folder}/tls"
        subprocess.run([skerry, "tls", "init", tls, "--name", SERVER], check=True, capture_output=True)
        self.child = subprocess.Popen([skerryd, "--bind", SERVER, "--tls", tls, "--insecure", "--tcp-port", "0", "--http-port", "0",
                                       "--no-udp", "--no-cat240", "--print-ports"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        words = self.child.stdout.readline().split()
        if len(words) != 4:
            sys.exit("tls_offers.py: skerryd ended before it was ready")
        self.ports = {"native": int(words[1]), "HTTPS": int(words[3])}

    def end(self):
        self.child.terminate()
        return self.child.wait()


class Table:
    def __init__(self, port_name):
        self.port_name, self.wrong = port_name, 0

    def row(self, kind, name, is_offered, is_wanted):
        self.wrong += is_offered != is_wanted
        print(f"{self.port_name:7} {kind:12} {name:34} {'offered' if is_offered else '-':8}"
              f"{'' if is_offered == is_wanted else '  WRONG'}")


def look(table, port):
    for protocol, is_wanted in PROTOCOLS.items():
        table.row("protocol", protocol, ask(port, f"-{protocol}", *WEAK) is not None, is_wanted)
    listed = subprocess.run(["openssl", "ciphers", "-tls1_2", "ALL:COMPLEMENTOFALL:@SECLEVEL=0"], check=True,
                            capture_output=True, text=True).stdout
    ciphers = sorted({cipher for cipher in listed.strip().split(":") if not cipher.startswith("TLS_")})
    offered = {cipher for cipher in ciphers
               if ask(port, "-tls1_2", "-cipher", f"{cipher}:@SECLEVEL=0") == cipher}
    for cipher in sorted(offered | CIPHERS):
        table.row("TLS 1.2", cipher, cipher in offered, cipher in CIPHERS)
    print(f"{table.port_name:7} {'TLS 1.2':12} {len(ciphers) - len(offered)} more ciphers were asked for: refused")
    for suite in sorted(ALL_SUITES):
        table.row("TLS 1.3", suite, ask(port, "-tls1_3", "-ciphersuites", suite) == suite, suite in SUITES)
    for group, is_wanted in GROUPS.items():
        table.row("group", group, ask(port, "-groups", group) is not None, is_wanted)
    table.row("habit", "renegotiation", renegotiates(port), False)


def main(programs):
    if len(programs) != 2:
        sys.exit(__doc__)
    in_namespace()
    with tempfile.TemporaryDirectory() as folder:
        server = Server(*programs, folder)
        wrong = 0
        try:
            for name, port in server.ports.items():
                table = Table(name)
                look(table, port)
                wrong += table.wrong
        finally:
            code = server.end()
    if code != 0:
        sys.exit(f"tls_offers.py: skerryd ended with {code}")
    if wrong:
        sys.exit(f"tls_offers.py: {wrong} of the above are not as they should be; server/net/common/tls_keys.cpp has the lists")


if __name__ == "__main__":
    main(sys.argv[1:])
