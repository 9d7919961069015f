"""Seeded simulations beside the formulas: orders through the log, sectors down the tree, and consoles that come again.

Each takes a seed and gives the same result for it. Times are seconds unless a name says ms.
"""
import heapq
import math
import random

import shape


def of(values, share):
    values = sorted(values)
    return values[int(share * (len(values) - 1))] if values else math.nan


class Store:
    """Commits one request after another: a time for each, waits that come now and then (disk, scheduler), outages."""

    def __init__(self, c, rng, other_use, outages, until):
        self.service = 1 / (c.store_orders_per_s * max(0.02, 1 - other_use))
        self.usual = math.log(c.append_p50_ms / 1000)
        self.rng, self.free, self.stalls, t = rng, 0.0, sorted(outages), 0.0
        while c.store_stalls_per_s > 0 and t < until:
            t += rng.expovariate(c.store_stalls_per_s)
            self.stalls.append((t, t + rng.expovariate(1000 / c.store_stall_ms)))
        self.stalls.sort()
        self.next_stall = 0

    def commit(self, now):
        """When what is sent now is committed; calls come in the order of time."""
        at = max(now + 0.6 * self.rng.lognormvariate(self.usual, 0.25), self.free + self.service)
        while self.next_stall < len(self.stalls) and self.stalls[self.next_stall][1] <= at:
            self.next_stall += 1
        for begin, end in self.stalls[self.next_stall:self.next_stall + 3]:
            if begin <= at < end:
                at = end + self.service
        self.free = at
        return at


def orders(c, hosts, ships, seconds=60.0, seed=1, other_use=0.0, outages=()):
    """Orders and grants by the rule of server/fleet/README.md.

    An order is committed if the grant that its host named is still in force; else it is given anew under the newest that
    the host has heard. other_use: the share of the store that watches, names and grants take.
    """
    rng = random.Random(seed)
    store = Store(c, rng, other_use, list(outages), seconds + 5)
    lead, renew, fresh = c.lead_ms / 1000, c.renew_ms / 1000, c.fresh_ms / 1000
    heard_after = (c.watch_first_ms + hosts * c.watch_us_per_host / 1000) / 1000
    events, serial = [], 0
    result = {"acknowledged": [], "in_force": [], "free": [], "refused": 0, "orders": 0, "attempts": 0, "overtaken": 0}

    def at(time, what, *data):
        nonlocal serial
        serial += 1
        heapq.heappush(events, (time, serial, what, data))

    grant = {"number": 0, "to": lead}        # committed
    heard = [(0.0, 0, lead)]                 # of hosts in the middle of the fan-out: when, number, horizon
    at(renew, "grant")
    for _ in range(int(ships * c.orders_per_ship_s * seconds)):
        at(rng.uniform(0, seconds), "order", None)
    while events:
        now, _, what, data = heapq.heappop(events)
        if what == "grant" and now < seconds:
            at(store.commit(now), "granted", now)
        elif what == "granted":
            grant = {"number": grant["number"] + 1, "to": data[0] + lead}
            hear = now + heard_after * rng.uniform(0.5, 1.0)
            at(hear, "hear", grant["number"], grant["to"])
            at(max(data[0] + renew, now + 0.001), "grant")
        elif what == "hear":
            since, _, horizon = heard[-1]
            if now > horizon > since:
                result["free"].append(now - horizon)  # ran free from the horizon until this came
            elif now > horizon:
                result["free"][-1] += now - since  # what had come was of the past already
            heard.append((now, *data))
        elif what == "order":
            begun = data[0] if data[0] is not None else now
            result["orders"] += data[0] is None
            if heard[-1][2] - now < fresh:
                result["refused"] += 1  # no time is granted: the host takes no order
                continue
            result["attempts"] += 1
            at(store.commit(now), "put", begun, heard[-1][1], heard[-1][2])
        elif what == "put":
            begun, number, horizon = data
            if number != grant["number"]:
                result["overtaken"] += 1
                # Given anew when its host has heard the grant in force.
                at(now + 0.4 * c.append_p50_ms / 1000 + heard_after * rng.uniform(0.5, 1.0), "order", begun)
            else:
                result["acknowledged"].append(now + 0.4 * c.append_p50_ms / 1000 - begun)
                result["in_force"].append(horizon + renew - begun)
    return result


