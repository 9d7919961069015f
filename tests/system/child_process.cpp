#include "tests/system/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>
#include <utility>

namespace skerry::system_test {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

double seconds_of(const timeval& t) {
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
}

}  // namespace

TempFolder::TempFolder() : folder_((fs::temp_directory_path() / "skerry_system_XXXXXX").string()) {
  if (::mkdtemp(folder_.data()) == nullptr) fail("cannot make a folder " + folder_);
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string TempFolder::write(const std::string& file, const std::string& text) const {
  std::ofstream(path(file), std::ios::binary) << text;
  return path(file);
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

ChildProcess::ChildProcess(std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const int in = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const std::string err_path = folder_.path("err");
  const int err = ::open(err_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  std::array<int, 2> out{};
  if (in < 0 || err < 0 || ::pipe2(out.data(), O_CLOEXEC) != 0) fail("cannot run " + arguments[0]);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) fail("cannot run " + arguments[0]);
  if (pid_ == 0) {
    // Only what may be called between fork and exec of a process with threads.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);
    ::dup2(in, STDIN_FILENO);
    ::dup2(out[1], STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(in);
  ::close(err);
  ::close(out[1]);
  out_ = out[0];
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ::close(out_);
}

bool ChildProcess::read_more() {
  pollfd readable{.fd = out_, .events = POLLIN, .revents = 0};
  const auto patience = std::chrono::milliseconds(kPatience);
  if (::poll(&readable, 1, static_cast<int>(patience.count())) == 0) {
    throw std::runtime_error(
        "the program is silent and does not end; it has written to its log:\n" +
        text_of_file(folder_.path("err")));
  }
  std::array<char, 4096> bytes;
  const ssize_t size = ::read(out_, bytes.data(), bytes.size());
  if (size > 0) unread_.append(bytes.data(), static_cast<std::size_t>(size));
  return size > 0 || (size < 0 && errno == EINTR);
}

std::optional<std::string> ChildProcess::read_line() {
  std::size_t end = 0;
  while ((end = unread_.find('\n')) == std::string::npos) {
    if (!read_more()) return std::nullopt;
  }
  std::string line = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  return line;
}

void ChildProcess::await_error_text(const std::string& text) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  for (bool ended = false;;) {
    const std::string err = text_of_file(folder_.path("err"));
    if (err.find(text) != std::string::npos) return;
    if (ended || std::chrono::steady_clock::now() > deadline) {
      throw std::runtime_error("the program has not written \"" + text + "\" but:\n" + err);
    }
    // Once more what it has written after it ended; wait() still finds how.
    siginfo_t info{};
    ended = ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
            info.si_pid == pid_;
    if (!ended) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void ChildProcess::signal(int number) {
  if (pid_ > 0) ::kill(pid_, number);
}

Ending ChildProcess::wait() {
  while (read_more()) {
  }
  int status = 0;
  rusage usage{};
  if (::wait4(std::exchange(pid_, 0), &status, 0, &usage) < 0) fail("cannot wait for the program");
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = std::exchange(unread_, {}),
          .err = text_of_file(folder_.path("err")),
          .cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)};
}

Ending run(std::vector<std::string> arguments) { return ChildProcess(std::move(arguments)).wait(); }

}  // namespace skerry::system_test
