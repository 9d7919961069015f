#include "clients/cli/recording/server_child.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "clients/cli/console.hpp"

namespace skerry::client {
namespace {

std::string skerryd_program() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto beside = self.parent_path() / "skerryd";
  return !error && ::access(beside.c_str(), X_OK) == 0 ? beside.string() : "skerryd";
}

// Points into `arguments`.
std::vector<char*> argv_of(std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (std::string& each : arguments) argv.push_back(each.data());
  argv.push_back(nullptr);
  return argv;
}

std::runtime_error failed(const char* what) {
  return std::runtime_error(
      fmt::format("cannot start skerryd: {}: {}", what, std::strerror(errno)));
}

}  // namespace

void become_server(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), skerryd_program());
  const std::vector<char*> argv = argv_of(arguments);
  ::execvp(argv.front(), argv.data());
  throw failed(argv.front());
}

ServerChild::ServerChild(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), skerryd_program());
  arguments.emplace_back("--print-ports");
  const std::vector<char*> argv = argv_of(arguments);
  int ends[2];
  if (::pipe(ends) != 0) throw failed("pipe");
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) throw failed("fork");
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);
    ::signal(SIGPIPE, SIG_DFL);
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]);
    ::close(ends[1]);
    ::close(STDIN_FILENO);
    ::execvp(argv.front(), argv.data());
    std::fprintf(stderr, "%s: %s\n", argv.front(), std::strerror(errno));
    ::_exit(127);
  }
  ::close(ends[1]);
  out_ = ends[0];
}

ServerChild::~ServerChild() {
  if (!ended()) {
    ::kill(pid_, SIGTERM);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(out_);
}

std::optional<std::uint16_t> ServerChild::await_port() {
  std::string line;
  while (!interrupted()) {
    pollfd wait{out_, POLLIN, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(kLookAround.count()));
    if (ready <= 0) continue;
    char byte = 0;
    const auto size = ::read(out_, &byte, 1);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return std::nullopt;
    if (byte != '\n') {
      if (line.size() < 200) line += byte;
      continue;
    }
    unsigned port = 0;
    if (std::sscanf(line.c_str(), "tcp %u", &port) == 1 && port > 0 && port <= 65535) {
      return static_cast<std::uint16_t>(port);
    }
    line.clear();
  }
  return std::nullopt;
}

std::optional<int> ServerChild::ended() {
  if (pid_ == 0) return code_;
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = 0;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return code_;
}

}  // namespace skerry::client
