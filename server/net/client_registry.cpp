#include "server/net/client_registry.hpp"

#include <utility>

namespace skerry::server {

ClientPtr ClientRegistry::add(std::string transport, std::string peer) {
  auto client = std::make_shared<ClientCounters>(std::move(transport), std::move(peer));
  const std::lock_guard lock(mutex_);
  std::erase_if(clients_, [](const auto& known) { return known.expired(); });
  clients_.push_back(client);
  return client;
}

void ClientRegistry::append_to(wire::Status& status) const {
  const std::lock_guard lock(mutex_);
  for (const auto& known : clients_) {
    const ClientPtr client = known.lock();
    if (client == nullptr) continue;
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

}  // namespace skerry::server
