// until_answered: one call of the store, tried at one member after another until its deadline.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

// A member that is connected and says nothing for so long (stopped, cut off) is left for the next.
// Ten times etcd's p99 of a put (README.md "Measured"); less would ask twice for no reason, and an
// election (1 s) is waited for by asking again anyway.
constexpr std::chrono::milliseconds kAttempt{250};
// Between rounds in which every member failed at once, as those that are not running do.
constexpr std::chrono::milliseconds kRoundPause{20};

// `call` is given each attempt's deadline and must be safe to repeat.  Error: the most telling of
// all attempts; maybe_done, if any of them may have been.
template <typename Call>
auto until_answered(KeyStore& keys, HostTime deadline, Call call) -> decltype(call(deadline)) {
  std::optional<StoreError> told;
  bool maybe_done = false;
  for (std::size_t failed = 0, refusals = 0;;) {
    auto reply = call(std::min(deadline, keys.now() + kAttempt));
    if (reply) return reply;
    maybe_done = maybe_done || reply.error().maybe_done;
    told = told ? more_telling(*told, reply.error()) : reply.error();
    // One member may have a wrong certificate while the others are well.
    const bool refused = reply.error().trouble == Trouble::refused;
    const bool pass = may_pass(reply.error().trouble) || (refused && ++refusals < keys.members());
    if (pass) keys.turn();
    if (pass && ++failed % keys.members() == 0)
      keys.wait_until(std::min(deadline, keys.now() + kRoundPause));
    if (!pass || keys.now() >= deadline) {
      told->maybe_done = maybe_done;
      return Failure{*told};
    }
  }
}

}  // namespace skerry::fleet
