#include "server/fleet/store_mark.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skerry::fleet {

StoreSeen StoreMark::seen() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

std::optional<StoreError> StoreMark::trouble() const {
  const std::lock_guard lock(mutex_);
  return went_back_;
}

StoreError StoreMark::went_back(std::string text) {
  if (!went_back_)
    went_back_ = StoreError{Trouble::went_back,
                            std::move(text) +
                                "; orders may be lost: end the exercise on all hosts, and start it "
                                "again from a recording or under another name",
                            false};
  return *went_back_;
}

std::optional<StoreError> StoreMark::check(const StoreSeen& before, const StoreHeader& header) {
  const std::lock_guard lock(mutex_);
  if (went_back_) return went_back_;
  if (before.cluster != 0 && header.cluster != before.cluster)
    return went_back(fmt::format(
        "the store is cluster {:x}, and was {:x}: it is another one, or restored from a backup",
        header.cluster, before.cluster));
  if (header.revision < before.revision)
    return went_back(
        fmt::format("the store is at revision {}, and was at {}: it is restored from an old backup",
                    header.revision, before.revision));
  seen_.cluster = header.cluster;
  seen_.revision = std::max(seen_.revision, header.revision);
  return std::nullopt;
}

std::optional<StoreError> StoreMark::check_birth(const std::optional<KeyValue>& born) {
  const std::lock_guard lock(mutex_);
  if (went_back_) return went_back_;
  if (seen_.born.empty() && born) {
    seen_.born = born->value;
    seen_.born_at = born->created;
  }
  if (seen_.born.empty() || (born && born->value == seen_.born && born->created == seen_.born_at))
    return std::nullopt;
  return went_back(fmt::format(
      "the exercise in the store was begun in revision {} ({}), and was in {} ({}): it "
      "was deleted, or is another one",
      born ? born->created : 0, born ? born->value : "not at all", seen_.born_at, seen_.born));
}

std::optional<StoreError> StoreMark::check_last(const StoreSeen& before,
                                                const std::optional<KeyValue>& order) {
  const std::lock_guard lock(mutex_);
  if (went_back_) return went_back_;
  if (before.last_at == 0 || (order && order->created == before.last_at)) return std::nullopt;
  return went_back(
      fmt::format("order {} of revision {} is not in the store any more: it is restored from an "
                  "old backup",
                  before.last_id, before.last_at));
}

void StoreMark::note_order(const std::string& id, Revision revision) {
  const std::lock_guard lock(mutex_);
  if (revision <= seen_.last_at) return;
  seen_.last_id = id;
  seen_.last_at = revision;
}

}  // namespace skerry::fleet
