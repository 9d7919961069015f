#include "server/net/common/connection_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skerry::server {

std::size_t& PlaceCounts::of(Place place) {
  switch (place) {
    case Place::own_host:
      return own_host;
    case Place::trusted:
      return trusted;
    case Place::stranger:
      return stranger;
    case Place::on_trial:
      return on_trial;
    case Place::refused:
      break;
  }
  return refused;
}

void ConnectionSlot::Books::add(const PeerNet& net, Place place) {
  ++all.of(place);
  ++by_peer[net].of(place);
}

void ConnectionSlot::Books::remove(const PeerNet& net, Place place) {
  --all.of(place);
  const auto peer = by_peer.find(net);
  --peer->second.of(place);
  if (peer->second.served() + peer->second.refused == 0) by_peer.erase(peer);
}

ConnectionSlot::ConnectionSlot(std::shared_ptr<Books> books, TcpPeer peer, Place place,
                               std::string reason)
    : books_(std::move(books)), peer_(std::move(peer)), place_(place), reason_(std::move(reason)) {
  books_->add(peer_.net, place_);
}

ConnectionSlot::~ConnectionSlot() { books_->remove(peer_.net, place_); }

void ConnectionSlot::trust() {
  if (place_ != Place::stranger && place_ != Place::on_trial) return;
  books_->remove(peer_.net, place_);
  place_ = Place::trusted;
  books_->add(peer_.net, place_);
}

ConnectionTable::ConnectionTable(std::size_t limit, const PeerLimits& limits)
    : limit_(limit),
      reserve_(limit < 2 ? 0 : std::max<std::size_t>(1, limit * limits.reserve_percent / 100)),
      share_(std::max<std::size_t>(1, limit * limits.share_percent / 100)),
      trials_(reserve_ < 2 ? 0 : std::max<std::size_t>(1, reserve_ * limits.trial_percent / 100)),
      limits_(limits) {}

PlaceCounts ConnectionTable::counts_of(const PeerNet& net) const {
  const auto known = books_->by_peer.find(net);
  return known == books_->by_peer.end() ? PlaceCounts{} : known->second;
}

Place ConnectionTable::place_for(const TcpPeer& peer) const {
  const PlaceCounts& all = books_->all;
  const bool full = all.served() >= limit_;
  if (peer.on_own_host) return full ? Place::refused : Place::own_host;
  const PlaceCounts mine = counts_of(peer.net);
  if (!full && mine.stranger < share_ && all.stranger < strangers_most()) return Place::stranger;
  if (!full && mine.on_trial < limits_.trials_of_peer && all.on_trial < trials_) {
    return Place::on_trial;
  }
  return Place::refused;
}

std::string ConnectionTable::refusal(const TcpPeer& peer) const {
  const PlaceCounts& all = books_->all;
  if (all.served() >= limit_) {
    return fmt::format(
        "all {} connections of this server are in use; close another client or raise the limit",
        limit_);
  }
  if (counts_of(peer.net).stranger >= share_) {
    return fmt::format(
        "{} has {} connections, as many as one address may have without the control token; close "
        "another client there, or show the token",
        peer.net.text(), share_);
  }
  return fmt::format(
      "all {} connections for clients without the control token are in use; the rest is kept for "
      "the server's own host and for those who have the token",
      strangers_most());
}

ConnectionSlotPtr ConnectionTable::try_enter(const TcpPeer& peer) {
  if (slots_.size() >= forget_at_) {
    std::erase_if(slots_, [](const auto& slot) { return slot.expired(); });
    forget_at_ = std::max<std::size_t>(64, slots_.size() * 2);
  }
  const Place place = place_for(peer);
  if (place == Place::refused) {
    // Strangers' refusals do not take the own host's.
    const std::size_t mine = counts_of(peer.net).refused;
    const std::size_t own = counts_of(PeerNet::own_host()).refused;
    const std::size_t rivals = peer.on_own_host ? own : books_->all.refused - own;
    if (rivals >= limits_.refusals) return nullptr;
    if (!peer.on_own_host && mine >= limits_.refusals_of_peer) return nullptr;
  }
  const bool needs_reason = place == Place::refused || place == Place::on_trial;
  ConnectionSlotPtr slot(
      new ConnectionSlot(books_, peer, place, needs_reason ? refusal(peer) : std::string()));
  slots_.push_back(slot);
  return slot;
}

// An owner may end, and so may its slot, within the call.
template <typename Do>
void ConnectionTable::for_each(const Do& act) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const ConnectionSlotPtr slot = slots_[i].lock();
    if (slot == nullptr) continue;
    if (const auto owner = slot->owner.lock()) act(*owner, *slot);
  }
}

void ConnectionTable::close_all() {
  for_each([](Connection& owner, ConnectionSlot&) { owner.close(); });
}

void ConnectionTable::check_all(std::chrono::steady_clock::time_point now) {
  for_each([now](Connection& owner, ConnectionSlot&) { owner.check(now); });
}

std::vector<std::string> ConnectionTable::close_ended(UtcTime now) {
  std::vector<std::string> peers;
  for_each([&](Connection& owner, ConnectionSlot& slot) {
    if (now <= slot.peer_.certificate_ends) return;
    slot.peer_.certificate_ends = UtcTime::max();  // told once
    peers.push_back(slot.peer_.text);
    owner.close();
  });
  return peers;
}

}  // namespace skerry::server
