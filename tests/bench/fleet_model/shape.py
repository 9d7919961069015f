"""The closed formulas: ships on hosts, trees of relays, what each host, looker and the log pays, and what is full first.

Units: ms/s is CPU, thousandths of a core; MB/s of network. Formulas: server/fleet/MODEL.md.
"""
import math
from dataclasses import dataclass

KINDS = ["native", "ws", "wss"]


@dataclass(frozen=True)
class Fleet:
    hosts: int = 100
    ships: int = 200
    lookers: int = 10_000
    radars: int = 1        # of a ship
    kind: str = "wss"
    thin: bool = False     # 0.105 instead of 1.8 MB/s for each looker
    cores: int = 8
    gbit: float = 10.0
    memory_gb: float = 16.0
    connections: int = 4096  # max_connections of each process
    targets: int = 500
    hours: float = 8.0     # of the exercise


def looker_mb(c, thin):
    return c.thin_mb_per_s if thin else c.stream_mb_per_s


def looker_ms(c, kind, thin=False):
    """CPU of the sending thread for one looker: a write for each sector, and its bytes."""
    us = c.send_us_per_write if kind == "native" else c.ws_us_per_write
    by_mb = c.send_ms_per_mb + (c.wss_more_ms_per_mb if kind == "wss" else 0.0)
    return c.sectors_per_s * us / 1000 + looker_mb(c, thin) * by_mb


def radar_ms(c, targets_more=0):
    """CPU of a radar's own thread."""
    cells = c.spokes_per_s * c.cells_per_spoke
    ns = c.echo_ns_per_cell + targets_more * c.echo_ns_per_cell_target
    return cells * ns / 1e6 + c.sectors_per_s * c.sector_us / 1000


def world_ms(c, ships, targets):
    """CPU of the world's steps, on each host that has an own ship: every one of them makes the whole world."""
    return c.ticks_per_s * (ships * c.ship_us_per_tick + targets * c.target_us_per_tick) / 1000


def log_use(c, ships, watchers, hours):
    """What the log costs: CPU of all members of the store, and how it grows."""
    orders = ships * c.orders_per_ship_s
    grants = 1000 / c.renew_ms
    parts = {"idle": c.store_idle_ms, "grants": grants * c.store_grant_ms, "orders": orders * c.store_order_ms,
             "watches": (grants + orders) * watchers * c.store_event_us / 1000,
             "names": (ships + 1) * c.name_steps_per_s * c.store_name_ms}
    growth = 3600 * (grants * c.grant_log_bytes + orders * c.order_log_bytes) / 1e6
    return {"orders_per_s": orders, "ms": sum(parts.values()), "parts": parts, "mb_per_hour": growth,
            "mb": growth * hours, "hours_to_quota": c.log_quota_mb / growth,
            "watch_ms": c.watch_first_ms + watchers * c.watch_us_per_host / 1000}


def store_limit_ms(c):
    return 3 * c.cores_of_store * 1000 * c.use_limit


def catch_up_s(c, ships, targets, hours):
    """A host that joins by running all ticks since the beginning; None: never, as the world goes on as fast."""
    share = world_ms(c, ships, targets) / 1000
    if share >= 1:
        return None
    orders_mb = 3600 * hours * ships * c.orders_per_ship_s * c.order_log_bytes / 1e6
    return (orders_mb / c.log_read_mb_per_s + 3600 * hours * share) / (1 - share)


@dataclass
class Tree:
    """Of one host with own ships, its relays on other hosts, and their lookers."""
    hosts: int = 0
    processes: int = 0      # of a relay's host
    inflow_mb: float = 0.0  # all radars of the host with the ships: a relay takes them all
    fan_out: int = 0        # hosts that one feeds
    depth: int = 0          # hosts one after another behind the first
    most: int = 0           # lookers
    full: str = ""          # what holds `most`
    most_by: dict = None


def tree(c, f, ships, hosts):
    """With as many relays on a host as serve the most lookers, and no more."""
    if hosts == 1:
        return tree_of(c, f, ships, 1, 1)
    return max((tree_of(c, f, ships, hosts, n) for n in range(1, max(2, f.cores))), key=lambda t: (t.most, -t.processes))


