#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "tests/system/running_server.hpp"

namespace skerry::system_test {
namespace {

std::vector<std::string> command_line(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {skerryd_program(), "--tcp-port", "0",          "--http-port", "0",
                                  "--print-ports",   "--no-udp",   "--no-cat240"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

struct CpuTime {
  std::string name;  // of the program or thread
  double seconds = 0.0;
};

// Of a file as proc(5) has it: utime is field 14, stime the next.
CpuTime time_of(const std::string& stat) {
  std::ifstream file(stat);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto name_begin = text.find('('), name_end = text.rfind(')');  // it may hold spaces
  if (name_begin == std::string::npos || name_end == std::string::npos) return {};
  std::istringstream fields(text.substr(name_end + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return {text.substr(name_begin + 1, name_end - name_begin - 1),
          (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK))};
}

}  // namespace

std::string skerryd_program() { return SKERRYD_PROGRAM; }
std::string skerry_program() { return SKERRY_PROGRAM; }

ServerProcess::ServerProcess(const std::vector<std::string>& arguments)
    : process_(command_line(arguments)) {
  const auto line = process_.read_line();
  unsigned tcp = 0, http = 0;
  if (!line || std::sscanf(line->c_str(), "tcp %u http %u", &tcp, &http) != 2) {
    process_.signal(SIGTERM);
    throw std::runtime_error("skerryd did not print its ports but: " + line.value_or("nothing") +
                             "\n" + process_.wait().err);
  }
  tcp_port_ = static_cast<std::uint16_t>(tcp);
  http_port_ = static_cast<std::uint16_t>(http);
}

double ServerProcess::cpu_seconds() const {
  return time_of("/proc/" + std::to_string(process_.pid()) + "/stat").seconds;
}

std::map<std::string, double> ServerProcess::cpu_seconds_by_thread() const {
  std::map<std::string, double> sums;
  for (const auto& thread :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process_.pid()) + "/task")) {
    const CpuTime time = time_of(thread.path().string() + "/stat");
    sums[time.name.substr(0, time.name.find('-'))] += time.seconds;
  }
  return sums;
}

Ending ServerProcess::stop() {
  stopped_ = true;
  process_.signal(SIGTERM);
  return process_.wait();
}

}  // namespace skerry::system_test
