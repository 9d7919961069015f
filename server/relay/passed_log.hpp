// PassedLog: what the other server has done for consoles here, told to the log and the audit.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/core/audit_port.hpp"

namespace skerry::server {

struct PassedUp {
  std::string what, origin;
  std::string who = {};   // as PassedLog::who_at() had it when it was asked for
  std::string knob = {};  // which controls it turns; empty if it does anything else
};

// Which controls a Set turns; empty if it does anything else.
std::string knob_of(const wire::Set& set);

// Each is told by itself.  But a knob that one person goes on turning is told at once, and then
// once a second how often it was.
// Thread: any.  Time is passed in.
class PassedLog {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kEvery{1};

  explicit PassedLog(std::string upstream) : upstream_(std::move(upstream)) {}
  // Before anything is told.
  void set_audit(AuditPort* audit) { audit_ = audit; }

  // Who is asking by that connection.
  std::string who_at(const std::string& origin) const;
  void tell(const PassedUp& done, Time now);
  // A few times a second.
  void tell_late(Time now);

 private:
  void put_down(const PassedUp& done, std::uint32_t times);

  const std::string upstream_;
  AuditPort* audit_ = nullptr;
  std::mutex mutex_;
  PassedUp turned_;  // the newest of the knob that was turned last
  Time told_at_{};
  std::uint32_t untold_ = 0;  // times since
};

}  // namespace skerry::server
