// What the fleet's store costs, over three etcd of this machine: fleet_bench --appends N --kills N.
// Prints a line for each figure: p50, p99 and the largest, in ms.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "server/fleet/holding.hpp"
#include "server/fleet/order_watch.hpp"
#include "tests/system/fleet/etcd_cluster.hpp"

namespace {

using namespace skerry::fleet;  // NOLINT: a program of one file
using skerry::Duration;
using std::chrono::milliseconds;
using std::chrono::seconds;

double in_ms(Duration d) { return static_cast<double>(d.count()) * 1e-6; }

void print(const std::string& what, std::vector<Duration> times) {
  if (times.empty()) return;
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return in_ms(times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))]);
  };
  std::printf("%-58s n %5zu  p50 %8.2f  p99 %8.2f  max %8.2f ms\n", what.c_str(), times.size(),
              at(0.5), at(0.99), at(1.0));
  std::fflush(stdout);
}

struct Host {
  Host(const std::shared_ptr<const EtcdMembers>& members, const std::string& name)
      : keys(members),
        orders(keys, mark, "bench"),
        leader(keys, mark, {"bench", kLeader, name, Holding::kLease}) {}
  StoreMark mark;
  EtcdStore keys;
  OrderStore orders;
  Holding leader;
};

HostTime in(Duration d) { return host_now() + d; }

void keep(Host& host, HostTime& next) {
  if (host_now() < next) return;
  (void)host.leader.step(in(milliseconds(400)));
  next = in(milliseconds(400));
}

void appends(EtcdCluster& etcd, int count) {
  Host host(etcd.connect(), "host-a"), other(etcd.connect(), "host-b");
  (void)host.orders.open("born", in(seconds(10)));
  (void)host.leader.step(in(seconds(10)));
  const Epoch epoch = host.leader.held(host_now()).value();
  Revision grant = host.orders.grant({epoch, 0, 3, {}}, in(seconds(10))).value().revision;
  // When each order was begun, and when another host's watch had it.
  std::vector<std::atomic<std::int64_t>> begun(static_cast<std::size_t>(count));
  std::vector<Duration> append, granted, seen;
  std::thread watcher([&] {
    OrderWatch watch(other.keys, other.mark, "bench", grant + 1);
    while (static_cast<int>(seen.size()) < count) {
      const auto events = watch.next(in(seconds(1)));
      if (!events) continue;
      for (const LogEvent& event : *events) {
        if (const auto* order = std::get_if<OrderSeen>(&event))
          seen.push_back(host_now().time_since_epoch() -
                         Duration(begun[std::stoul(order->id)].load()));
      }
    }
  });
  HostTime next{};
  for (int i = 0; i < count; ++i) {
    keep(host, next);
    const HostTime before = host_now();
    begun[static_cast<std::size_t>(i)] = before.time_since_epoch().count();
    if (!host.orders.append({std::to_string(i), "host-a", std::string(60, 'x'), epoch, grant, 4},
                            in(seconds(30))))
      throw std::runtime_error("an append failed");
    append.push_back(host_now() - before);
    if (i % 4 == 0) {
      const HostTime then = host_now();
      grant = host.orders.grant({epoch, grant, 3, Duration(i)}, in(seconds(10))).value().revision;
      granted.push_back(host_now() - then);
    }
  }
  watcher.join();
  print("append of an order of 60 bytes", append);
  print("grant", granted);
  print("append until another host's watch has it", seen);
  host.leader.release(in(seconds(10)));
}

// From the last append that was answered before the store's leader was killed to the next.
void outages(EtcdCluster& etcd, int count) {
  std::vector<Duration> gaps;
  for (int i = 0; i < count; ++i) {
    Host host(etcd.connect(), "host-a");
    (void)host.orders.open("born", in(seconds(10)));
    while (!host.leader.held(host_now())) (void)host.leader.step(in(seconds(2)));
    const Epoch epoch = host.leader.held(host_now()).value();
    const auto text = host.orders.read(1, in(seconds(10)));
    const Revision grant = text.value().grant->revision;
    const auto member = etcd.await_leader();
    int n = 0;
    const auto one = [&] {
      return host.orders.append({fmt::format("k{}.{}", i, ++n), "host-a", "x", epoch, grant, 4},
                                in(seconds(30)));
    };
    for (int k = 0; k < 20; ++k) (void)one();
    const HostTime before = host_now();
    etcd.kill(member);
    const auto outcome = one();
    if (outcome) gaps.push_back(host_now() - before);
    if (!outcome) std::printf("  after a kill: %s\n", outcome.error().text.c_str());
    etcd.heal();
    etcd.await_majority();
    host.leader.release(in(seconds(10)));
  }
  print("no append while the store's leader is killed", gaps);
}

void takeovers(EtcdCluster& etcd, int count, bool with_store) {
  std::vector<Duration> times;
  for (int i = 0; i < count; ++i) {
    skerry::system_test::TempFolder folder;
    std::vector<std::string> arguments = {FLEET_WORKER,       "hold", "host-w", "1",
                                          folder.path("out"), "bench"};
    for (const std::string& address : etcd.addresses()) arguments.push_back(address);
    auto worker = std::make_unique<skerry::system_test::ChildProcess>(arguments);
    Host host(etcd.connect(), "host-a");
    while (skerry::system_test::text_of_file(folder.path("out")).find("holds ") ==
           std::string::npos)
      host.keys.wait_until(in(milliseconds(20)));
    host.keys.wait_until(in(milliseconds(300)));
    const auto member = etcd.await_leader();
    const HostTime before = host_now();
    worker.reset();
    if (with_store) etcd.kill(member);
    while (!host.leader.held(host_now())) {
      (void)host.leader.step(in(seconds(1)));
      host.keys.wait_until(in(milliseconds(20)));
    }
    times.push_back(host_now() - before);
    host.leader.release(in(seconds(5)));
    etcd.heal();
    etcd.await_majority();
  }
  print(with_store ? "take-over of a 2 s lease whose holder died with the store's leader"
                   : "take-over of a 2 s lease whose holder was killed",
        times);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "What the fleet's store costs, over three etcd of this machine: p50, p99 and the largest, in "
      "ms.");
  int count = 2000, kills = 10;
  double seconds_each = 0.5;
  app.add_option("--appends", count, "orders that are appended")->check(CLI::Range(1, 1000000));
  app.add_option("--kills", kills, "kills of the store's leader, of a holder, and of both")
      ->check(CLI::Range(0, 1000));
  app.add_option("--benchmark_min_time", seconds_each,
                 "as of all benches; below 0.1 s: 100 appends and 1 kill");
  app.footer("Example:\n  fleet_bench --appends 2000 --kills 10");
  CLI11_PARSE(app, argc, argv);
  if (seconds_each < 0.1) {
    count = std::min(count, 100);
    kills = std::min(kills, 1);
  }
  EtcdCluster etcd;
  appends(etcd, count);
  outages(etcd, kills);
  takeovers(etcd, kills, false);
  takeovers(etcd, kills, true);
}