def tree_of(c, f, ships, hosts, processes):
    t = Tree(hosts=hosts, processes=processes, inflow_mb=ships * f.radars * c.stream_mb_per_s, most_by={})
    core, link = 1000 * c.use_limit, f.gbit * 125 * c.use_limit
    child = ships * f.radars * looker_ms(c, "wss" if f.kind == "wss" else "native")  # relays by TLS where lookers use it
    own = core - ships * f.radars * c.net_ms_per_radar
    relays = hosts - 1
    if relays:
        head = core - (t.processes - 1) * child  # the process that feeds the others of its host, and other hosts
        t.fan_out = int(min(head / child, own / child, link / t.inflow_mb))
        if t.fan_out < 1:
            t.full = "link between hosts" if link < t.inflow_mb else "core of a feeding process"
            return t
        t.fan_out = min(t.fan_out, relays)
        reached = level = t.fan_out
        t.depth = 1
        while reached < relays:
            level *= t.fan_out
            reached += level if t.fan_out > 1 else 1
            t.depth += 1
    cpu = own + relays * t.processes * core - relays * t.processes * child
    network = hosts * link - relays * t.inflow_mb
    memory = hosts * f.memory_gb * 1000 * c.use_limit - hosts * c.memory_base_mb * t.processes
    t.most_by = {"network threads": cpu / looker_ms(c, f.kind, f.thin), "links": network / looker_mb(c, f.thin),
                 "memory": memory / c.memory_looker_mb,
                 "max_connections": (1 + relays * t.processes) * f.connections - relays * t.processes * ships * f.radars}
    t.full = min(t.most_by, key=t.most_by.get)
    t.most = max(0, int(t.most_by[t.full]))
    return t


def ships_per_host(c, f):
    """Own ships whose radars fit on the cores that the network thread and the world's steps leave."""
    cores = (f.cores - 1) * 1000 * c.use_limit - world_ms(c, f.ships, f.targets)
    by_cores = cores / (f.radars * radar_ms(c))
    by_memory = (f.memory_gb * 1000 * c.use_limit - c.memory_base_mb) / (f.radars * c.memory_radar_mb)
    return int(max(0, min(by_cores, by_memory, 1000 * c.use_limit / (f.radars * c.net_ms_per_radar))))


