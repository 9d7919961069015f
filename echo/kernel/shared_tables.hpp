// SharedTables: tables made once for all who ask for the same.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace skerry::echo {

// A table lives as long as somebody holds it.  Of those who ask for the same one at the same time
// one makes it and the others wait; nobody waits for a table that he has not asked for.
// Key: comparable for equality, for tens of keys.  Thread: any.
template <typename Key, typename Table>
class SharedTables {
 public:
  // `make()` returns the Table of that key.
  template <typename Make>
  std::shared_ptr<const Table> get(const Key& key, Make&& make) {
    const std::shared_ptr<Entry> entry = entry_of(key);
    const std::lock_guard lock(entry->making);
    if (auto table = entry->table.lock()) return table;
    // Not make_shared: the weak pointer would hold the table's memory.
    const std::shared_ptr<const Table> made(new Table(std::forward<Make>(make)()));
    entry->table = made;
    return made;
  }

 private:
  struct Entry {
    explicit Entry(const Key& of) : key(of) {}
    const Key key;
    std::mutex making;
    std::weak_ptr<const Table> table;  // guarded by making
  };

  std::shared_ptr<Entry> entry_of(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const auto& e) { return e->key == key; });
    if (found != entries_.end()) return *found;
    // Nobody can be making a table of which only this list knows.
    std::erase_if(entries_, [](const auto& e) {
      if (e.use_count() > 1) return false;
      const std::unique_lock making(e->making, std::try_to_lock);  // what its maker wrote is seen
      return making && e->table.expired();
    });
    entries_.push_back(std::make_shared<Entry>(key));
    return entries_.back();
  }

  std::mutex mutex_;
  std::vector<std::shared_ptr<Entry>> entries_;
};

// The same, but the `kMost` tables asked for last also stay.
template <typename Key, typename Table, std::size_t kMost>
class KeptTables {
 public:
  template <typename Make>
  std::shared_ptr<const Table> get(const Key& key, Make&& make) {
    auto table = shared_.get(key, std::forward<Make>(make));
    const std::lock_guard lock(mutex_);
    const auto found = std::find(last_.begin(), last_.end(), table);
    if (found == last_.end()) {
      if (last_.size() == kMost) last_.pop_back();
      last_.insert(last_.begin(), table);
    } else {
      std::rotate(last_.begin(), found, found + 1);
    }
    return table;
  }

 private:
  SharedTables<Key, Table> shared_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<const Table>> last_;  // asked for last first
};

}  // namespace skerry::echo
