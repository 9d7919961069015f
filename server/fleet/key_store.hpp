// KeyStore: the few things that the fleet asks of its store, as etcd does them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "server/fleet/host_clock.hpp"
#include "server/fleet/store_error.hpp"

namespace skerry::fleet {

// Number of a change of the store, counted from 1; 0: none.  All changes of all keys are in one
// order, and what changed at once has one revision.
using Revision = std::int64_t;
using LeaseId = std::int64_t;

// What every answer says of the store.
struct StoreHeader {
  std::uint64_t cluster = 0;
  std::uint64_t member = 0;
  Revision revision = 0;  // of the store's last change
};

struct KeyValue {
  std::string key, value;
  Revision created = 0;
  Revision modified = 0;
  LeaseId lease = 0;  // 0: none
};

// A key's revision is this one; 0: there is no such key.
struct Condition {
  enum class Of : std::uint8_t { created, modified };
  std::string key;
  Of of = Of::created;
  Revision is = 0;
};

struct Put {
  std::string key, value;
  LeaseId lease = 0;
};

// At once or not at all: if all conditions hold, the puts.  The reads are done in either case,
// after the puts.
struct Transaction {
  std::vector<Condition> conditions;
  std::vector<Put> puts;
  std::vector<std::string> reads;
};

struct TransactionReply {
  StoreHeader header;
  bool done = false;                           // all conditions held
  std::vector<std::optional<KeyValue>> found;  // one for each read
};

struct RangeReply {
  StoreHeader header;
  std::vector<KeyValue> found;  // by key
  bool more = false;            // behind the last one
};

struct LeaseReply {
  StoreHeader header;
  LeaseId id = 0;
  std::chrono::seconds ttl{0};  // from when the store had the request; 0: there is no such lease
};

struct KeyEvent {
  KeyValue key;  // of a deleted one: its key, and `modified`: when
  bool deleted = false;
};

struct WatchStep {
  StoreHeader header;            // not linearizable: a member that lags has a lower revision
  std::vector<KeyEvent> events;  // by revision; all of each
};

template <typename T>
using StoreResult = Result<T, StoreError>;

// A stream of the changes of keys.  Ends with the object.  Thread: one at a time.
class KeyWatch {
 public:
  virtual ~KeyWatch() = default;
  // The next changes, at the latest at the deadline; without events: there were none until then.
  // After an error the stream has ended.
  virtual StoreResult<WatchStep> next(HostTime deadline) = 0;
};

// Each call is one attempt at one member, and ends by its deadline.  Transactions and ranges are
// linearizable: an answer knows of all that was answered anywhere before it was asked for.
// Thread: one at a time.
class KeyStore {
 public:
  virtual ~KeyStore() = default;

  virtual StoreResult<TransactionReply> transact(const Transaction& transaction,
                                                 HostTime deadline) = 0;
  // Keys from `begin` to before `end`, at most `most`.
  virtual StoreResult<RangeReply> range(const std::string& begin, const std::string& end,
                                        std::size_t most, HostTime deadline) = 0;
  virtual StoreResult<LeaseReply> grant_lease(std::chrono::seconds ttl, HostTime deadline) = 0;
  virtual StoreResult<LeaseReply> keep_lease(LeaseId id, HostTime deadline) = 0;
  virtual StoreResult<StoreHeader> revoke_lease(LeaseId id, HostTime deadline) = 0;
  // Changes of the keys that begin so, from a revision on.
  virtual std::unique_ptr<KeyWatch> watch(const std::string& prefix, Revision from) = 0;

  // The next attempt is made at another member.
  virtual void turn() = 0;
  virtual std::size_t members() const = 0;

  virtual HostTime now() const = 0;
  virtual void wait_until(HostTime time) = 0;
};

// The first key behind all that begin with `prefix`.  Requires: it does not end in 0xFF.
inline std::string end_of_prefix(std::string prefix) {
  prefix.back() = static_cast<char>(static_cast<unsigned char>(prefix.back()) + 1);
  return prefix;
}

}  // namespace skerry::fleet
