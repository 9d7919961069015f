#include "server/net/common/client_registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

namespace skerry::server {
namespace {

TEST(ClientRegistry, KnowsEachClientWhileItIsThere) {
  ClientRegistry registry;
  const ClientPtr first = registry.add("tcp", "a:1");
  ClientPtr second = registry.add("tcp", "b:2");
  second->spokes_lost = 7;
  wire::Status status;
  registry.append_to(status);
  ASSERT_EQ(status.clients_size(), 2);
  EXPECT_EQ(status.clients(0).peer(), "a:1");
  EXPECT_EQ(status.clients(1).spokes_lost(), 7u);
  second.reset();
  status.Clear();
  registry.append_to(status);
  EXPECT_EQ(status.clients_size(), 1);
}

TEST(ClientRegistry, TotalsKeepWhatClientsThatHaveGoneHad) {
  ClientRegistry registry;
  EXPECT_TRUE(registry.totals().empty());
  ClientPtr gone = registry.add("tcp", "a:1");
  gone->spokes_sent = 10;
  gone->spokes_lost = 2;
  gone->bytes_sent = 1000;
  const ClientPtr other = registry.add("websocket", "b:1");
  gone.reset();
  ClientTotals tcp = registry.totals().at("tcp");
  EXPECT_EQ(tcp.connected, 0u);
  EXPECT_EQ(tcp.connections, 1u);
  EXPECT_EQ(tcp.spokes_sent, 10u);
  const ClientPtr next = registry.add("tcp", "a:2");
  next->spokes_sent = 1;
  tcp = registry.totals().at("tcp");
  EXPECT_EQ(tcp.connected, 1u);
  EXPECT_EQ(tcp.connections, 2u);
  EXPECT_EQ(tcp.spokes_sent, 11u);
  EXPECT_EQ(tcp.spokes_lost, 2u);
  EXPECT_EQ(tcp.bytes_sent, 1000u);
  EXPECT_EQ(registry.totals().at("websocket").connected, 1u);
}

TEST(ClientRegistry, TotalsNeverGetLessWhileClientsComeAndGo) {
  ClientRegistry registry;
  constexpr int kClients = 2000;
  std::atomic<bool> begun{false}, done{false};
  std::thread clients([&] {
    while (!begun) std::this_thread::yield();
    for (int i = 0; i < kClients; ++i) {
      const ClientPtr client = registry.add("tcp", "a:1");
      client->spokes_sent.fetch_add(3);
    }
    done = true;
  });
  std::uint64_t last = 0;
  bool fell = false;
  while (!done) {
    const auto totals = registry.totals();
    const auto tcp = totals.find("tcp");
    const std::uint64_t sent = tcp == totals.end() ? 0 : tcp->second.spokes_sent;
    fell = fell || sent < last;
    last = sent;
    begun = true;
    std::this_thread::yield();
  }
  clients.join();
  EXPECT_FALSE(fell);
  EXPECT_EQ(registry.totals().at("tcp").spokes_sent, 3u * kClients);
  EXPECT_EQ(registry.totals().at("tcp").connections, std::uint64_t{kClients});
}

}  // namespace
}  // namespace skerry::server
