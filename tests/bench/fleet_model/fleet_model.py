#!/usr/bin/env python3
"""A fleet of hosts and its lookers on paper: what each pays, how late it sees, and what is full first.

Examples:
  fleet_model.py                             10, 100 and 1000 hosts, 1e3 to 1e6 lookers
  fleet_model.py --hosts 40 --ships 60 --lookers 20000 --kind ws --gbit 25
  fleet_model.py --hosts 40 --ships 60 --lookers 20000 --simulate --seed 3
  fleet_model.py --ships 1 --lookers 100000 --needed    how many hosts that takes
  fleet_model.py --set use_limit=0.5 --set hop_ms=2     with other constants
  fleet_model.py --constants                 the table of constants, with units and sources
  fleet_model.py --check                     the model beside the measurements
  fleet_model.py --svg cost.svg              CPU for a looker against lookers

Formulas, results, and what is left out: server/fleet/MODEL.md. Exit code 1: a bound of the check is broken, or the hosts
do not serve the lookers.
"""
import argparse
import contextlib
import dataclasses
import io
import sys

import chart
import check
import constants
import shape
import simulate
from shape import Fleet

HOSTS, LOOKERS = [10, 100, 1000], [1_000, 10_000, 100_000, 1_000_000]
SHIPS_A_HOST = 2
STREAMS = [("native", False), ("ws", False), ("wss", False), ("wss", True)]
ALL = 10**9  # lookers; more than any fleet serves


def stream_name(kind, thin):
    return kind + (", thin" if thin else "")


def duration(seconds):
    if seconds is None:
        return "never"
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.0f} h"


def row(*cells):
    print(f"| {' | '.join(str(cell) for cell in cells)} |")


def head(*cells):
    row(*cells)
    print("|" + "---|" * len(cells))


def overview(c, fleet):
    """Where each fleet ends, what each looker costs, and what the log and the world carry."""
    fleets = [dataclasses.replace(fleet, hosts=hosts, ships=SHIPS_A_HOST * hosts, kind=kind, thin=thin)
              for hosts in HOSTS for kind, thin in STREAMS]
    head("hosts", "own ships", "stream", "hosts with ships", "fan-out, hops", "lookers at most", "full first",
         "last sector, ms", "store, ms/s")
    for f in fleets:
        p = shape.plan(c, dataclasses.replace(f, lookers=ALL))
        rest = ([p["problem"]] if "problem" in p else
                [p["origins"], f"{p['tree'].fan_out}, {p['hops']}", f"{p['most']:,}", p["tree"].full, f"{p['last_ms']:.0f}",
                 f"{p['log']['ms']:.0f}"])
        row(f.hosts, f.ships, stream_name(f.kind, f.thin), *rest)
    print("\nHosts that are needed of these; for each looker CPU ms/s, with radars and worlds, and MB/s; -: more than fit\n")
    head("hosts", "stream", *[f"{n:,}" for n in LOOKERS])
    for f in fleets:
        cells = []
        for lookers in LOOKERS:
            p = shape.plan(c, dataclasses.replace(f, lookers=lookers))
            fits = "problem" not in p and p["most"] >= lookers
            cells.append(f"{p['hosts']}; {p['looker_all_ms']:.2f}, {p['looker_mb']:.2f}" if fits else "-")
        row(f.hosts, stream_name(f.kind, f.thin), *cells)
    print()
    head("own ships", "orders/s", "log, MB an hour", "etcd's 2 GB full after", f"joining after {fleet.hours:g} h")
    for hosts in HOSTS:
        f = dataclasses.replace(fleet, hosts=hosts, ships=SHIPS_A_HOST * hosts)
        log = shape.log_use(c, f.ships, hosts, f.hours)
        row(f.ships, f"{log['orders_per_s']:.1f}", f"{log['mb_per_hour']:.1f}", duration(3600 * log["hours_to_quota"]),
            duration(shape.catch_up_s(c, f.ships, f.targets, f.hours)))
    print()
    head("shared by all of an exercise", "own ships at most")
    for name, most in shape.ship_limits(c, dataclasses.replace(fleet, hosts=1, ships=SHIPS_A_HOST)):
        row(name, f"{most:,.0f}")


def overview_lines(c, fleet):
    with contextlib.redirect_stdout(io.StringIO()) as text:
        overview(c, fleet)
    return [line for line in text.getvalue().split("\n") if line.startswith("|")]


