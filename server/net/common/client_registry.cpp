#include "server/net/common/client_registry.hpp"

#include <utility>

namespace skerry::server {
namespace {

void add_counts(ClientTotals& totals, const ClientCounters& client) {
  totals.spokes_sent += client.spokes_sent.load(std::memory_order_relaxed);
  totals.spokes_lost += client.spokes_lost.load(std::memory_order_relaxed);
  totals.bytes_sent += client.bytes_sent.load(std::memory_order_relaxed);
}

}  // namespace

// In one step, so that nobody finds the client in neither place or in both.
void ClientRegistry::Books::leave(const ClientCounters& client) {
  const std::lock_guard lock(mutex);
  if (std::erase(clients, &client) > 0) add_counts(gone[client.transport], client);
}

ClientPtr ClientRegistry::add(std::string transport, std::string peer) {
  const ClientPtr client(new ClientCounters(std::move(transport), std::move(peer)),
                         [books = books_](const ClientCounters* counters) {
                           books->leave(*counters);
                           delete counters;
                         });
  const std::lock_guard lock(books_->mutex);
  books_->clients.push_back(client.get());
  ++books_->gone[client->transport].connections;
  return client;
}

void ClientRegistry::append_to(wire::Status& status) const {
  const std::lock_guard lock(books_->mutex);
  for (const ClientCounters* client : books_->clients) {
    wire::ClientStatus& entry = *status.add_clients();
    entry.set_transport(client->transport);
    entry.set_peer(client->peer);
    entry.set_radar(client->radar.load(std::memory_order_relaxed));
    entry.set_view(client->view.load(std::memory_order_relaxed));
    entry.set_spokes_sent(client->spokes_sent.load(std::memory_order_relaxed));
    entry.set_spokes_lost(client->spokes_lost.load(std::memory_order_relaxed));
    entry.set_bytes_sent(client->bytes_sent.load(std::memory_order_relaxed));
  }
}

ClientTotalsByTransport ClientRegistry::totals() const {
  const std::lock_guard lock(books_->mutex);
  ClientTotalsByTransport totals = books_->gone;
  for (const ClientCounters* client : books_->clients) {
    ClientTotals& sum = totals[client->transport];
    ++sum.connected;
    add_counts(sum, *client);
  }
  return totals;
}

}  // namespace skerry::server
