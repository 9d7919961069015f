#!/usr/bin/env python3
"""Runs one exercise on several hosts over an etcd of three members, kills and stops them, and checks what consoles see.

Usage: fleet_exercise.py SKERRYD PYTHON [--hosts N] [--ships N] [--seconds N] [--blows N] [--seed N] [--most-gap SECONDS] [--apart]
                         [--order-pause SECONDS] [--keep]
  PYTHON   the folder of the package skerry (build/release/python)
  --blows  SIGKILL and SIGSTOP of hosts and of members of the etcd, one after the other, each healed before the next
  --apart  each in a network namespace of its own, as root; then blows cut the network too
Example: fleet_exercise.py build/release/bin/skerryd build/release/python --blows 20 --seconds 200

All on loopback, with ports that nobody had, or in a network of the script's own. A console for each ship follows her from host to host by what hosts say of
the fleet; an observer at each host sees all radars there; an instructor gives orders at hosts by turns. Exit code 1
if an order that was acknowledged is missing or any is there twice, hosts have their orders in other sequence, hosts'
worlds differ or are never compared, a spoke comes from two hosts, an order that was refused holds, a host ends with
another code than 0 or does not follow within 120 s of a blow, or a console sees no spoke for more than --most-gap
(5 s). 77: no etcd, or --apart without root.
"""
import argparse
import collections
import os
import pathlib
import random
import shutil
import signal
import sys
import tempfile
import threading
import time

from fleet_hosts import Failed, Fleet


class Watch:
    """What consoles see; all threads add to it."""

    def __init__(self):
        self.lock = threading.Lock()
        self.over = threading.Event()
        self.seen = collections.defaultdict(dict)      # radar -> (scan, index) -> host
        self.twice = []
        self.arrivals = collections.defaultdict(list)  # radar -> when a console had a spoke
        self.digests = collections.defaultdict(dict)   # tick -> host -> digest
        self.marks = set()                             # of all orders that any host has shown
        self.acknowledged, self.unknown, self.refused, self.latencies = [], [], [], []

    def spoke(self, radar, scan, index, host):
        with self.lock:
            before = self.seen[radar].setdefault((scan, index), host)
            if before != host:
                self.twice.append((radar, scan, index, before, host))

    def fleet(self, fleet):
        with self.lock:
            for host in fleet.hosts:
                if host.tick:
                    self.digests[host.tick][host.name] = host.digest


def connect(skerry, place):
    return skerry.live.Connection(place[0], place[1], timeout_s=1.0, token=Fleet.TOKEN)


def observe(skerry, watch, place, radar):
    """All spokes of a radar at one host, for as long as it is there."""
    while not watch.over.is_set():
        try:
            with connect(skerry, place) as connection:
                host = connection.hello.fleet.host
                connection.request(subscribe=dict(radar=radar, view=0))
                for message in connection.messages():
                    if watch.over.is_set():
                        return
                    kind = message.WhichOneof("kind")
                    if kind == "spoke":
                        watch.spoke(radar, message.spoke.scan, message.spoke.index, host)
                    elif kind == "fleet":
                        watch.fleet(message.fleet)
        except (OSError, ConnectionError, skerry.Refused):
            time.sleep(0.1)


def follow(skerry, watch, places, radar):
    """A console: at the host that the fleet says, and at the next one that answers where it is silent."""
    at = places[0]
    while not watch.over.is_set():
        try:
            with connect(skerry, at) as connection:
                fleet = connection.hello.fleet
                home = [host.native for host in fleet.hosts if radar in host.radars and host.native]
                if home and home[0] != f"{at[0]}:{at[1]}":
                    name, port = home[0].rsplit(":", 1)
                    if (name, int(port)) in places:
                        with connect(skerry, (name, int(port))):
                            pass
                        at = (name, int(port))
                        continue
                connection.request(subscribe=dict(radar=radar, view=0))
                quiet = time.monotonic()
                for message in connection.messages():
                    now = time.monotonic()
                    if watch.over.is_set():
                        return
                    kind = message.WhichOneof("kind")
                    if kind == "spoke":
                        quiet = now
                        watch.arrivals[radar].append(now)
                    if kind == "fleet" and radar not in next((h.radars for h in message.fleet.hosts if h.name == fleet.host), []):
                        break
                    if now - quiet > 1.0:
                        break
        except (OSError, ConnectionError, skerry.Refused):
            pass
        at = places[(places.index(at) + 1) % len(places)]
        time.sleep(0.05)


