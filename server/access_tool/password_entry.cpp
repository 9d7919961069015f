#include "server/access_tool/password_entry.hpp"

#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <stdexcept>

#include "server/access/password.hpp"

namespace skerry::server {
namespace {

termios as_shown{};  // the terminal as it was

// What may be called of a signal: tcsetattr(3), signal(2) and raise(3) may.
void show_and_end(int signal) {
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &as_shown);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// What is typed is not shown while it lives, nor does the program leave a terminal like that.
class HiddenTyping {
 public:
  HiddenTyping() {
    ::tcgetattr(STDIN_FILENO, &as_shown);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, show_and_end);
    termios hidden = as_shown;
    hidden.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &hidden);
  }
  ~HiddenTyping() {
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &as_shown);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_DFL);
  }
  HiddenTyping(const HiddenTyping&) = delete;
  HiddenTyping& operator=(const HiddenTyping&) = delete;
};

std::string line_of_input() {
  std::string line;
  if (!std::getline(std::cin, line)) throw std::runtime_error("no password was given");
  return line;
}

std::string ask(const std::string& question) {
  fmt::print(stderr, "{}: ", question);
  const HiddenTyping hidden;
  std::string line = line_of_input();
  fmt::print(stderr, "\n");
  return line;
}

}  // namespace

std::string enter_password(const std::string& user) {
  const bool by_hand = ::isatty(STDIN_FILENO) != 0;
  std::string password = by_hand ? ask("Password of " + user) : line_of_input();
  if (const auto why = why_no_password(password)) throw std::runtime_error(*why);
  if (by_hand && ask("The same again") != password) {
    throw std::runtime_error("the two differ; nothing was changed");
  }
  return password;
}

}  // namespace skerry::server
