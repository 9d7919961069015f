// OrderStore: the ordered log of one exercise in a store that several hosts share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/fleet/log_event.hpp"
#include "server/fleet/log_keys.hpp"
#include "server/fleet/store_mark.hpp"

namespace skerry::fleet {

// An order to append, by any host, under the grant that it knows.
struct OrderWish {
  std::string id;      // the caller's: the same for every attempt, and for no other order
  std::string by;      // host
  std::string order;   // at most kMostOrder
  Epoch epoch = 0;     // of the leader
  Revision grant = 0;  // of the grant in force
  Tick tick = 0;       // the first it holds for: that behind the grant
};

struct Appended {
  Revision revision = 0;
  Tick tick = 0;
  bool was_there = false;  // by a former attempt
};

// A grant to make, by the leader.
struct GrantWish {
  Epoch epoch = 0;
  Revision previous = 0;  // of the grant that it follows; 0: it is the first
  Tick to = 0;
  Duration sent{0};  // the exercise's time by the leader's clock
  friend bool operator==(const GrantWish&, const GrantWish&) = default;
};

struct Granted {
  Revision revision = 0;
  bool was_there = false;
};

// All that is in the log at a revision.
struct LogText {
  std::vector<OrderSeen> orders;  // by revision
  std::optional<GrantSeen> grant;
  std::vector<HolderSeen> holders;
  Revision at = 0;
};

// An append does one of three things, atomically: it puts the order; it finds the order there, put
// by an attempt whose reply was lost, and tells that one's outcome; or it puts nothing, because
//   - another leader, or none, holds the exercise (deposed): the epoch never comes again, so what a
//     deposed leader has still under way can append nothing, however late it arrives; or
//   - a newer grant is in force (overtaken): hosts may have run past the order's tick.
// Both are for ever: an attempt whose reply is still missing then will not be done either.
//
// Orders are keys of their own, never changed or deleted: the log is whole after any compaction.
//
// Thread: one at a time, each with a KeyStore of its own; the mark is shared.
class OrderStore {
 public:
  // Error: std::invalid_argument, if the exercise's name is none.
  OrderStore(KeyStore& keys, StoreMark& mark, const std::string& exercise);

  // Before all else.  The first host's `mark` (of this exercise, and no other: a random number)
  // becomes the exercise's; all others find that one.
  StoreResult<Revision> open(const std::string& mark_of_birth, HostTime deadline);

  // Error: maybe_done, if whether it was appended is not known: append again with the same id.
  StoreResult<Appended> append(const OrderWish& wish, HostTime deadline);
  StoreResult<Granted> grant(const GrantWish& wish, HostTime deadline);

  // Orders, grant and holders of `from` and later, as of one revision.
  StoreResult<LogText> read(Revision from, HostTime deadline);

  // Whether the store is the one that was seen.  Gives its revision.
  StoreResult<Revision> verify(HostTime deadline);

  const LogKeys& keys() const { return names_; }

 private:
  StoreResult<TransactionReply> transact(const Transaction& transaction, HostTime deadline);

  KeyStore& keys_;
  StoreMark& mark_;
  const std::string exercise_;
  const LogKeys names_;
};

// What append() and grant() ask and how they read the answer.
Transaction transaction_of(const LogKeys& keys, const OrderWish& wish);
StoreResult<Appended> appended(const OrderWish& wish, const TransactionReply& reply);
Transaction transaction_of(const LogKeys& keys, const GrantWish& wish);
StoreResult<Granted> granted(const GrantWish& wish, const TransactionReply& reply);

}  // namespace skerry::fleet
