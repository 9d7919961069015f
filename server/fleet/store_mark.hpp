// StoreMark: what a host has seen of its store, by which it finds out that the store went back.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

// Worth keeping from run to run: a host that knows nothing cannot tell an old store from a new one.
struct StoreSeen {
  std::uint64_t cluster = 0;  // 0: none yet
  Revision revision = 0;      // the highest of a linearizable answer
  std::string born;           // the exercise's mark of birth; empty: not seen
  Revision born_at = 0;
  std::string last_id;  // of the newest order seen
  Revision last_at = 0;
};

// A store that was restored from a backup has another cluster, or a lower revision, or, once it has
// gone on from there, lacks the newest order that was seen.  All three are looked at, and what was
// found stays: no call after it succeeds, until the host is started anew with an empty mark.
// Thread: any.
class StoreMark {
 public:
  explicit StoreMark(StoreSeen seen = {}) : seen_(std::move(seen)) {}

  StoreSeen seen() const;
  // Of a linearizable answer to what was asked when `before` had been seen.
  std::optional<StoreError> check(const StoreSeen& before, const StoreHeader& header);
  // `born` as it stands in the store; nothing: there is none.
  std::optional<StoreError> check_birth(const std::optional<KeyValue>& born);
  // The key of order before.last_id, as it stands in the store now.
  std::optional<StoreError> check_last(const StoreSeen& before,
                                       const std::optional<KeyValue>& order);
  void note_order(const std::string& id, Revision revision);
  std::optional<StoreError> trouble() const;

 private:
  StoreError went_back(std::string text);  // mutex_ held

  mutable std::mutex mutex_;
  StoreSeen seen_;
  std::optional<StoreError> went_back_;
};

}  // namespace skerry::fleet
