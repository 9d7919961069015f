"""The processes of a fleet: an etcd of three members and hosts, on loopback or each on an address of its own."""
import pathlib
import signal
import socket
import subprocess
import time


def free_ports(count):
    holders = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [holder.getsockname()[1] for holder in holders]
    for holder in holders:
        holder.close()
    return ports


def scenario(ships):
    text = "name: Fleet\nseed: 7\nown_ships:\n"
    for i in range(ships):
        text += (f"  - name: Ship {i}\n    position: {{lat: {60.30 + 0.01 * (i % 6)}, lon: {4.60 + 0.02 * (i // 6)}}}\n"
                 f"    course_deg: {(37 * i) % 360}\n    speed_kn: {6 + i % 9}\n    radars:\n"
                 f"      - {{name: Radar {i}, spokes: 256, cells: 256, bits: 8, rpm: 60, range_nm: 6}}\n")
    return text


class Failed(Exception):
    """Why nothing more can be looked at."""


class Process:
    """One that is killed, stopped and started again by the same command."""

    def __init__(self, name, command, log):
        self.name, self.command, self.log, self.process = name, command, log, None

    def start(self):
        with open(self.log, "ab") as log:
            self.process = subprocess.Popen(self.command, stdout=log, stderr=log)

    def signal(self, number):
        if self.process is not None:
            self.process.send_signal(number)

    def kill(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()
        self.process = None

    def end(self, timeout=30):
        if self.process is None:
            return 0
        self.process.send_signal(signal.SIGCONT)
        self.process.terminate()
        try:
            return self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            self.kill()
            return -1


class Network:
    """Addresses of a fleet's processes: on loopback, or each in a network namespace of its own on a bridge, which can be cut."""

    def __init__(self, apart):
        self.apart, self.nodes = apart, {}
        if apart:
            self._run("ip", "link", "set", "lo", "up")
            self._run("ip", "link", "add", "fleet0", "type", "bridge")
            self._run("ip", "address", "add", "10.97.0.1/24", "dev", "fleet0")
            self._run("ip", "link", "set", "fleet0", "up")

    @staticmethod
    def _run(*command):
        subprocess.run(command, check=True)

    def add(self, name):
        """Address, and what goes before a command that is to run there."""
        if not self.apart:
            return "127.0.0.1", []
        number = len(self.nodes)
        holder = subprocess.Popen(["unshare", "--net", "sleep", "infinity"])
        mine = pathlib.Path("/proc/self/ns/net").readlink()
        while pathlib.Path(f"/proc/{holder.pid}/ns/net").readlink() == mine:
            time.sleep(0.01)
        inside = ["nsenter", "-t", str(holder.pid), "-n", "--"]
        address = f"10.97.0.{10 + number}"
        self._run("ip", "link", "add", f"v{number}", "type", "veth", "peer", "name", "e0", "netns", str(holder.pid))
        self._run("ip", "link", "set", f"v{number}", "master", "fleet0", "up")
        self._run(*inside, "ip", "address", "add", f"{address}/24", "dev", "e0")
        self._run(*inside, "ip", "link", "set", "e0", "up")
        self._run(*inside, "ip", "link", "set", "lo", "up")
        self.nodes[name] = (holder, f"v{number}")
        return address, inside

    def cut(self, name):
        self._run("ip", "link", "set", self.nodes[name][1], "down")

    def mend(self, name):
        self._run("ip", "link", "set", self.nodes[name][1], "up")

    def end(self):
        for holder, _ in self.nodes.values():
            holder.kill()
            holder.wait()


class Fleet:
    """Members m0 to m2 and hosts h0, h1, ...; only with addresses of their own (10.97.0.x) can they be cut off."""

    TOKEN = "of-the-test"

    def __init__(self, arguments, folder):
        self.folder = pathlib.Path(folder)
        self.network = Network(arguments.apart)
        names = [f"m{i}" for i in range(3)] + [f"h{i}" for i in range(arguments.hosts)]
        nodes = {name: self.network.add(name) for name in names}
        ports = free_ports(2 * len(names))
        places = {name: f"{nodes[name][0]}:{ports[i]}" for i, name in enumerate(names)}  # clients of m, native protocol of h
        others = {name: f"{nodes[name][0]}:{ports[len(names) + i]}" for i, name in enumerate(names)}  # peers of m, pages of h
        members = ",".join(f"m{i}=http://{others[f'm{i}']}" for i in range(3))
        self.etcd = [Process(f"etcd m{i}", [
            *nodes[f"m{i}"][1], "etcd", "--name", f"m{i}", "--data-dir", str(self.folder / f"m{i}"),
            "--listen-client-urls", f"http://{places[f'm{i}']}", "--advertise-client-urls", f"http://{places[f'm{i}']}",
            "--listen-peer-urls", f"http://{others[f'm{i}']}", "--initial-advertise-peer-urls", f"http://{others[f'm{i}']}",
            "--initial-cluster", members, "--initial-cluster-token", "fleet", "--initial-cluster-state", "new",
            "--heartbeat-interval", "50", "--election-timeout", "500", "--logger", "zap", "--log-level", "error",
            "--log-outputs", "stderr"], self.folder / f"m{i}.log") for i in range(3)]
        (self.folder / "fleet.yaml").write_text(scenario(arguments.ships))
        store = ",".join(places[f"m{i}"] for i in range(3))
        self.hosts = [Process(f"host h{i}", [
            *nodes[f"h{i}"][1], arguments.skerryd, "--scenario", str(self.folder / "fleet.yaml"), "--bind", nodes[f"h{i}"][0],
            "--insecure", "--control-token", self.TOKEN, "--tcp-port", places[f"h{i}"].rsplit(":", 1)[1],
            "--http-port", others[f"h{i}"].rsplit(":", 1)[1], "--no-udp", "--no-cat240", "--no-signalk", "--fleet", store,
            "--fleet-host", f"h{i}"], self.folder / f"h{i}.log") for i in range(arguments.hosts)]
        self.native = [places[f"h{i}"] for i in range(arguments.hosts)]

    def start(self):
        for each in [*self.etcd, *self.hosts]:
            each.start()

    def end(self):
        codes = [each.end() for each in self.hosts]
        for each in self.etcd:
            each.kill()
        self.network.end()
        return codes

    def places(self):
        return [(place.rsplit(":", 1)[0], int(place.rsplit(":", 1)[1])) for place in self.native]
