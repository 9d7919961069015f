#include "tests/bench/child_server.hpp"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace skerry::bench {
namespace {

struct Ports {
  std::uint16_t tcp = 0, http = 0;
};

// Those in 'tcp PORT http PORT'; 0 if the server said something else or nothing.
Ports read_ports(int from_server) {
  FILE* const said = ::fdopen(from_server, "r");
  if (!said) return {};
  unsigned tcp = 0, http = 0;
  const bool read = std::fscanf(said, "tcp %u http %u", &tcp, &http) == 2;
  std::fclose(said);
  if (!read) return {};
  return {static_cast<std::uint16_t>(tcp), static_cast<std::uint16_t>(http)};
}

}  // namespace

ChildServer::ChildServer(const std::vector<std::string>& arguments, const std::string& log) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe to skerryd");
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("no process for skerryd");
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // a bench that is killed leaves no server behind
    ::dup2(pipe[1], STDOUT_FILENO);
    ::dup2(::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644), STDERR_FILENO);
    ::close(pipe[0]);
    ::close(pipe[1]);
    std::vector<std::string> all = {
        SKERRYD_PROGRAM, "--tcp-port",   "0", "--http-port", "0", "--no-udp",
        "--no-cat240",   "--print-ports"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& word : all) words.push_back(word.data());
    words.push_back(nullptr);
    ::execv(SKERRYD_PROGRAM, words.data());
    ::_exit(127);
  }
  ::close(pipe[1]);
  const Ports ports = read_ports(pipe[0]);
  tcp_port_ = ports.tcp;
  http_port_ = ports.http;
  if (tcp_port_ == 0) {
    stop();
    throw std::runtime_error(SKERRYD_PROGRAM
                             " did not print its ports: run it with --print-ports to see why");
  }
}

ChildServer::~ChildServer() {
  if (pid_ > 0) stop();
}

void ChildServer::pin_to(int core) const {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  for (const auto& thread :
       std::filesystem::directory_iterator("/proc/" + std::to_string(pid_) + "/task")) {
    const pid_t id = std::stoi(thread.path().filename().string());
    if (::sched_setaffinity(id, sizeof cores, &cores) != 0) {
      throw std::runtime_error("skerryd cannot be put on core " + std::to_string(core));
    }
  }
}

int ChildServer::stop() {
  int status = 0;
  ::kill(pid_, SIGTERM);
  ::waitpid(pid_, &status, 0);
  pid_ = 0;
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

double ChildServer::cpu_seconds() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
  std::string line;
  std::getline(file, line);
  // The name, field 2, may hold blanks; it ends with the last ')'.  utime is field 14.
  std::istringstream rest(line.substr(line.rfind(')') + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) rest >> skipped;
  double user = 0.0, system = 0.0;
  rest >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

double ChildServer::thread_cpu_seconds(const std::string& name) const {
  const std::filesystem::path tasks = "/proc/" + std::to_string(pid_) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks)) {
    std::string comm;
    std::ifstream(task.path() / "comm") >> comm;
    if (comm != name) continue;
    double nanoseconds = 0.0;
    std::ifstream(task.path() / "schedstat") >> nanoseconds;
    return nanoseconds * 1e-9;
  }
  return 0.0;
}

double ChildServer::resident_mib() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6)) / 1024.0;
  }
  return 0.0;
}

}  // namespace skerry::bench
