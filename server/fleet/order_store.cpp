#include "server/fleet/order_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "server/fleet/until_answered.hpp"

namespace skerry::fleet {
namespace {

constexpr std::size_t kPage = 500;                  // keys of one answer
constexpr std::size_t kMostOrders = 1'000'000;      // of an exercise: a week of ten a second
constexpr std::size_t kMostOrderBytes = 256 << 20;  // of all

// Places of what a transaction reads.
constexpr std::size_t kFoundLeader = 0, kFoundGrant = 1, kFoundOrder = 2;

Condition led_by(const LogKeys& keys, Epoch epoch) {
  return {keys.name(kLeader), Condition::Of::created, epoch};
}

StoreError deposed(Epoch epoch, const std::optional<KeyValue>& leader) {
  if (!leader)
    return {Trouble::deposed,
            fmt::format("nobody leads the exercise: its leader of epoch {} has lost it", epoch),
            false};
  return {Trouble::deposed,
          fmt::format("host {} leads the exercise with epoch {}: epoch {} is over", leader->value,
                      leader->created, epoch),
          false};
}

// Why a transaction that needed this epoch and this grant did not hold.
StoreError not_held(Epoch epoch, Revision grant, const TransactionReply& reply) {
  const auto& leader = reply.found[kFoundLeader];
  if (!leader || leader->created != epoch) return deposed(epoch, leader);
  const auto& found = reply.found[kFoundGrant];
  return {Trouble::overtaken,
          fmt::format("the grant in force is that of revision {}, no longer that of {}",
                      found ? found->modified : 0, grant),
          false};
}

StoreError asked_wrongly(std::string text) { return {Trouble::broken, std::move(text), false}; }

}  // namespace

Transaction transaction_of(const LogKeys& keys, const OrderWish& wish) {
  Transaction t;
  t.conditions = {led_by(keys, wish.epoch),
                  {keys.grant(), Condition::Of::modified, wish.grant},
                  {keys.order(wish.id), Condition::Of::created, 0}};
  t.puts = {{keys.order(wish.id), order_value(wish.epoch, wish.tick, wish.by, wish.order), 0}};
  t.reads = {keys.name(kLeader), keys.grant(), keys.order(wish.id)};
  return t;
}

StoreResult<Appended> appended(const OrderWish& wish, const TransactionReply& reply) {
  const auto& order = reply.found[kFoundOrder];
  if (!order) return Failure{not_held(wish.epoch, wish.grant, reply)};
  const auto seen = order_of(*order, wish.id);
  if (!seen) return Failure{seen.error()};
  if (seen->by != wish.by || seen->order != wish.order)
    return Failure{
        StoreError{Trouble::id_taken,
                   fmt::format("id {} is that of another order, by host {} in revision {}: give "
                               "each order an id of its own",
                               wish.id, seen->by, seen->revision),
                   false}};
  return Appended{seen->revision, seen->tick, !reply.done};
}

Transaction transaction_of(const LogKeys& keys, const GrantWish& wish) {
  Transaction t;
  t.conditions = {led_by(keys, wish.epoch), {keys.grant(), Condition::Of::modified, wish.previous}};
  t.puts = {{keys.grant(), grant_value(wish.epoch, wish.to, wish.sent), 0}};
  t.reads = {keys.name(kLeader), keys.grant()};
  return t;
}

StoreResult<Granted> granted(const GrantWish& wish, const TransactionReply& reply) {
  const auto& grant = reply.found[kFoundGrant];
  if (grant && grant->value == grant_value(wish.epoch, wish.to, wish.sent))
    return Granted{grant->modified, !reply.done};
  return Failure{not_held(wish.epoch, wish.previous, reply)};
}

OrderStore::OrderStore(KeyStore& keys, StoreMark& mark, const std::string& exercise)
    : keys_(keys), mark_(mark), exercise_(exercise), names_(exercise) {
  if (!is_name(exercise))
    throw std::invalid_argument(fmt::format(
        "exercise \"{}\": expected 1 to {} letters, digits and . _ -", exercise, kMostName));
}

StoreResult<TransactionReply> OrderStore::transact(const Transaction& transaction,
                                                   HostTime deadline) {
  if (const auto trouble = mark_.trouble()) return Failure{*trouble};
  const StoreSeen before = mark_.seen();
  auto reply = until_answered(
      keys_, deadline, [&](HostTime attempt) { return keys_.transact(transaction, attempt); });
  if (!reply) return reply;
  if (const auto trouble = mark_.check(before, reply->header)) return Failure{*trouble};
  if (reply->found.size() != transaction.reads.size())
    return Failure{asked_wrongly("the store answered something else than it was asked")};
  return reply;
}

StoreResult<Revision> OrderStore::open(const std::string& mark_of_birth, HostTime deadline) {
  Transaction t;
  // A host that has seen the exercise does not begin it again.
  if (mark_.seen().born.empty()) {
    t.conditions = {{names_.born(), Condition::Of::created, 0}};
    t.puts = {{names_.born(), mark_of_birth, 0}};
  }
  t.reads = {names_.born()};
  const auto reply = transact(t, deadline);
  if (!reply) return Failure{reply.error()};
  if (const auto trouble = mark_.check_birth(reply->found[0])) return Failure{*trouble};
  return reply->header.revision;
}

StoreResult<Appended> OrderStore::append(const OrderWish& wish, HostTime deadline) {
  if (!is_name(wish.id))
    return Failure{asked_wrongly(fmt::format(
        "order id \"{}\": expected 1 to {} letters, digits and . _ -", wish.id, kMostName))};
  if (wish.order.size() > kMostOrder)
    return Failure{asked_wrongly(fmt::format("order {} has {} bytes, more than {}", wish.id,
                                             wish.order.size(), kMostOrder))};
  const auto reply = transact(transaction_of(names_, wish), deadline);
  if (!reply) return Failure{reply.error()};
  auto outcome = appended(wish, *reply);
  if (outcome) mark_.note_order(wish.id, outcome->revision);
  return outcome;
}

StoreResult<Granted> OrderStore::grant(const GrantWish& wish, HostTime deadline) {
  const auto reply = transact(transaction_of(names_, wish), deadline);
  if (!reply) return Failure{reply.error()};
  return granted(wish, *reply);
}

StoreResult<Revision> OrderStore::verify(HostTime deadline) {
  const StoreSeen before = mark_.seen();
  Transaction t;
  t.reads = {names_.born(), names_.order(before.last_id)};
  const auto reply = transact(t, deadline);
  if (!reply) return Failure{reply.error()};
  if (const auto trouble = mark_.check_birth(reply->found[0])) return Failure{*trouble};
  if (const auto trouble = mark_.check_last(before, reply->found[1])) return Failure{*trouble};
  return reply->header.revision;
}

// Grant, last order and revision are of one moment; the orders and holders of later pages may be
// of later ones.  As an order is never changed, those that were there at that moment are all there.
StoreResult<LogText> OrderStore::read(Revision from, HostTime deadline) {
  const StoreSeen before = mark_.seen();
  Transaction t;
  t.reads = {names_.born(), names_.order(before.last_id), names_.grant()};
  const auto first = transact(t, deadline);
  if (!first) return Failure{first.error()};
  if (const auto trouble = mark_.check_birth(first->found[0])) return Failure{*trouble};
  if (const auto trouble = mark_.check_last(before, first->found[1])) return Failure{*trouble};

  LogText text;
  text.at = first->header.revision;
  if (const auto& key = first->found[2]; key && key->modified >= from) {
    const auto grant = grant_of(*key);
    if (!grant) return Failure{grant.error()};
    text.grant = *grant;
  }
  std::size_t orders = 0, bytes = 0;
  for (const std::string& prefix : {names_.names(), names_.orders()}) {
    std::string begin = prefix;
    for (bool more = true; more;) {
      auto page = until_answered(keys_, deadline, [&](HostTime attempt) {
        return keys_.range(begin, end_of_prefix(prefix), kPage, attempt);
      });
      if (!page) return Failure{page.error()};
      if (const auto trouble = mark_.check(before, page->header)) return Failure{*trouble};
      more = page->more && !page->found.empty();
      if (more) begin = page->found.back().key + '\0';
      for (KeyValue& key : page->found) {
        bytes += key.value.size();
        if (++orders > kMostOrders || bytes > kMostOrderBytes)
          return Failure{asked_wrongly(fmt::format(
              "the log of exercise {} has more than {} orders or {} bytes: start another exercise",
              exercise_, kMostOrders, kMostOrderBytes))};
        if (key.modified < from || key.modified > text.at) continue;
        auto event = names_.event_of({std::move(key), false});
        if (!event) return Failure{event.error()};
        if (!*event) continue;
        if (auto* order = std::get_if<OrderSeen>(&**event))
          text.orders.push_back(std::move(*order));
        if (auto* holder = std::get_if<HolderSeen>(&**event))
          text.holders.push_back(std::move(*holder));
      }
    }
  }
  const auto earlier = [](const auto& a, const auto& b) { return a.revision < b.revision; };
  std::sort(text.orders.begin(), text.orders.end(), earlier);
  std::sort(text.holders.begin(), text.holders.end(), earlier);
  if (!text.orders.empty()) mark_.note_order(text.orders.back().id, text.orders.back().revision);
  return text;
}

}  // namespace skerry::fleet
