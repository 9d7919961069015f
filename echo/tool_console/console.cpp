#include "echo/tool_console/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "echo/tool_console/command.hpp"
#include "echo/tool_console/part_file.hpp"

namespace skerry::echo {
namespace {

std::string& program_name() {
  static std::string name = "skerry";
  return name;
}

}  // namespace

void name_program(std::string name) { program_name() = std::move(name); }

int report(const std::string& text, const std::string& advice) {
  fmt::print(stderr, "{}: {}\n", program_name(), text);
  if (!advice.empty()) fmt::print(stderr, "{}\n", advice);
  return kExitFailure;
}

void watch_pipe() { std::signal(SIGPIPE, SIG_IGN); }

void write_out(std::string_view text) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (whole && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) throw ReaderGone{};
  throw std::runtime_error(
      fmt::format("cannot write to standard output: {}", std::strerror(errno)));
}

void write_file(const std::filesystem::path& file, std::string_view text) {
  PartFile part(file);
  part.write(text);
  part.finish();
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
  shown_ = false;
}

void Progress::show(const std::string& text) {
  if (!terminal_) return;
  shown_ = true;
  fmt::print(stderr, "\r{}\x1b[K", text);
  std::fflush(stderr);
}

}  // namespace skerry::echo
