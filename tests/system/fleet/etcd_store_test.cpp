// What the fleet takes from etcd, over a real one.
#include "server/fleet/etcd/etcd_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>

#include "server/fleet/holding.hpp"
#include "server/fleet/order_watch.hpp"
#include "tests/system/fleet/etcd_cluster.hpp"

namespace skerry::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::SizeIs;

HostTime in(Duration d) { return host_now() + d; }

// No test is so slow that it runs out.
constexpr seconds kLongLease{600};

// A host of the exercise "e".
struct Host {
  explicit Host(const std::shared_ptr<const EtcdMembers>& members,
                const std::string& name = "host-a")
      : keys(members),
        orders(keys, mark, "e"),
        leader(keys, mark, {"e", kLeader, name, kLongLease}) {}

  StoreMark mark;
  EtcdStore keys;
  OrderStore orders;
  Holding leader;
  Epoch epoch = 0;
  Revision grant = 0;

  void lead() {
    ASSERT_TRUE(orders.open("born", in(seconds(10))));
    ASSERT_EQ(leader.step(in(seconds(10))).standing, Holding::Standing::holds);
    epoch = leader.held(host_now()).value_or(0);
    const auto granted = orders.grant({epoch, 0, 3, {}}, in(seconds(10)));
    ASSERT_TRUE(granted) << granted.error().text;
    grant = granted->revision;
  }
  StoreResult<Appended> append(const std::string& id, Duration patience = seconds(10)) {
    return orders.append({id, "host-a", "order " + id, epoch, grant, 4}, in(patience));
  }
  // The trouble of an append; "" if there is none.
  std::string trouble(const std::string& id, Duration patience) {
    const auto outcome = append(id, patience);
    last = outcome ? std::string() : outcome.error().text;
    return outcome ? std::string() : std::string(name_of(outcome.error().trouble));
  }
  std::string last;
};

struct FleetStore : testing::Test {
  EtcdCluster etcd;
  Host a{etcd.connect()};
};

TEST_F(FleetStore, AppendsReadsWatchesAndCompacts) {
  a.lead();
  Host b(etcd.connect(), "host-b");
  ASSERT_TRUE(b.orders.open("born again", in(seconds(10))));
  EXPECT_EQ(b.mark.seen().born, "born");
  OrderWatch watch(b.keys, b.mark, "e", 1);
  for (int i = 0; i < 700; ++i) ASSERT_TRUE(a.append("o" + std::to_string(i)));
  EXPECT_TRUE(a.append("o7")->was_there);
  std::vector<std::string> seen;
  const auto see = [&](std::size_t count) {
    while (seen.size() < count) {
      const auto events = watch.next(in(seconds(10)));
      if (!events) return events.error();
      for (const LogEvent& event : *events) {
        if (const auto* order = std::get_if<OrderSeen>(&event)) seen.push_back(order->id);
      }
    }
    return StoreError{};
  };
  EXPECT_EQ(see(700).text, "");
  EXPECT_EQ(seen.back(), "o699");

  // The history is gone, the orders are not.
  OrderWatch late(b.keys, b.mark, "e", 5);
  etcd.control({"--endpoints=" + etcd.addresses()[0], "compact",
                std::to_string(a.append("o700")->revision)});
  const auto told = late.next(in(seconds(10)));
  ASSERT_FALSE(told);
  EXPECT_EQ(told.error().trouble, Trouble::compacted);
  EXPECT_THAT(told.error().text, HasSubstr("the log is read instead"));
  const auto read = late.next(in(seconds(10)));
  ASSERT_TRUE(read) << read.error().text;
  std::size_t orders = 0;
  for (const LogEvent& event : *read) orders += std::holds_alternative<OrderSeen>(event);
  EXPECT_EQ(orders, 701u);
  const auto text = b.orders.read(1, in(seconds(10)));
  ASSERT_TRUE(text);
  EXPECT_THAT(text->orders, SizeIs(701));
  EXPECT_EQ(text->orders[100].id, "o100");
  EXPECT_EQ(text->orders[100].order, "order o100");

  // A new leader: nothing is appended under the former epoch.
  a.leader.release(in(seconds(10)));
  OrderWatch holders(b.keys, b.mark, "e", text->at + 1);
  auto freed = holders.next(in(seconds(10)));
  while (freed && freed->empty()) freed = holders.next(in(seconds(10)));
  ASSERT_TRUE(freed) << freed.error().text;
  ASSERT_THAT(*freed, SizeIs(1));
  EXPECT_EQ(std::get<HolderSeen>(freed->front()), (HolderSeen{text->at + 1, kLeader, "", 0}));
  EXPECT_EQ(a.trouble("o800", seconds(10)), "deposed");
  ASSERT_EQ(b.leader.step(in(seconds(10))).standing, Holding::Standing::holds);
  EXPECT_EQ(a.trouble("o800", seconds(10)), "deposed");
  EXPECT_THAT(a.last, HasSubstr("host host-b leads the exercise with epoch"));
}

