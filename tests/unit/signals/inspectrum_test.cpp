// inspectrum, on a screen that nobody sees, opens what we wrote.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>

#include <chrono>
#include <optional>
#include <thread>

#include "clients/signals/sigmf_writer.hpp"
#include "tests/unit/signals/outside_tool.hpp"
#include "tests/unit/signals/synthetic_recording.hpp"

namespace skerry::client {
namespace {

using namespace testing_signals;

// A program that takes so long hangs.
constexpr std::chrono::seconds kPatience{120};
constexpr std::chrono::milliseconds kLook{20};

// A program that lives no longer than this object.
class Running {
 public:
  // `environment`: NAME=VALUE, on top of ours; stdout and stderr go to `log`.
  Running(std::vector<std::string> arguments, const std::vector<std::string>& environment,
          const std::string& log)
      : pid_(::fork()) {
    if (pid_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const std::string& entry : environment) ::putenv(const_cast<char*>(entry.c_str()));
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ~Running() {
    if (!ended()) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  bool ended() {
    if (!status_) {
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
    }
    return status_.has_value();
  }
  // The signal that ended it; 0: it ended by itself.
  int stop() {
    ::kill(pid_, SIGTERM);
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (!ended() && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(kLook);
    return status_ && WIFSIGNALED(*status_) ? WTERMSIG(*status_) : 0;
  }

 private:
  pid_t pid_;
  std::optional<int> status_;
};

template <typename Condition>
bool wait_for(Condition condition) {
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

// Pixels of a spectrogram's green in what Xvfb shows (an XWD file of 32 bits a pixel, XWDFile.h).
std::size_t green_pixels(const std::string& screen) {
  const std::string file = text_of_file(screen);
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8 | static_cast<unsigned char>(file[4 * at + i]);
    }
    return value;
  };
  if (file.size() < 100) return 0;
  const std::size_t begin = word(0) + 12 * std::size_t{word(19)};
  std::size_t green = 0;
  for (std::size_t at = begin; at + 4 <= file.size(); at += 4) {
    const int blue = static_cast<unsigned char>(file[at]);
    const int level = static_cast<unsigned char>(file[at + 1]);
    const int red = static_cast<unsigned char>(file[at + 2]);
    green += level > red + 40 && level > blue + 40;
  }
  return green;
}

TEST(Inspectrum, OpensARecordingShowsItsSpectrumAndStaysUp) {
  for (const char* program : {"Xvfb", "inspectrum"}) {
    if (!is_installed(program)) FAIL() << " is not installed; tests/run installs it" << program;
  }
  const SignalRecording recording = make_recording({.ticks = 1'000'000});
  Folder folder;
  write_sigmf(folder / "f", recording, {SignalChannel::video_a}, 20'000'000,
              [](double) { return true; });
  ::mkdir((folder / "screen").c_str(), 0700);
  Running screen({"Xvfb", "-displayfd", "1", "-nolisten", "tcp", "-screen", "0", "1024x768x24",
                  "-fbdir", folder / "screen"},
                 {}, folder / "display");
  std::string display;
  ASSERT_TRUE(wait_for([&] {
    display = text_of_file(folder / "display");
    return display.find('\n') != std::string::npos || screen.ended();
  }));
  ASSERT_FALSE(screen.ended()) << display;
  // Warnings may stand before the number.
  display.pop_back();
  display = ":" + display.substr(display.find_last_of('\n') + 1);

  Running inspectrum({"inspectrum", folder / "f-video_a.sigmf-meta"},
                     {"DISPLAY=" + display, "QT_QPA_PLATFORM=xcb", "HOME=" + (folder / ""),
                      "XDG_RUNTIME_DIR=" + (folder / "screen")},
                     folder / "log");
  EXPECT_TRUE(wait_for([&] {
    return inspectrum.ended() || green_pixels(folder / "screen/Xvfb_screen0") > 5000;
  })) << text_of_file(folder / "log");
  EXPECT_FALSE(inspectrum.ended()) << text_of_file(folder / "log");
  EXPECT_EQ(inspectrum.stop(), SIGTERM) << text_of_file(folder / "log");
  EXPECT_EQ(screen.stop(), 0);
}

}  // namespace
}  // namespace skerry::client
