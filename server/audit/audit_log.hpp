// AuditLog: the audit of a running server.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/audit/audit_file.hpp"
#include "server/core/audit_port.hpp"

namespace skerry::server {

// Numbers entries, keeps the newest in memory, hands them to a recorder and appends them to a file,
// which goes on from run to run; by a thread of its own.  They are on the disk some milliseconds
// later; a disk that takes nothing is asked again every kAgain.  What finds no room among what
// waits (kMostWaiting; half of it is kept from refusals) is counted and told by an entry once the
// disk takes again.
//
// Whoever makes too many entries has the rest counted in one, with her address: so that nobody can
// push out what others do, and refusals, which cost a stranger nothing, cannot fill the disk.
//
// Thread: any.
class AuditLog final : public AuditPort {
 public:
  static constexpr std::size_t kMostWaiting = 4096;  // entries
  static constexpr std::size_t kMostRecent = 1000;   // entries in memory that can be asked for
  static constexpr std::size_t kMostText = 512;      // bytes of each text of an entry
  static constexpr std::size_t kMostKnown = 8192;    // requests that are being carried out
  static constexpr std::size_t kMostPeers = 1024;    // addresses looked at one by one
  static constexpr std::chrono::milliseconds kAgain{1000};
  static constexpr std::chrono::seconds kMoveAgain{60};  // after a file could not be moved away

  // At once, and then a second: of changes, requests and what the server does; of refusals and
  // sign-ins.  From one address, and in all.
  struct Pace {
    double at_once, a_second;
  };
  static constexpr Pace kDeeds{500, 20}, kAllDeeds{4000, 200};
  static constexpr Pace kRefusals{50, 1}, kAllRefusals{500, 5};

  // Opens the file, or makes it; without one (an empty path) entries are in memory alone.  An entry
  // at its end that was not finished is cut off, and the first new entry says so.
  // A file of `roll_bytes` or more is moved away, to its name and the number of its last entry, and
  // the next goes on from it, also if it is made by another run; 0: never.
  // Error: std::runtime_error naming the file, as of AuditFile.
  explicit AuditLog(const std::filesystem::path& file, std::uint64_t roll_bytes = 0);
  // Writes what waits, if the disk takes it at once.
  ~AuditLog() override;

  void add(AuditEntry entry) override;
  void know(const std::string& from, const std::string& who) override;
  void forget(const std::string& from) override;
  std::string who_at(const std::string& from) const override;
  AuditAnswer ask(const AuditQuestion& question) const override;

  // Of what is on the disk.
  AuditHead head() const;

  // Who is given each entry from now on, by this one's thread; nullptr: nobody, and when it returns
  // no entry is on its way to the one before.
  using Taker = std::function<void(const AuditEntryPtr& entry)>;
  void give_to(Taker taker);

  // The file has been moved away: goes on in a new one at its path, whose first line names the end
  // of the one before.  Returns at once; what came of it is in the log and in the audit.
  void reopen();

 private:
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
  void run();
  // Under the lock.
  bool is_in_budget(const AuditEntry& entry);
  bool wait_for_disk(const AuditEntry& entry);  // false: there is no room
  void tell_left_out();
  std::vector<AuditEntryPtr> number_new();
  // This thread's, without the lock.
  void hand_on(const std::vector<AuditEntryPtr>& entries);
  void go_on_in_next_file();
  void tell_new_file();
  void move_away(const AuditHead& end, std::chrono::steady_clock::time_point now);
  // False: the disk took none of it, and the file is as before.  `head`: of the file, then with
  // them.
  bool write(const std::vector<AuditEntryPtr>& entries, AuditHead& head);
  void tell_disk(bool takes);

  const std::filesystem::path path_;
  const std::uint64_t roll_bytes_;
  std::unique_ptr<AuditFile> file_;  // this thread's; nullptr: none
  bool is_told_ = false;             // that the disk takes nothing
  std::chrono::steady_clock::time_point move_not_before_{};

  std::mutex taker_mutex_;
  Taker taker_;

  mutable std::mutex mutex_;  // over what follows
  std::condition_variable change_;
  // Not yet on the disk; the first `numbered_` have their numbers and change no more.
  std::deque<std::shared_ptr<recording::AuditEntry>> waiting_;
  std::size_t numbered_ = 0;
  std::deque<AuditEntryPtr> recent_;  // the newest last
  std::uint32_t last_n_ = 0;
  std::uint64_t missing_ = 0;  // that waited in vain
  Budget all_deeds_{kAllDeeds}, all_refusals_{kAllRefusals};
  std::map<std::pair<bool, std::string>, Budget> budgets_;  // by whether a refusal, and address
  std::map<std::string, std::string> known_;                // who, by place
  AuditHead head_;
  bool ends_ = false, reopens_ = false;
  std::thread thread_;
};

}  // namespace skerry::server