def pictures(c, hops, send_ms, turns=10, seed=1, stall_share=None):
    """How late the last child or looker of each of `hops` servers has a sector after its own; ms.

    send_ms: what one sector takes each of these servers to send to all of its own. A server that wakes late, or has not
    finished the one before, begins late (Lindley).
    """
    rng = random.Random(seed)
    period = 1000 / c.sectors_per_s
    share = c.stall_share if stall_share is None else stall_share
    busy, late = [0.0] * len(send_ms), []
    for i in range(int(turns * 2.5 * c.sectors_per_s)):
        t = i * period
        for hop in range(hops):
            t += c.hop_ms * rng.uniform(0.5, 1.5)
            if rng.random() < share:
                t += rng.expovariate(1 / c.stall_ms)
            busy[hop] = max(t, busy[hop]) + send_ms[hop]
            t = busy[hop]
        late.append(t - i * period)
    return late


def herd(c, lookers, survivors, use, kind="wss", thin=False, seed=1, detected_s=0.0, connections=4096, of_each=0):
    """`lookers` of servers that are gone call `survivors`, each of which is in use by `use` and has `of_each` consoles.

    As a web console does: a wait that doubles, spread by a quarter, then a fetch and a WebSocket, each with a handshake of
    its own that the server's network thread must end within opening_s. A server works at them in their order, with what
    its other consoles leave it; while it does, their sectors wait.
    """
    rng = random.Random(seed)
    job = (c.handshake_ms + c.greeting_ms if kind == "wss" else c.greeting_ms) / 1000
    each = shape.looker_ms(c, kind, thin) / 1000
    # Consoles are where chance put them: of_each at the mean.
    held = [max(0, round(rng.gauss(of_each, math.sqrt(of_each)))) for _ in range(survivors)]
    load, free = [use + (n - of_each) * each for n in held], [0.0] * survivors
    busiest_before = max(load)
    # When, who, attempt, stage, server.
    events = [(detected_s + retry_wait(c, rng, 0), i, 0, 0, 0) for i in range(lookers)]
    heapq.heapify(events)
    seen, failed, waits = [], 0, 0.0
    while events and len(seen) < lookers:
        now, who, attempt, stage, server = heapq.heappop(events)
        if now > detected_s + 300:
            break
        if stage == 0:
            server = rng.randrange(survivors)
        begin = max(now, free[server])
        if held[server] >= connections or begin - now > c.opening_s or load[server] >= 1:
            failed += 1
            told = now if held[server] >= connections else now + c.opening_s
            heapq.heappush(events, (told + retry_wait(c, rng, attempt + 1), who, attempt + 1, 0, 0))
            continue
        free[server] = begin + job / max(0.02, 1 - load[server])
        waits = max(waits, free[server] - now)
        if stage + 1 < c.connections_of_retry:
            heapq.heappush(events, (free[server], who, attempt, stage + 1, server))
        else:
            held[server] += 1
            load[server] += each
            seen.append(free[server])
    return {"seen": seen, "left": lookers - len(seen), "failed": failed, "backlog_s": waits, "loads": load,
            "busiest_before": busiest_before, "lost": waits > c.ring_s}


def retry_wait(c, rng, attempt):
    return min(c.retry_last_s, c.retry_first_s * 2 ** min(attempt, 10)) * rng.uniform(0.75, 1.25)


def relay_returns(c, gone_s, children, radars, tls=True):
    """A relay in the middle ends and is back `gone_s` later: when all relays below it have their streams again.

    Relays have one upstream and wait for it, at 0.25, 0.5 ... 4 s, all in step, and open a connection for each radar.
    """
    t, wait = 0.0, c.relay_retry_first_s
    while True:
        t += wait
        if t >= gone_s:
            break
        wait = min(c.relay_retry_last_s, 2 * wait)
    return t + children * radars * ((c.handshake_ms if tls else 0.0) + c.greeting_ms) / 1000
