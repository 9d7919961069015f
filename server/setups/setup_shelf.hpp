// SetupShelf: the set-ups that consoles have given a name, kept in a folder for all consoles.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace skerry::server {

// A set-up is the JSON document that the console makes: an object with `kind`, `version`, `name`
// and `parts`.  It is a file of its own, so that it can be carried from server to server.
//
// Reads are from memory; the disk is written by a thread of its own, one change at a time.
// Thread: one, the same that runs what `post` is given.
class SetupShelf {
 public:
  static constexpr std::size_t kMost = 200;             // set-ups
  static constexpr std::size_t kMostBytes = 64 * 1024;  // of one
  static constexpr std::size_t kMostNameBytes = 240;    // 60 characters of UTF-8
  static constexpr std::size_t kMostWaiting = 8;        // changes that are being written

  using Task = std::function<void()>;
  struct Config {
    std::filesystem::path folder;  // made if it is not there
    // Runs a task on the shelf's thread; called from another one.
    std::function<void(Task)> post;
  };

  // Reads what the folder has; a file that is no set-up is left alone, and the log says why.
  // Error: std::runtime_error naming the folder, if it cannot be made, read or written to.
  explicit SetupShelf(Config config);
  // Writes what still waits.  What post() was given by then must not be run any more.
  ~SetupShelf();
  SetupShelf(const SetupShelf&) = delete;
  SetupShelf& operator=(const SetupShelf&) = delete;

  // [{"name": ..., "bytes": ...}], by name.
  std::string list() const;
  // The document of that name; nullptr if there is none.  Holds until the next change.
  const std::string* find(std::string_view name) const;

  // What became of a change: 204 if it is on the disk, else the HTTP status and what is wrong.
  struct Outcome {
    unsigned status = 204;
    std::string text = {};
  };
  using Done = std::function<void(Outcome)>;

  // Keeps the document, in place of one of the same name.  `done` is called once, by post() or at
  // once: 400 no set-up or no such name, 413 too long, 507 no room or a disk that cannot be written
  // to, 503 too many changes wait.  After a failure the one before stands.
  void keep(std::string name, std::string document, Done done);
  // 404 if there is none.
  void remove(const std::string& name, Done done);

 private:
  struct Kept {
    std::string document;
    std::filesystem::path file;
  };
  void read_folder();
  // Runs `write` on the other thread, then `then` on this one if it went well, and `done`.
  void change(std::function<Outcome()> write, Task then, Done done);

  Config config_;
  std::map<std::string, Kept, std::less<>> kept_;  // by name
  std::size_t waiting_ = 0;

  void run_disk();
  std::mutex mutex_;  // over what follows
  std::condition_variable change_;
  std::deque<Task> writes_;
  bool ends_ = false;
  std::thread disk_;
};

}  // namespace skerry::server
