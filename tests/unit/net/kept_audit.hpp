#pragma once

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/core/audit_port.hpp"

namespace skerry::server {

// Keeps entries for a test to look at.
class KeptAudit : public AuditPort {
 public:
  void add(AuditEntry entry) override {
    const std::lock_guard lock(mutex_);
    entries_.push_back(std::move(entry));
  }
  void know(const std::string& from, const std::string& who) override {
    const std::lock_guard lock(mutex_);
    known_[from] = who;
    all_known_.push_back(who);
  }
  void forget(const std::string& from) override {
    const std::lock_guard lock(mutex_);
    known_.erase(from);
  }
  std::string who_at(const std::string& from) const override {
    const std::lock_guard lock(mutex_);
    const auto known = known_.find(from);
    return known == known_.end() ? "" : known->second;
  }
  std::vector<AuditEntry> entries() const {
    const std::lock_guard lock(mutex_);
    return entries_;
  }
  std::size_t known_now() const {
    const std::lock_guard lock(mutex_);
    return known_.size();
  }
  std::vector<std::string> all_known() const {
    const std::lock_guard lock(mutex_);
    return all_known_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<AuditEntry> entries_;
  std::map<std::string, std::string> known_;
  std::vector<std::string> all_known_;
};

}  // namespace skerry::server
