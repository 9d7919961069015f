// AuditLog: the audit file of a running server.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "protocol/quantity/time.hpp"
#include "server/audit/audit_chain.hpp"
#include "server/core/audit_port.hpp"

namespace skerry::server {

// Appends entries to a file, which goes on from run to run, by a thread of its own.  They are on
// the disk some milliseconds later; a disk that takes nothing is asked again every kAgain, and
// what does not wait any more (kMostWaiting) is counted and told by an entry once it takes again.
// Whoever sends more than kMostAtOnce and then kMostASecond of a kind has the rest counted in one
// entry, so that refusals cannot push changes out.
//
// Thread: any.
class AuditLog final : public AuditPort {
 public:
  static constexpr std::size_t kMostWaiting = 4096;  // entries
  static constexpr std::size_t kMostText = 512;      // bytes of each text of an entry
  static constexpr std::size_t kMostKnown = 4096;    // who is at some place
  static constexpr double kMostAtOnce = 1000.0, kMostASecond = 100.0;
  static constexpr std::chrono::milliseconds kAgain{1000};
  // Changes are told up to a second late, when whoever made them may have left.
  static constexpr std::chrono::seconds kRemembered{10};

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

  // Of what is on the disk.
  AuditHead head() const;

 private:
  struct Waiting {
    AuditEntry entry;
    UtcTime utc;
  };
  struct Budget {
    double left = kMostAtOnce;
    std::chrono::steady_clock::time_point looked{};
    std::uint64_t left_out = 0;
  };
  struct Known {
    std::string who;
    std::optional<std::chrono::steady_clock::time_point> gone;
  };
  void open();
  bool is_begin_of_entry() const;
  void run();
  // Under the lock.
  bool is_in_budget(AuditEntry::Kind kind);
  static void refill(Budget& budget);
  void wait_for_disk(AuditEntry entry);
  void tell_left_out();
  void drop_the_gone();
  // False: the disk took none of it, and the file is as before.
  bool write(const std::deque<Waiting>& entries);
  void tell_disk(bool takes);

  const std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;  // of the file's whole lines
  bool is_told_ = false;    // that the disk takes nothing

  mutable std::mutex mutex_;  // over what follows
  std::condition_variable change_;
  std::deque<Waiting> waiting_;
  std::uint64_t missing_ = 0;  // that waited in vain
  std::array<Budget, 5> budgets_;
  std::map<std::string, Known> known_;  // by place
  AuditHead head_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace skerry::server