def describe(c, f):
    """One fleet in full; whether it serves all lookers."""
    p = shape.plan(c, f)
    if "problem" in p:
        print(f"No plan: {p['problem']}.")
        return False
    t, log = p["tree"], p["log"]
    most_by = ", ".join(f"{name} {max(0, most) * p['origins']:,.0f}" for name, most in t.most_by.items())
    parts = ", ".join(f"{name} {ms:.0f}" for name, ms in log["parts"].items())
    print(f"{f.hosts} hosts of {f.cores} cores and {f.gbit:g} Gbit/s, {f.ships} own ships, {f.lookers:,} lookers by "
          f"{stream_name(f.kind, f.thin)}\n")
    print(f"hosts     {p['hosts']} are used: {p['origins']} with {p['ships']} own ships, behind each of these {t.hosts - 1} "
          f"with {t.processes} relays")
    print(f"tree      a host feeds {t.fan_out}; {p['hops']} relays one after another; each takes {t.inflow_mb:.1f} MB/s")
    print(f"lookers   these hosts serve {p['most']:,}: {t.full} ({most_by})")
    print(f"in use    network threads {100 * p['net_use']:.0f} %, links {100 * p['link_use']:.0f} %, "
          f"memory {p['memory_mb']:.0f} MB a host")
    print(f"a looker  {p['looker_ms']:.2f} ms/s of CPU, {p['looker_all_ms']:.2f} with radars and worlds; "
          f"{p['looker_mb']:.2f} MB/s")
    print(f"delay     a hop {p['hop_ms']:.1f} ms; antenna to looker {p['picture_ms']:.0f} ms, to the last "
          f"{p['last_ms']:.0f}; an order holds after {p['order_ms']:.0f}")
    print(f"log       {log['orders_per_s']:.1f} orders/s; store {log['ms']:.0f} of {shape.store_limit_ms(c):.0f} ms/s "
          f"({parts})")
    print(f"          {log['mb_per_hour']:.1f} MB an hour, {log['mb']:.0f} in {f.hours:g} h; a grant is everywhere after "
          f"{log['watch_ms']:.0f} ms; a host joins in {duration(p['catch_up_s'])}")
    if f.lookers > p["most"]:
        print(f"\n{f.lookers - p['most']:,} lookers too many.")
    return f.lookers <= p["most"]


def percentiles(values, scale, *shares):
    return ", ".join(f"p{100 * share:g} {scale * simulate.of(values, share):.1f}" for share in shares)


def simulate_log(c, f, p, seed):
    parts = p["log"]["parts"]
    other = (parts["idle"] + parts["watches"] + parts["names"]) / (3000 * c.cores_of_store)
    outage = [(30.0, 30.0 + c.outage_s)]
    for what, outages in [("60 s of orders", []), ("the same, the store's leader killed", outage)]:
        r = simulate.orders(c, p["origins"], f.ships, 60.0, seed, other, outages)
        print(f"{what}: acknowledged after {percentiles(r['acknowledged'], 1000, 0.5, 0.99)} ms, "
              f"in force after {percentiles(r['in_force'], 1000, 0.5, 0.99)} ms;\n"
              f"    {r['attempts'] / max(1, r['orders']):.2f} attempts for each; {r['refused']} of {r['orders']} refused; "
              f"hosts ran free {len(r['free'])} times, {sum(r['free']):.2f} s")


def simulate_tree(c, p, seed):
    late = simulate.pictures(c, p["hops"] + 1, [p["feed_ms"]] * p["hops"] + [p["send_ms"]], seed=seed)
    print(f"the last looker has a sector, after the radar made it: {percentiles(late, 1, 0.5, 0.99, 0.999)} ms")


def simulate_herd(c, f, p, seed):
    t, senders, use = p["tree"], p["senders"], min(0.99, p["net_use"])
    cases = [("a process is gone", 1, senders - 1, use, 0.0, p["each"]),
             ("a host is gone", t.processes, senders - t.processes, use, c.silence_s, p["each"]),
             ("a process is started again, all call it", 1, 1, 0.0, 0.0, 0)]
    for what, gone, others, before, detected, of_each in cases:
        crowd = round(p["each"] * gone)
        if others < 1 or crowd < 1:
            continue
        r = simulate.herd(c, crowd, others, before, f.kind, f.thin, seed, detected, f.connections, of_each)
        threads = f"busiest thread {100 * r['busiest_before']:.0f} %, then {100 * max(r['loads']):.0f}"
        print(f"{what}: {crowd} lookers have pictures again after {percentiles(r['seen'], 1, 0.5, 1)} s, {r['left']} "
              f"never;\n    {r['failed']} attempts failed; the longest wait in a server is {r['backlog_s']:.2f} s"
              f"{', others lose spokes' if r['lost'] else ''}; {threads}")
    if p["hops"]:
        radars, children = p["ships"] * f.radars, t.fan_out + t.processes - 1
        dark = simulate.relay_returns(c, 2.0, children, radars, f.kind == "wss")
        print(f"a relay that feeds others is started again in 2 s: all below it have pictures again after {dark:.1f} s")


