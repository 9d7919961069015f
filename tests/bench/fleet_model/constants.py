"""The measured and assumed constants of the fleet model: one table, which server/fleet/MODEL.md has too.

RESULTS is tests/bench/RESULTS.md, FLEET server/fleet/README.md; class_check, etcd_cost.py and so on are commands. `how`:
measured (here, by the named command), code (a number of this project's code), known (of another program, from its
documentation), assumed (nobody has measured it).
"""
from collections import namedtuple

Constant = namedtuple("Constant", "name value unit how source")

TABLE = [Constant(*row) for row in [
    # A radar's stream: 4096 spokes of 1024 cells at 24 turns a minute.
    ("spokes_per_s", 1638.4, "1/s", "code", "4096 x 24 / 60; tests/bench/fan_out/fan_out.cpp"),
    ("spoke_bytes", 1101, "B", "code", "1024 cells and 77 B of header; fan_out.cpp kSpokeBytes"),
    ("sector_spokes", 16, "spokes", "code", "what is rendered, sent and passed on at once; fan_out.cpp"),
    ("cells_per_spoke", 1024, "cells", "code", "fan_out.cpp"),
    ("thin_mb_per_s", 0.105, "MB/s", "measured",
     "output `native` as 720 x 512 x 4 bits: RESULTS 'Outputs'; no console is offered it yet"),
    # What a sender pays, on its one network thread: so much a write and so much a MB.
    ("send_us_per_write", 2.8, "us", "measured",
     "what 0.282 ms/MB at 400 consoles (RESULTS 'Many consoles over TCP') leaves after send_ms_per_mb"),
    ("send_ms_per_mb", 0.124, "ms/MB", "measured",
     "240,000 writes/s of a spoke against 2.7 GB/s in writes of 16 KiB, TCP on loopback (an early measurement, on no page): "
     "4.17 and 6.07 us a write, solved for both parts"),
    ("ws_us_per_write", 5.0, "us", "measured",
     "0.38 to 0.43 ms/MB of 200 and 400 WebSockets (RESULTS, table of TLS), less send_ms_per_mb"),
    ("wss_more_ms_per_mb", 0.61, "ms/MB", "measured", "1.04 less 0.43 ms/MB at 200 consoles (RESULTS, table of TLS)"),
    ("net_ms_per_radar", 2.0, "ms/s", "measured",
     "class_check: 3.28 ms/s a ship for a native and a WS console (RESULTS 'A class on one host'), less these two"),
    ("relay_us_per_spoke", 0.26, "us", "measured",
     "thread `upstream` of a relay (RESULTS 'Many consoles over TCP', of a relay)"),
    # A radar and its ship.
    ("echo_ns_per_cell", 3.0, "ns", "measured", "full scene on AVX-512 (RESULTS 'Echo'); by turns 3.8 to 4.3"),
    ("echo_ns_per_cell_target", 0.006, "ns", "measured",
     "0.008 floors of 0.76 ns for a target beyond 40 ships and 100 buoys (RESULTS 'Echo')"),
    ("sector_us", 120, "us", "measured",
     "default scenario: 1.5 % of a core a radar, less 1.6 ns a cell, by 102.4 sectors/s (RESULTS 'Echo')"),
    ("ship_us_per_tick", 8, "us", "code",
     "of a ship with a class; 2 without. server/world/timeline.hpp: 5000 steps within 40 ms, and within 10 ms"),
    ("target_us_per_tick", 0.03, "us", "measured",
     "56 us a step of 20 own ships without a class among 500 targets (RESULTS 'Collisions'), less 2 us for each ship"),
    ("ticks_per_s", 10, "1/s", "code", "server/fleet/exercise_log.hpp"),
    ("orders_per_ship_s", 1 / 15, "1/s", "measured",
     "class_check steers each ship every 15 s (RESULTS); real classes: not counted"),
    # Memory.
    ("memory_base_mb", 74, "MB", "measured",
     "class_check --open-sea: 5 ships in 103 MiB, less memory_radar_mb each (RESULTS); also for a relay"),
    ("memory_radar_mb", 6.8, "MB", "measured", "RESULTS 'Radars by turns'"),
    ("memory_looker_mb", 0.4, "MB", "assumed",
     "send buffer of 0.1 s of the stream (net_context.cpp), which the kernel doubles, and 40 kB for session and TLS"),
    ("ring_s", 0.5, "s", "code", "what a ring holds for a slow reader: server/THREADS.md"),
    # Joining, losing, coming again.
    ("handshake_ms", 0.84, "ms", "measured", "server's part, TLS 1.3, median (RESULTS 'TLS handshakes')"),
    ("greeting_ms", 0.2, "ms", "assumed", "accept, HTTP upgrade, Hello, Subscribe"),
    ("connections_of_retry", 2, "", "code",
     "a console asks by fetch, then opens its WebSocket: clients/web/src/connection.js"),
    ("opening_s", 3, "s", "code", "a TLS handshake ends within it: server/net/common/peer_limits.hpp"),
    ("retry_first_s", 0.3, "s", "code",
     "doubled to retry_last_s, times 0.75 to 1.25: clients/web/src/connection_retry.js"),
    ("retry_last_s", 1.6, "s", "code", "connection_retry.js"),
    ("silence_s", 6, "s", "code", "a console gives up a silent server: connection.js SILENCE_MS"),
    ("relay_retry_first_s", 0.25, "s", "code",
     "doubled to relay_retry_last_s, not spread: upstream_talk.hpp"),
    ("relay_retry_last_s", 4, "s", "code", "upstream_talk.hpp"),
    ("relay_silence_s", 5, "s", "code", "upstream_talk.hpp"),
    ("max_connections", 256, "", "code", "default of net_config.hpp; the model takes --connections"),
    # Hosts.
    ("use_limit", 0.7, "", "assumed", "of a core, link or memory that a plan may use"),
    ("hop_ms", 0.5, "ms", "assumed",
     "network within a site and wake-ups, without what waits in a queue; on loopback half of 0.09 to 0.27 ms (MODEL.md)"),
    ("stall_share", 0.001, "", "measured",
     "of wake-ups that come late by stall_ms: timers 1 ms apart, p99.9 1.8 to 2.9 ms (an early measurement, on no page)"),
    ("stall_ms", 2.5, "ms", "measured", "as stall_share"),
    ("cores_of_store", 2, "", "assumed", "of each of three members, for etcd alone"),
    # The log, over three etcd on two cores that other work shared: tests/bench/fleet_model/etcd_cost.py.
    ("store_idle_ms", 67, "ms/s", "measured",
     "etcd_cost.py: 91 ms/s at 10 grants/s, 187 at 50; all members, heartbeats of 50 ms"),
    ("store_grant_ms", 2.4, "ms", "measured", "the same: what one more grant takes"),
    ("store_order_ms", 0.46, "ms", "measured",
     "etcd_cost.py, 64 callers (1.82 with one): CPU of all members for an order"),
    ("store_event_us", 30, "us", "measured",
     "etcd_cost.py: for an event and watching host, all members; 23 to 48 in eight rounds"),
    ("store_name_ms", 0.32, "ms", "measured",
     "etcd_cost.py, 64 callers: lease kept 0.17, who holds 0.15; one caller: 0.89"),
    ("name_steps_per_s", 2, "1/s", "code", "each quarter of a lease of 2 s: server/fleet/holding.hpp"),
    ("store_orders_per_s", 2330, "1/s", "measured", "etcd_cost.py, 64 callers, both cores full"),
    ("append_p50_ms", 2.5, "ms", "measured", "FLEET 'Measured', busy machine"),
    ("append_p99_ms", 31.1, "ms", "measured", "FLEET 'Measured', busy machine; 13 on an idle one"),
    ("watch_first_ms", 4, "ms", "measured", "etcd_cost.py --rate 10: to the last of 100 watchers 7.5 ms, of 1000 38.7"),
    ("watch_us_per_host", 35, "us", "measured", "the same"),
    ("store_stalls_per_s", 0.5, "1/s", "assumed", "chosen with the next so that appends have the measured p50 and p99"),
    ("store_stall_ms", 40, "ms", "assumed", "mean of exponential waits; as the one before"),
    ("outage_s", 0.8, "s", "measured", "FLEET 'Measured': store's leader killed, p50; 1.36 at most"),
    ("lease_s", 2, "s", "code", "server/fleet/holding.hpp"),
    ("lead_ms", 300, "ms", "code", "server/fleet/exercise_log.hpp"),
    ("renew_ms", 100, "ms", "code", "exercise_log.hpp"),
    ("fresh_ms", 50, "ms", "code", "exercise_log.hpp"),
    ("grant_log_bytes", 97, "B", "measured", "FLEET: 3.5 MB an hour of 36,000 grants"),
    ("order_log_bytes", 250, "B", "assumed", "60 B of order, key, names and etcd's record"),
    ("log_quota_mb", 2000, "MB", "known", "etcd 3.4: --quota-backend-bytes"),
    ("log_read_mb_per_s", 10, "MB/s", "assumed", "ranges of a joining host"),
]]


class Constants:
    """The table by name; some values may be said anew: Constants({"use_limit": 0.5})."""

    def __init__(self, changes=None):
        changes = dict(changes or {})
        for row in TABLE:
            setattr(self, row.name, float(changes.pop(row.name, row.value)))
        if changes:
            raise KeyError(f"no constant is named {', '.join(changes)}")

    @property
    def sectors_per_s(self):
        return self.spokes_per_s / self.sector_spokes

    @property
    def stream_mb_per_s(self):
        return self.spokes_per_s * self.spoke_bytes / 1e6
