// PasswordDesk: passwords are tried on a thread of its own, one at a time, so that no radar and no
// connection waits for them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace skerry::server {

// Thread: one, the same that runs what `post` is given.
class PasswordDesk {
 public:
  // A class that signs in at once.  Only texts wait; memory is needed for the one that is tried.
  static constexpr std::size_t kMostWaiting = 64;

  using Task = std::function<void()>;
  using Done = std::function<void(bool is_right)>;

  // `post` runs a task on the caller's thread; called from the desk's.
  explicit PasswordDesk(std::function<void(Task)> post);
  // What waits is not tried any more, nor answered.
  ~PasswordDesk();
  PasswordDesk(const PasswordDesk&) = delete;
  PasswordDesk& operator=(const PasswordDesk&) = delete;

  // False: try_password() would refuse.
  bool has_place();

  // Whether `hash` (password.hpp) is of `password`: `done` is told, by post().  False: too many
  // wait; then nothing is tried.
  bool try_password(std::string hash, std::string password, Done done);

 private:
  struct Trial {
    std::string hash, password;
    Done done;
  };
  void run();

  std::function<void(Task)> post_;
  std::mutex mutex_;  // over what follows
  std::condition_variable change_;
  std::deque<Trial> trials_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace skerry::server
