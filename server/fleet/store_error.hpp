// StoreError: why the fleet's store did not do what it was asked.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace skerry::fleet {

// Each asks for something else of whoever reads it.
enum class Trouble : std::uint8_t {
  unreachable,  // no member could be connected to: network, addresses, all members down
  no_majority,  // a member answers, but too few of them agree: wait, or start the others
  slow,         // a member is connected and did not answer in time
  full,         // the store takes no more (etcd's NOSPACE alarm): compact, defragment, disarm
  refused,      // certificate, user or permission
  went_back,    // the store is not the one that was seen: another, or restored from an old backup
  compacted,    // what was to be watched is compacted away: it is read instead
  deposed,      // another leader, or none, holds the exercise: nothing was appended
  overtaken,    // a newer grant is in force: nothing was appended; append under that one
  id_taken,     // the id belongs to another order: nothing was appended
  broken,       // the store holds what it should not, or was asked what it cannot
};

std::string_view name_of(Trouble trouble);

struct StoreError {
  Trouble trouble = Trouble::broken;
  std::string text;         // what was wrong, where, and what to do
  bool maybe_done = false;  // whether it was done is not known: ask again with the same id

  friend bool operator==(const StoreError&, const StoreError&) = default;
};

// Whether another member, or the same one a moment later, may do it.
constexpr bool may_pass(Trouble trouble) {
  return trouble == Trouble::unreachable || trouble == Trouble::no_majority ||
         trouble == Trouble::slow;
}

// Of two attempts that both failed, what says more: an answer more than silence.
const StoreError& more_telling(const StoreError& one, const StoreError& other);

}  // namespace skerry::fleet
