#include "server/app/journal_lines.hpp"

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

namespace skerry::server {
namespace {

// syslog(3)'s priorities.
char priority_of(spdlog::level::level_enum level) {
  switch (level) {
    case spdlog::level::critical:
      return '2';
    case spdlog::level::err:
      return '3';
    case spdlog::level::warn:
      return '4';
    case spdlog::level::info:
      return '6';
    default:
      return '7';
  }
}

class PriorityFlag final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& line, const std::tm&,
              spdlog::memory_buf_t& out) override {
    out.push_back(priority_of(line.level));
  }
  std::unique_ptr<spdlog::custom_flag_formatter> clone() const override {
    return std::make_unique<PriorityFlag>();
  }
};

}  // namespace

bool stderr_is_journal() {
  const char* said = std::getenv("JOURNAL_STREAM");
  struct stat found {};
  return said != nullptr && ::fstat(STDERR_FILENO, &found) == 0 &&
         fmt::format("{}:{}", found.st_dev, found.st_ino) == said;
}

std::unique_ptr<spdlog::formatter> journal_formatter() {
  auto lines = std::make_unique<spdlog::pattern_formatter>();
  lines->add_flag<PriorityFlag>('P').set_pattern("<%P>[%n] %v");
  return lines;
}

}  // namespace skerry::server