def svg(c, fleet, path):
    series = {}
    for kind, thin in STREAMS:
        line = series.setdefault(stream_name(kind, thin), [])
        for lookers in [10 ** (e / 2) for e in range(6, 13)]:
            p = shape.plan(c, dataclasses.replace(fleet, hosts=10_000, lookers=int(lookers), kind=kind, thin=thin))
            if "problem" not in p and p["most"] >= int(lookers):
                line.append((lookers, p["looker_all_ms"]))
    with open(path, "w", encoding="utf-8") as out:
        title = f"CPU of all hosts for a looker, {fleet.ships} own ships"
        out.write(chart.curves(title, "lookers", "ms/s a looker", series))


TOLD = {"hosts": "hosts in all", "ships": "own ships", "lookers": "consoles, of one radar each", "radars": "of each ship",
        "cores": "of each host", "gbit": "of each host's link", "memory_gb": "of each host",
        "connections": "max_connections of each process", "targets": "of the exercise", "hours": "of the exercise"}


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, text in TOLD.items():
        value = getattr(Fleet(), name)
        parser.add_argument("--" + name.replace("_", "-"), type=type(value), help=f"{text} ({value:g})")
    parser.add_argument("--kind", choices=shape.KINDS, help="of lookers: native TCP, WebSocket, WebSocket by TLS (wss)")
    parser.add_argument("--thin", action="store_const", const=True,
                        help="720 x 512 x 4 bits for each looker, which no console is offered yet")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="another value of a constant")
    parser.add_argument("--seed", type=int, default=1, help="of the simulations (1)")
    for name, text in [("simulate", "simulations beside the formulas"), ("needed", "the fewest hosts for the lookers"),
                       ("check", "the model beside the measurements"), ("constants", "the table of constants")]:
        parser.add_argument("--" + name, action="store_true", help=text)
    parser.add_argument("--svg", metavar="FILE", help="curves of CPU for a looker against lookers")
    told = parser.parse_args()
    try:
        c = constants.Constants({name: float(value) for name, _, value in (pair.partition("=") for pair in told.set)})
    except (KeyError, ValueError) as error:
        parser.error(f"--set: {error.args[0]}; expected NAME=VALUE, as in use_limit=0.5; --constants lists the names")
    given = {field.name: getattr(told, field.name) for field in dataclasses.fields(Fleet)}
    fleet = Fleet(**{name: value for name, value in given.items() if value is not None})
    for name in TOLD:
        if getattr(fleet, name) < (0 if name == "targets" else 1e-6) or getattr(fleet, name) > 1e9:
            parser.error(f"--{name.replace('_', '-')} {getattr(fleet, name)}: expected more than 0, and at most 1e9")
    return told, c, fleet, any(value is not None for value in given.values())


def main():
    told, c, fleet, one_fleet = options()
    if told.constants:
        head("constant", "value", "unit", "how", "source")
        print("\n".join(check.page_rows()))
    elif told.check:
        good = check.run(c, told.seed)
        if not told.set and not one_fleet:
            good = check.page_has("results", overview_lines(c, fleet)) and good
        sys.exit(0 if good else 1)
    elif told.svg:
        svg(c, fleet, told.svg)
    elif told.simulate or told.needed or one_fleet:
        if told.needed:
            hosts = shape.needed_hosts(c, fleet)
            if hosts is None:
                sys.exit("fleet_model.py: no number of hosts up to 1,000,000 serves that")
            fleet = dataclasses.replace(fleet, hosts=hosts)
        served = describe(c, fleet)
        p = shape.plan(c, fleet)
        if told.simulate and "problem" not in p:
            print(f"\nSimulated, seed {told.seed}\n")
            simulate_log(c, fleet, p, told.seed)
            simulate_tree(c, p, told.seed)
            simulate_herd(c, fleet, p, told.seed)
        sys.exit(0 if served else 1)
    else:
        overview(c, fleet)


if __name__ == "__main__":
    main()
