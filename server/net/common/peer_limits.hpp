// PeerLimits: what one peer may have of a server that many share.  All constants stand here.
#pragma once

#include <chrono>
#include <cstddef>

namespace skerry::server {

// A peer is the server's own host (all of loopback), an IPv4 address, or an IPv6 network of 64
// bits, because one host has as many IPv6 addresses as it likes (PeerNet).  A stranger is a peer on
// another host that has shown no good token on this connection.
struct PeerLimits {
  // --- Places: connections out of NetConfig::max_connections.

  // So many in a hundred are for the server's own host and for connections that have shown the
  // control token; at least one, if there are two.  The operator gets in whatever strangers do.
  std::size_t reserve_percent = 12;
  // One stranger's peer has at most so many in a hundred, at least one: 64 of 256.  A classroom
  // behind one address has some three connections a browser; four attackers fill the strangers'
  // places, and still lock nobody out who has the token.
  std::size_t share_percent = 25;
  // Of the reserve so many in a hundred are lent to strangers who find no other place, for
  // trial_time: long enough to show the token, which a native client does after the connection is
  // there.
  std::size_t trial_percent = 25;
  std::size_t trials_of_peer = 2;
  // So many connections beyond what is served are held open for a moment, to be answered in full;
  // others are told in one packet and closed.  At most refusals_of_peer of them are of one
  // stranger's peer; the own host has as many again for itself.
  std::size_t refusals = 32;
  std::size_t refusals_of_peer = 4;

  // --- Times.  All are noticed up to 0.1 s late.

  std::chrono::milliseconds trial_time{2'000};
  // From the first byte of a TLS handshake to its end, and for that first byte where TLS is asked
  // for.
  std::chrono::milliseconds opening_time{3'000};
  // A native connection that has asked for nothing, and an HTTP connection that has not begun its
  // first request, end after this.  Clients ask within a second of Hello.
  std::chrono::milliseconds silent_time{10'000};
  // From the first byte of an HTTP request to its last.  It fits into a few packets; on a line of
  // 9,600 bit/s a browser's takes a second.
  std::chrono::milliseconds request_time{5'000};
  // A stranger that has taken nothing of what was written to it for so long.  A display that stalls
  // for some seconds goes on with a gap; one that stalls for longer must connect again.
  std::chrono::milliseconds unread_time{30'000};

  // --- Changes: Set, TargetOrder, Record, Playback, and those by Signal K, whether they are obeyed
  // or not.

  // Of a peer on another host.  A hand at a slider makes 60 a second: a class of 16 consoles behind
  // one address passes, all dragging at once.  A change takes the server some 10 us.
  double changes_per_second = 1'000.0;
  double changes_burst = 2'000.0;
  // Of the server's own host, where whole classes and load tests run: a fifth of a core at worst.
  double own_changes_per_second = 20'000.0;
  double own_changes_burst = 40'000.0;
  // Sign-ins by password or class code, right or wrong, of a peer, also of the own host.  A class
  // of 40 behind one address signs in at once; after that one guesses 20 times a minute.
  double sign_ins_per_second = 1.0 / 3.0;
  double sign_ins_burst = 40.0;
  // TLS handshakes begun by a peer on another host, and on the server's own.  Each takes the
  // network thread some 0.2 ms; a class of 64 browsers opens some three connections each at once.
  double handshakes_per_second = 50.0;
  double handshakes_burst = 400.0;
  double own_handshakes_per_second = 500.0;
  double own_handshakes_burst = 2'000.0;
  // Peers whose budgets are kept apart: a peer takes 100 bytes.  More than can be connected at
  // once; a budget that is full again is forgotten.
  std::size_t most_budgets = 4'096;

  // --- Views of a radar, of which there are 31 besides the shared one.

  // Opened by one peer on another host, and by all on other hosts together: all of them have shown
  // the one control token, as opening a view needs it.  Of 31 a second peer finds 12 and the own
  // host 3 whatever one does.  The own host may open all.
  std::size_t views_of_peer = 16;
  std::size_t views_of_token = 28;

  // --- The log.

  // One line at most in this time about each limit; what was not written is counted in the next.
  std::chrono::seconds log_period{60};
};

}  // namespace skerry::server
