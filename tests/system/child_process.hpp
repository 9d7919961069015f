// ChildProcess: a program run by a test, which reads what it says and how it ends.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace skerry::system_test {

// How a program ended and what it wrote.
struct Ending {
  int code = -1;    // exit code; 128 and the signal's number if one ended it
  std::string out;  // standard output that read_line() had not given out
  std::string err;
  double cpu_seconds = 0.0;  // user and system
};

// A folder of its own, removed with all that is in it.
class TempFolder {
 public:
  TempFolder();  // Error: std::runtime_error
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string path(const std::string& file) const { return folder_ + "/" + file; }
  // Writes the file and gives its path.
  std::string write(const std::string& file, const std::string& text) const;

 private:
  std::string folder_;
};

std::string text_of_file(const std::string& path);

// Runs from construction to the end of the object at most, and never longer than this process.
// Standard input is empty.  Thread: one at a time.
class ChildProcess {
 public:
  // A program that is silent or unfinished for so long hangs; it is killed.
  static constexpr std::chrono::seconds kPatience{180};

  // `arguments` begin with the program's path.  Error: std::runtime_error.
  explicit ChildProcess(std::vector<std::string> arguments);
  ~ChildProcess();  // kills what still runs
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // The next line of standard output, without its end; nothing if the program has closed it.
  // Error: std::runtime_error after kPatience.
  std::optional<std::string> read_line();

  // Until it has written `text` to standard error.
  // Error: std::runtime_error after kPatience, or once it has ended without that.
  void await_error_text(const std::string& text);

  void signal(int number);
  // The end of the program, which must come by itself or by a signal sent before.
  // Error: std::runtime_error after kPatience.
  Ending wait();
  pid_t pid() const { return pid_; }

 private:
  bool read_more();  // false at the end of standard output

  TempFolder folder_;
  pid_t pid_ = 0;  // 0: waited for
  int out_ = -1;
  std::string unread_;
};

// wait() of a program that ends by itself.
Ending run(std::vector<std::string> arguments);

}  // namespace skerry::system_test
