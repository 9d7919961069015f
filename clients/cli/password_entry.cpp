#include "clients/cli/password_entry.hpp"

#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <stdexcept>

namespace skerry::client {
namespace {

termios shown_terminal{};  // as it was

// What may be called of a signal: tcsetattr(3), signal(2) and raise(3) may.
void show_again_and_end(int signal) {
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &shown_terminal);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// What is typed is not shown while it lives, nor does the program leave a terminal like that.
class HiddenEntry {
 public:
  HiddenEntry() {
    ::tcgetattr(STDIN_FILENO, &shown_terminal);
    for (std::size_t i = 0; i < std::size(kSignals); ++i) {
      before_[i] = std::signal(kSignals[i], show_again_and_end);
    }
    termios hidden = shown_terminal;
    hidden.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &hidden);
  }
  ~HiddenEntry() {
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &shown_terminal);
    for (std::size_t i = 0; i < std::size(kSignals); ++i) std::signal(kSignals[i], before_[i]);
  }
  HiddenEntry(const HiddenEntry&) = delete;
  HiddenEntry& operator=(const HiddenEntry&) = delete;

 private:
  static constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
  void (*before_[std::size(kSignals)])(int) = {};  // those of watch_signals()
};

}  // namespace

std::string enter_password(const std::string& user, const std::string& server) {
  std::string line;
  bool came = false;
  if (::isatty(STDIN_FILENO) != 0) {
    fmt::print(stderr, "Password of {} at {}: ", user, server);
    const HiddenEntry hidden;
    came = static_cast<bool>(std::getline(std::cin, line));
    fmt::print(stderr, "\n");
  } else {
    came = static_cast<bool>(std::getline(std::cin, line));
  }
  if (!came || line.empty()) throw std::runtime_error("no password was given");
  return line;
}

}  // namespace skerry::client