def plan(c, f):
    """How to use up to f.hosts: how many have own ships, and how many relays each of these has.

    Of the ways that serve all lookers the one with the least CPU; else the one that serves the most. A dict, or in it why
    there is none.
    """
    most_ships = ships_per_host(c, f)
    steps = world_ms(c, f.ships, f.targets)
    if steps > 1000 * c.use_limit:
        return {"problem": f"the world's steps take {steps / 10:.0f} % of the one core that can make them"}
    if most_ships < 1:
        return {"problem": f"of {f.cores} cores the network thread leaves none for a radar and the world's steps"}
    least = math.ceil(f.ships / most_ships)
    if least > f.hosts:
        return {"problem": f"{f.ships} own ships need {least} hosts"}
    best = full_store = None
    # For each size that a tree may have, as many trees as there are hosts for.
    for origins in sorted({max(least, min(f.ships, f.hosts // size)) for size in range(1, f.hosts // least + 1)}):
        log = log_use(c, f.ships, origins, f.hours)
        if log["ms"] > store_limit_ms(c):
            full_store = log
            break  # more watchers cost more
        ships = math.ceil(f.ships / origins)
        p = {"origins": origins, "ships": ships, "log": log}
        p["tree"] = smallest_tree(c, f, ships, f.hosts // origins, f.lookers / origins)
        p["most"] = p["tree"].most * origins
        p |= costs(c, f, p)
        fits = p["most"] >= f.lookers
        p["worth"] = (fits, -p["all_ms"] if fits else p["most"])
        if best is None or p["worth"] > best["worth"]:
            best = p
    if best is None:
        part = max(full_store["parts"], key=full_store["parts"].get)
        return {"problem": f"the store is full with {f.ships} own ships on {least} hosts: {part}", "log": full_store}
    if best["most"] == 0:
        return {"problem": f"no looker finds a place: {best['tree'].full}"}
    return best


def smallest_tree(c, f, ships, hosts, lookers):
    """Of up to `hosts` hosts: the smallest for so many lookers, or the largest."""
    whole = tree(c, f, ships, hosts)
    low, high, best = 0, hosts, whole
    while whole.most >= lookers and high - low > 1:
        middle = (low + high) // 2
        t = tree(c, f, ships, middle)
        if t.most >= lookers:
            high, best = middle, t
        else:
            low = middle
    return best


def costs(c, f, p):
    """What each looker costs and how late it sees, of the plan, with as many lookers as are asked for or fit."""
    t, lookers = p["tree"], min(f.lookers, p["most"])
    all_radars, radars = f.ships * f.radars, p["ships"] * f.radars
    relays = p["origins"] * (t.hosts - 1) * t.processes
    senders = p["origins"] + relays
    each, of_host = lookers / senders, lookers / (p["origins"] * t.hosts)
    child = radars * looker_ms(c, "wss" if f.kind == "wss" else "native")
    sending = lookers * looker_ms(c, f.kind, f.thin)
    feeding = relays * child
    upstream = relays * radars * c.spokes_per_s * c.relay_us_per_spoke / 1000
    making = all_radars * (radar_ms(c) + c.net_ms_per_radar) + p["origins"] * world_ms(c, f.ships, f.targets)
    network = lookers * looker_mb(c, f.thin) + p["origins"] * (t.hosts - 1) * t.inflow_mb
    # Until the last has its sector: by the thread or by the link, whichever takes longer.
    link = f.gbit * 125 * c.sectors_per_s / 1000  # MB/s of a stream to ms for each of its sectors
    feed_ms = max((t.fan_out + t.processes - 1) * child / c.sectors_per_s, t.fan_out * t.inflow_mb / link)
    send_ms = max(each * looker_ms(c, f.kind, f.thin) / c.sectors_per_s, of_host * looker_mb(c, f.thin) / link)
    hops = t.depth + (1 if t.hosts > 1 and t.processes > 1 else 0)
    sector_ms = 1000 / c.sectors_per_s
    all_ms = sending + feeding + upstream + making
    return {"lookers": lookers, "hosts": p["origins"] * t.hosts, "senders": senders, "each": each, "hops": hops,
            "all_ms": all_ms, "looker_ms": (sending + feeding + upstream) / max(1, lookers),
            "looker_all_ms": all_ms / max(1, lookers), "looker_mb": network / max(1, lookers),
            "net_use": (sending + feeding + all_radars * c.net_ms_per_radar) / (senders * 1000),
            "link_use": network / (p["origins"] * t.hosts * f.gbit * 125),
            "memory_mb": t.processes * c.memory_base_mb + of_host * c.memory_looker_mb,
            "feed_ms": feed_ms, "send_ms": send_ms, "hop_ms": c.hop_ms + feed_ms / 2, "order_ms": c.lead_ms + c.renew_ms / 2,
            "picture_ms": sector_ms + hops * (c.hop_ms + feed_ms / 2) + c.hop_ms + send_ms / 2,
            "last_ms": sector_ms + hops * (c.hop_ms + feed_ms) + c.hop_ms + send_ms,
            "catch_up_s": catch_up_s(c, f.ships, f.targets, f.hours)}


def needed_hosts(c, f, most=1_000_000):
    """The fewest hosts for the lookers; None: none of up to `most` do."""
    def fits(hosts):
        p = plan(c, Fleet(**{**f.__dict__, "hosts": hosts}))
        return "problem" not in p and p["most"] >= f.lookers
    high = 1
    while not fits(high):
        high *= 2
        if high > most:
            return None
    low = high // 2
    while high - low > max(1, high // 100):
        middle = (low + high) // 2
        low, high = (low, middle) if fits(middle) else (middle, high)
    return high


def ship_limits(c, f):
    """Own ships of one exercise at which each part that all of them share is in use by use_limit; the hardest first."""
    per_host = max(1, f.ships // max(1, f.hosts))
    store = store_limit_ms(c) - c.store_idle_ms - 1000 / c.renew_ms * c.store_grant_ms
    # (grants + ships x a) x (ships / per_host) x event = store: a square equation.
    a, grants, event = c.orders_per_ship_s, 1000 / c.renew_ms, c.store_event_us / 1000 / per_host
    watches = (-grants * event + math.sqrt((grants * event) ** 2 + 4 * a * event * store)) / (2 * a * event)
    steps = (1000 * c.use_limit - world_ms(c, 0, f.targets)) / world_ms(c, 1, 0)
    limits = {f"orders told to every host, {per_host} ships a host": watches,
              "names kept, one for each ship": store / (c.name_steps_per_s * c.store_name_ms),
              "orders put": c.store_orders_per_s * c.use_limit / a, "world's steps, on every host with a ship": steps}
    return sorted(limits.items(), key=lambda item: item[1])