def instruct(skerry, watch, places, pause):
    """Marks, each with its own text, at one host after another; what was not answered is not given again."""
    number = 0
    connections = {}
    while not watch.over.is_set():
        place = places[number % len(places)]
        text = f"order {number}"
        number += 1
        began = time.monotonic()
        try:
            if place not in connections:
                connections[place] = connect(skerry, place)
                connections[place]._socket.settimeout(8.0)
            try:
                connections[place].request(set=dict(radar=0, instructor=True, exercise=dict(mark=text)))
                watch.acknowledged.append(text)
                watch.latencies.append(time.monotonic() - began)
            except skerry.Refused as refused:
                (watch.unknown if "not known" in str(refused) else watch.refused).append(text)
        except (OSError, ConnectionError):
            if place in connections:
                connections.pop(place).close()
                watch.unknown.append(text)
        watch.over.wait(pause)


def strike(random_, fleet, number):
    """One blow, and how it is healed; what was done."""
    kinds = ["kill host", "kill host", "stop host", "kill member", "stop member", "kill both", "kill store"]
    if fleet.network.apart:
        kinds += ["cut host", "cut host", "cut member", "cut both"]
    kind = random_.choice(kinds)
    host, member = random_.choice(fleet.hosts), random_.choice(fleet.etcd)
    struck = {"host": [host], "member": [member], "both": [host, member], "store": fleet.etcd}[kind.split()[1]]
    for each in struck:
        if kind.startswith("stop"):
            each.signal(signal.SIGSTOP)
        elif kind.startswith("cut"):
            fleet.network.cut(each.name.split()[1])
        else:
            each.kill()
    rest = random_.uniform(0.5, 4.0)
    print(f"{number}: {kind} ({', '.join(each.name for each in struck)}), healed after {rest:.1f} s", flush=True)
    time.sleep(rest)
    for each in struck:
        if kind.startswith("stop"):
            each.signal(signal.SIGCONT)
        elif kind.startswith("cut"):
            fleet.network.mend(each.name.split()[1])
        else:
            each.start()
    return kind


def await_all(skerry, fleet, ships, timeout=120):
    """Until every host follows and every ship is somebody's."""
    until = time.monotonic() + timeout
    why = ""
    while time.monotonic() < until:
        try:
            for place in fleet.places():
                with connect(skerry, place) as connection:
                    told = connection.hello.fleet
                    held = sorted(radar for host in told.hosts for radar in host.radars)
                    if told.standing != "following" or held != list(range(ships)) or len(told.hosts) != len(fleet.hosts):
                        why = f"{told.host}: {told.standing}, {told.refusal or told.problem or 'no problem'}, radars {held}, {len(told.hosts)} hosts"
                        raise ConnectionError
            return
        except (OSError, ConnectionError, skerry.Refused):
            time.sleep(0.2)
    raise Failed(f"after {timeout} s not all hosts run the exercise: {why or 'one does not answer'}")


def marks_of(skerry, place):
    with connect(skerry, place) as connection:
        connection.request(subscribe=dict(radar=0, view=0, no_spokes=True, exercise_hz=1))
        for message in connection.messages():
            if message.WhichOneof("kind") == "exercise":
                return [mark.text for mark in message.exercise.marks if mark.text.startswith("order ")]
    return []