TEST_F(FleetStore, TellsNoMajoritySlowAndUnreachableApart) {
  a.lead();
  // Without two of three, the third says so itself.
  const auto leader = etcd.await_leader();
  etcd.kill(leader);
  etcd.kill((leader + 1) % 3);
  EXPECT_EQ(a.trouble("o1", seconds(5)), "no majority") << a.last;
  EXPECT_THAT(a.last, HasSubstr("start the others"));
  etcd.kill((leader + 2) % 3);
  EXPECT_EQ(a.trouble("o2", seconds(2)), "unreachable") << a.last;
  EXPECT_THAT(a.last, HasSubstr("is it running"));
  etcd.heal();
  etcd.await_majority();
  ASSERT_TRUE(a.orders.verify(in(seconds(10))));
  for (std::size_t i = 0; i < 3; ++i) etcd.stop(i);
  EXPECT_EQ(a.trouble("o3", seconds(2)), "slow") << a.last;
  EXPECT_THAT(a.last, HasSubstr("did not answer in time"));
  etcd.heal();
}

TEST_F(FleetStore, GoesOnWithTheNextMember) {
  a.lead();
  OrderWatch watch(a.keys, a.mark, "e", 1);
  ASSERT_TRUE(watch.next(in(seconds(10))));
  for (std::size_t i = 0; i < 3; ++i) {
    if (i % 2)
      etcd.kill(i);
    else
      etcd.stop(i);
    const auto outcome = a.append("o" + std::to_string(i));
    EXPECT_TRUE(outcome) << outcome.error().text;
    etcd.heal();
    etcd.await_majority();
  }
  const auto last = a.append("last");
  ASSERT_TRUE(last) << last.error().text;
  for (std::string id; id != "last";) {
    const auto events = watch.next(in(seconds(10)));
    if (!events) continue;
    for (const LogEvent& event : *events) {
      if (const auto* order = std::get_if<OrderSeen>(&event)) id = order->id;
    }
  }
}

TEST_F(FleetStore, SaysThatItIsRestoredFromAnOldBackup) {
  a.lead();
  ASSERT_TRUE(a.append("o1"));
  system_test::TempFolder folder;
  const std::string backup = folder.path("backup");
  etcd.save(0, backup);
  OrderWatch watch(a.keys, a.mark, "e", 1);
  ASSERT_TRUE(a.append("o2"));
  for (Revision last = 0; last < a.mark.seen().last_at;) {
    const auto events = watch.next(in(seconds(10)));
    ASSERT_TRUE(events) << events.error().text;
    if (!events->empty()) last = revision_of(events->back());
  }
  etcd.restore(backup);
  // The watch is cut, and asks; so does whoever reads or appends.
  Trouble told = Trouble::slow;
  while (may_pass(told)) {
    const auto events = watch.next(in(seconds(2)));
    if (!events) told = events.error().trouble;
  }
  EXPECT_EQ(told, Trouble::went_back);
  EXPECT_EQ(a.trouble("o3", seconds(10)), "went back");
  EXPECT_THAT(a.last, HasSubstr("restored from a"));
}

TEST(FleetFull, SaysThatItIsFull) {
  EtcdCluster::Plan plan;
  plan.members = 1;
  plan.more_arguments = {"--quota-backend-bytes=2000000"};
  EtcdCluster etcd(plan);
  Host a(etcd.connect());
  a.lead();
  const std::string large(kMostOrder, 'x');
  StoreResult<Appended> outcome = Failure{StoreError{}};
  int i = 0;
  do {
    outcome = a.orders.append({"o" + std::to_string(++i), "host-a", large, a.epoch, a.grant, 4},
                              in(seconds(10)));
  } while (outcome && i < 200);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().trouble, Trouble::full) << outcome.error().text;
  EXPECT_FALSE(outcome.error().maybe_done);
  EXPECT_THAT(outcome.error().text, HasSubstr("alarm disarm"));
  EXPECT_THAT(a.keys.state(in(seconds(10)))->alarms, testing::Contains(HasSubstr("NOSPACE")));
  // What is there can be read.
  EXPECT_THAT(a.orders.read(1, in(seconds(10)))->orders, SizeIs(i - 1));
}

