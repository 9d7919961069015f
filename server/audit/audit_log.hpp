// AuditLog: the audit file of a running server.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "protocol/quantity/time.hpp"
#include "server/audit/audit_chain.hpp"
#include "server/core/audit_port.hpp"

namespace skerry::server {

// Appends entries to a file, which goes on from run to run, by a thread of its own.  They are on
// the disk some milliseconds later; a disk that takes nothing is asked again every kAgain.  What
// finds no room among what waits (kMostWaiting; half of it is kept from refusals) is counted and
// told by an entry once the disk takes again.
//
// Whoever makes too many entries has the rest counted in one, with her address: so that nobody can
// push out what others do, and refusals, which cost a stranger nothing, cannot fill the disk.
//
// Thread: any.
class AuditLog final : public AuditPort {
 public:
  static constexpr std::size_t kMostWaiting = 4096;  // entries
  static constexpr std::size_t kMostText = 512;      // bytes of each text of an entry
  static constexpr std::size_t kMostKnown = 8192;    // requests that are being carried out
  static constexpr std::size_t kMostPeers = 1024;    // addresses looked at one by one
  static constexpr std::chrono::milliseconds kAgain{1000};

  // At once, and then a second: of changes, requests and what the server does; of refusals and
  // sign-ins.  From one address, and in all.
  struct Pace {
    double at_once, a_second;
  };
  static constexpr Pace kDeeds{500, 20}, kAllDeeds{4000, 200};
  static constexpr Pace kRefusals{50, 1}, kAllRefusals{500, 5};

  // Opens the file, or makes it.  An entry at its end that was not finished is cut off, and the
  // first new entry says so.
  // Error: std::runtime_error naming the file: it cannot be opened, another server has it, or its
  // last line is no entry.
  explicit AuditLog(std::filesystem::path file);
  // Writes what waits, if the disk takes it at once.
  ~AuditLog() override;

  void add(AuditEntry entry) override;
  void know(const std::string& from, const std::string& who) override;
  void forget(const std::string& from) override;
  std::string who_at(const std::string& from) const override;

  // Of what is on the disk.
  AuditHead head() const;

 private:
  struct Waiting {
    AuditEntry entry;
    UtcTime utc;
  };
  class Budget {
   public:
    explicit Budget(Pace pace) : pace_(pace), left_(pace.at_once) {}
    bool has(std::chrono::steady_clock::time_point now);
    void take() { left_ -= 1.0; }
    bool is_full() const { return left_ >= pace_.at_once; }
    std::uint64_t left_out = 0;

   private:
    Pace pace_;
    double left_;
    std::chrono::steady_clock::time_point looked_{};
  };
  void open();
  // The file's last `bytes` of `size`.
  std::string read_tail(std::uint64_t size, std::uint64_t bytes) const;
  void run();
  // Under the lock.
  bool is_in_budget(const AuditEntry& entry);
  bool wait_for_disk(AuditEntry entry);  // false: there is no room
  void tell_left_out();
  // False: the disk took none of it, and the file is as before.
  bool write(const std::deque<Waiting>& entries);
  void tell_disk(bool takes);

  const std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;  // of the file's whole lines
  bool has_rest_ = false;   // behind them there is the begin of one that was not taken
  bool is_told_ = false;    // that the disk takes nothing

  mutable std::mutex mutex_;  // over what follows
  std::condition_variable change_;
  std::deque<Waiting> waiting_;
  std::uint64_t missing_ = 0;  // that waited in vain
  Budget all_deeds_{kAllDeeds}, all_refusals_{kAllRefusals};
  std::map<std::pair<bool, std::string>, Budget> budgets_;  // by whether a refusal, and address
  std::map<std::string, std::string> known_;                // who, by place
  AuditHead head_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace skerry::server
