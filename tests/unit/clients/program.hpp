// Program: runs the built `skerry` and keeps what it wrote.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace skerry::client {

inline std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A folder of its own for each test; they are removed when the test program ends.
inline std::string test_folder() {
  struct Folders {
    std::vector<std::string> made;
    ~Folders() {
      std::error_code ignored;
      for (const std::string& each : made) std::filesystem::remove_all(each, ignored);
    }
  };
  static Folders folders;
  std::string pattern = testing::TempDir() + "skerry_cli_XXXXXX";
  if (::mkdtemp(pattern.data()) == nullptr) return testing::TempDir();
  folders.made.push_back(pattern);
  return pattern;
}

class Program {
 public:
  // `input`: what it reads.
  explicit Program(std::vector<std::string> arguments, const std::string& input = {})
      : folder_(test_folder()) {
    std::ofstream(folder_ + "/in") << input;
    arguments.insert(arguments.begin(), SKERRY_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const std::string in = folder_ + "/in", out = folder_ + "/out", err = folder_ + "/err";
    pid_ = ::fork();
    if (pid_ != 0) return;
    constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
    ::dup2(::open(in.c_str(), O_RDONLY), STDIN_FILENO);
    ::dup2(::open(out.c_str(), kWrite, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), kWrite, 0600), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ~Program() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void interrupt() { ::kill(pid_, SIGINT); }
  // The exit code; 128 and the signal's number if one ended it.
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(pid_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  // After wait().
  std::string out() const { return text_of_file(folder_ + "/out"); }
  std::string err() const { return text_of_file(folder_ + "/err"); }

 private:
  std::string folder_;
  pid_t pid_ = 0;
};

}  // namespace skerry::client
