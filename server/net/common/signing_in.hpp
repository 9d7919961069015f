// Signing in by a password or a class code, over whatever protocol.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "server/net/common/net_context.hpp"

namespace skerry::server {

// What somebody shows.
struct Credentials {
  std::string name = {};
  std::string password = {};
  std::string class_code = {};  // if there is one, the password is not looked at
};

struct SignInOutcome {
  enum class Kind : std::uint8_t {
    signed_in,
    malformed,  // the name is none
    wrong,      // no such user or password, no such code
    too_often,  // this peer has tried too often
    busy,       // too many are waiting
    not_here,   // this server has no users
  };
  Kind kind = Kind::wrong;
  std::string text = {};  // why not
  std::optional<Gate::SignedIn> made = {};
};

// Tries them, and tells the audit what came of it: never a password, a code or a name that nobody
// has, for that may be a password, typed into the wrong field.  `from` is as the audit names the
// client.  Both kinds cost of the peer's sign-ins (PeerLimits).
// `done` is called once: at once, or when the password was tried.  Thread: net-0.
void sign_in(NetContext& context, const TcpPeer& peer, const std::string& from,
             Credentials credentials, std::function<void(SignInOutcome)> done);

}  // namespace skerry::server