void run_openssl(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "/usr/bin/openssl");
  const auto ending = system_test::run(arguments);
  ASSERT_EQ(ending.code, 0) << ending.err;
}

// An authority and a host's certificate, by the names that EtcdCluster wants.
void make_certificates(const system_test::TempFolder& folder) {
  const auto path = [&](const char* file) { return folder.path(file); };
  run_openssl({"req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1",
               "-nodes", "-subj", "/CN=fleet", "-days", "2", "-keyout", path("ca.key"), "-out",
               path("ca.pem")});
  run_openssl({"req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
               "-subj", "/CN=host", "-keyout", path("host.key"), "-out", path("host.csr")});
  folder.write("names", "subjectAltName=IP:127.0.0.1\n");
  run_openssl({"x509", "-req", "-in", path("host.csr"), "-CA", path("ca.pem"), "-CAkey",
               path("ca.key"), "-CAcreateserial", "-days", "2", "-extfile", path("names"), "-out",
               path("host.pem")});
}

TEST(FleetTls, IsOfThoseWhoShowACertificate) {
  system_test::TempFolder ours, others;
  make_certificates(ours);
  make_certificates(others);
  EtcdCluster::Plan plan;
  plan.tls_folder = ours.path("");
  plan.tls_folder.pop_back();
  EtcdCluster etcd(plan);
  Host a(etcd.connect());
  a.lead();
  EXPECT_TRUE(a.append("o1"));

  const auto trouble = [&](EtcdAddress address) {
    Host stranger(std::make_shared<EtcdMembers>(address));
    stranger.epoch = a.epoch;
    stranger.grant = a.grant;
    const auto kind = stranger.trouble("o2", seconds(3));
    return kind + ": " + stranger.last;
  };
  EtcdAddress address = etcd.address();
  address.tls->certificate = system_test::text_of_file(others.path("host.pem"));
  address.tls->key = system_test::text_of_file(others.path("host.key"));
  // etcd ends the connection once it has seen the certificate.
  EXPECT_THAT(trouble(address), testing::ContainsRegex("^(unreachable|slow): "));
  address = etcd.address();
  address.tls->authority = system_test::text_of_file(others.path("ca.pem"));
  EXPECT_THAT(trouble(address), HasSubstr("certificate"));
  address.tls.reset();
  EXPECT_THAT(trouble(address), testing::StartsWith("unreachable"));
  EXPECT_THAT(a.orders.read(1, in(seconds(10)))->orders, SizeIs(1));
  EXPECT_THROW(EtcdMembers({etcd.addresses(), EtcdTls{"", "", ""}}), std::invalid_argument);
}

// A holder is stopped; another takes over; when it goes on, the first thing it finds is that it
// holds nothing, by its own clock, and the store takes nothing under its epoch.
TEST_F(FleetStore, AStoppedHolderFindsThatItHoldsNothing) {
  system_test::TempFolder folder;
  const std::string file = folder.path("worker");
  std::vector<std::string> arguments = {FLEET_WORKER, "hold", "host-w", "1", file, "e"};
  for (const std::string& address : etcd.addresses()) arguments.push_back(address);
  system_test::ChildProcess worker(arguments);
  const auto await_text = [&](const std::string& text) {
    const HostTime end = in(seconds(60));
    while (system_test::text_of_file(file).find(text) == std::string::npos && host_now() < end)
      a.keys.wait_until(in(milliseconds(10)));
    return system_test::text_of_file(file);
  };
  ASSERT_THAT(await_text("holds "), HasSubstr("holds "));
  worker.signal(SIGSTOP);
  ASSERT_TRUE(a.orders.open("born", in(seconds(10))));
  const HostTime end = in(seconds(60));
  while (!a.leader.held(host_now()) && host_now() < end) {
    (void)a.leader.step(in(seconds(1)));
    a.keys.wait_until(in(milliseconds(50)));
  }
  ASSERT_TRUE(a.leader.held(host_now()));
  const std::string before = system_test::text_of_file(file);
  EXPECT_THAT(before, testing::Not(HasSubstr("holds-not")));
  worker.signal(SIGCONT);
  EXPECT_THAT(await_text("append "), HasSubstr("append deposed"));
  EXPECT_THAT(system_test::text_of_file(file).substr(before.size()),
              testing::StartsWith("holds-not "));
}

}  // namespace
}  // namespace skerry::fleet