def gather(skerry, watch, place):
    """Marks as they are told; an ExerciseState has the newest 100."""
    while not watch.over.is_set():
        try:
            with connect(skerry, place) as connection:
                connection.request(subscribe=dict(radar=0, view=0, no_spokes=True, exercise_hz=1))
                for message in connection.messages():
                    if watch.over.is_set():
                        return
                    if message.WhichOneof("kind") == "exercise":
                        watch.marks.update(mark.text for mark in message.exercise.marks)
        except (OSError, ConnectionError, skerry.Refused):
            time.sleep(0.1)


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("skerryd")
    parser.add_argument("python")
    for name, value in (("hosts", 3), ("ships", 3), ("seconds", 20), ("blows", 2), ("seed", 1)):
        parser.add_argument(f"--{name}", type=int, default=value)
    parser.add_argument("--most-gap", type=float, default=5.0)
    parser.add_argument("--order-pause", type=float, default=0.15)
    parser.add_argument("--apart", action="store_true")
    parser.add_argument("--keep", action="store_true", help="keep logs and say where")
    arguments = parser.parse_args()
    if shutil.which("etcd") is None:
        print("etcd is not installed; server/install-packages tests/packages.txt")
        sys.exit(77)
    if arguments.apart and "FLEET_APART" not in os.environ:
        if os.geteuid() != 0:
            print("--apart needs root, for network namespaces")
            sys.exit(77)
        os.environ["FLEET_APART"] = "1"
        os.execvp("unshare", ["unshare", "--net", sys.executable, "-B", *sys.argv])
    sys.path.insert(0, arguments.python)
    import skerry
    import skerry.live
    folder = tempfile.mkdtemp(prefix="fleet-")
    fleet, watch = Fleet(arguments, folder), Watch()
    wrong = []
    try:
        fleet.start()
        await_all(skerry, fleet, arguments.ships)
        threads = [threading.Thread(target=observe, args=(skerry, watch, place, radar), daemon=True)
                   for place in fleet.places() for radar in range(arguments.ships)]
        threads += [threading.Thread(target=follow, args=(skerry, watch, fleet.places(), radar), daemon=True)
                    for radar in range(arguments.ships)]
        threads += [threading.Thread(target=gather, args=(skerry, watch, place), daemon=True) for place in fleet.places()]
        threads.append(threading.Thread(target=instruct, args=(skerry, watch, fleet.places(), arguments.order_pause), daemon=True))
        for thread in threads:
            thread.start()
        random_, began = random.Random(arguments.seed), time.monotonic()
        blows, struck = collections.Counter(), []
        for number in range(arguments.blows):
            time.sleep(random_.uniform(0.5, 2.0))
            struck.append(time.monotonic())
            blows[strike(random_, fleet, number)] += 1
            await_all(skerry, fleet, arguments.ships)
        time.sleep(max(2.0, arguments.seconds - (time.monotonic() - began)))
        watch.over.set()
        for thread in threads:
            thread.join(10)
        await_all(skerry, fleet, arguments.ships)
        marks = {place: marks_of(skerry, place) for place in fleet.places()}
        first = next(iter(marks.values()))
        for place, texts in marks.items():
            oldest = texts[0] if len(texts) >= 90 else None
            newest = watch.acknowledged[watch.acknowledged.index(oldest) if oldest in watch.acknowledged else -50:]
            missing = [text for text in newest if text not in texts]
            if missing:
                wrong.append(f"{place} lacks acknowledged orders: {missing[:5]}")
            watch.marks.update(texts)
            if len(set(texts)) != len(texts):
                wrong.append(f"{place} has orders twice")
            if texts != first:
                wrong.append(f"{place} has its orders in another sequence")
        missing = [text for text in watch.acknowledged if text not in watch.marks]
        if missing:
            wrong.append(f"acknowledged orders were never shown: {missing[:5]}")
        there = [text for text in watch.refused if text in watch.marks]
        if there:
            wrong.append(f"refused orders hold: {there[:5]}")
        compared = sum(len(of) > 1 for of in watch.digests.values())
        for tick, of in watch.digests.items():
            if len(set(of.values())) > 1:
                wrong.append(f"worlds differ after tick {tick}: {dict(of)}")
        if compared == 0:
            wrong.append("no two hosts told of their worlds at one tick")
        if watch.twice:
            wrong.append(f"radars turned on two hosts at once: {len(watch.twice)} spokes, {watch.twice[:3]}")
        gaps = []
        for radar in range(arguments.ships):
            times = watch.arrivals[radar]
            longest = [after - before for before, after in zip(times, times[1:]) if after - before > 0.5]
            gaps += longest
            for before, after in zip(times, times[1:]):
                if after - before > 3.0:
                    blow = sum(when < before + 0.5 for when in struck) - 1
                    print(f"radar {radar}: nothing for {after - before:.2f} s, after blow {blow}")
            if not times or max(longest, default=0) > arguments.most_gap:
                wrong.append(f"the console of radar {radar} saw nothing for {max(longest, default=float('inf')):.1f} s")
        codes = fleet.end()
        # Hosts compare their worlds each second.
        for log in sorted(pathlib.Path(folder).glob("h*.log")):
            torn = [line for line in log.read_text(errors="replace").splitlines() if "[error] fleet:" in line]
            if torn:
                wrong.append(f"{log.name}: {torn[0]}")
        if any(codes):
            wrong.append(f"hosts ended with {codes}")
        print(f"blows: {dict(blows)}; orders: {len(watch.acknowledged)} acknowledged, {len(watch.refused)} refused, "
              f"{len(watch.unknown)} not known; answered in p50 {1e3 * quantile(watch.latencies, .5):.0f} ms, "
              f"p99 {1e3 * quantile(watch.latencies, .99):.0f} ms")
        print(f"worlds compared at {compared} ticks; spokes seen: {sum(map(len, watch.seen.values()))}, on two hosts {len(watch.twice)}")
        print(f"pictures missed for more than .5 s: {len(gaps)}; p50 {quantile(gaps, .5):.2f} s, p90 {quantile(gaps, .9):.2f} s, "
              f"longest {max(gaps, default=0):.2f} s")
    except Failed as failed:
        wrong.append(str(failed))
    finally:
        fleet.end()
        if wrong or arguments.keep:
            print(f"logs are in {folder}")
            for log in sorted(pathlib.Path(folder).glob("h*.log")):
                print(f"-- {log.name}\n" + "\n".join(log.read_text(errors="replace").splitlines()[-15:]))
        else:
            shutil.rmtree(folder, ignore_errors=True)
    for text in wrong:
        print("WRONG:", text)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
