// ConnectionTable: who gets a place, and the end of them all when the server stops.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/net/common/peer_limits.hpp"
#include "server/net/common/peer_net.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {

// Anything that holds a socket of a client.
class Connection {
 public:
  virtual ~Connection() = default;
  // Ends it at once: all its operations end with an error and let it go.
  virtual void close() = 0;
  // Ends it if the time for something is over.  Called ten times a second.
  virtual void check(std::chrono::steady_clock::time_point) {}
};

enum class Place {
  own_host,  // a peer on the server's own host
  trusted,   // has shown a good token or certificate
  stranger,
  on_trial,  // a stranger in the reserve, who must show the token at once
  refused,   // admitted only to be told why not
};

struct PlaceCounts {
  std::size_t own_host = 0, trusted = 0, stranger = 0, on_trial = 0, refused = 0;

  std::size_t& of(Place place);
  std::size_t served() const { return own_host + trusted + stranger + on_trial; }
};

// A place at the table, held by the connection that owns the socket and handed on when HTTP becomes
// WebSocket.
class ConnectionSlot {
 public:
  ~ConnectionSlot();
  ConnectionSlot(const ConnectionSlot&) = delete;
  ConnectionSlot& operator=(const ConnectionSlot&) = delete;

  const TcpPeer& peer() const { return peer_; }
  Place place() const { return place_; }
  // Why a connection that is refused or on trial got no place of its own, and what to do.
  const std::string& reason() const { return reason_; }
  bool is_trusted() const { return place_ == Place::own_host || place_ == Place::trusted; }
  // The connection has shown a good token or certificate.
  void trust();
  // The connection is under TLS, and its client has shown this certificate (TcpPeer).
  void secure(std::string certificate, UtcTime certificate_ends) {
    peer_.is_secure = true;
    peer_.certificate = std::move(certificate);
    peer_.certificate_ends = certificate_ends;
  }

  std::weak_ptr<Connection> owner;

 private:
  friend class ConnectionTable;
  struct Books {
    PlaceCounts all;
    std::map<PeerNet, PlaceCounts> by_peer;  // who has at least one
    void add(const PeerNet& net, Place place);
    void remove(const PeerNet& net, Place place);
  };
  ConnectionSlot(std::shared_ptr<Books> books, TcpPeer peer, Place place, std::string reason);

  std::shared_ptr<Books> books_;
  TcpPeer peer_;
  Place place_;
  std::string reason_;
};
using ConnectionSlotPtr = std::shared_ptr<ConnectionSlot>;

// Bounded: nothing is kept of a peer that has no connection.  Thread: net-0.
class ConnectionTable {
 public:
  // `limit`: of all connections that are served.
  ConnectionTable(std::size_t limit, const PeerLimits& limits);

  // nullptr if not even a refusal can be afforded: refusal() says what to tell.
  ConnectionSlotPtr try_enter(const TcpPeer& peer);
  // Why the peer would get no place now, and what to do.
  std::string refusal(const TcpPeer& peer) const;

  void close_all();
  void check_all(std::chrono::steady_clock::time_point now);
  // Ends the connections whose client's certificate has ended; gives their peers.
  std::vector<std::string> close_ended(UtcTime now);

  std::size_t limit() const { return limit_; }
  // Of all places, those that strangers together, and one stranger's peer, can have.
  std::size_t strangers_most() const { return limit_ - reserve_; }
  std::size_t share() const { return share_; }
  std::size_t trials_most() const { return trials_; }
  const PlaceCounts& counts() const { return books_->all; }
  std::size_t peers() const { return books_->by_peer.size(); }

 private:
  using Books = ConnectionSlot::Books;
  Place place_for(const TcpPeer& peer) const;
  PlaceCounts counts_of(const PeerNet& net) const;
  template <typename Do>
  void for_each(const Do& act);

  std::size_t limit_, reserve_, share_, trials_;
  PeerLimits limits_;
  std::shared_ptr<Books> books_ = std::make_shared<Books>();
  std::vector<std::weak_ptr<ConnectionSlot>> slots_;
  std::size_t forget_at_ = 64;  // slots_ is swept when it has so many
};

}  // namespace skerry::server
