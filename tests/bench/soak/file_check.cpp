#include "tests/bench/soak/file_check.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "protocol/recording/reader.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/sequence_gap.hpp"

namespace skerry::bench {
namespace {

// A line for each radar, "radar first last missing", or "damaged WHY".
std::string read_file(const std::string& file) {
  const auto reader = recording::RecordingReader::open(file);
  if (!reader) return "damaged " + reader.error().text + "\n";
  if (reader->summary().damage) return "damaged " + reader->summary().damage->text + "\n";
  std::map<std::uint32_t, std::pair<FileRun, LossCounter>> radars;
  recording::ItemCursor cursor = reader->items();
  wire::Spoke spoke;
  while (const auto item = cursor.next()) {
    if (item->topic.kind != recording::Kind::spoke || item->topic.view != 0) continue;
    if (!spoke.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) {
      return "damaged a spoke that is no message\n";
    }
    auto [radar, is_new] = radars.try_emplace(item->topic.radar);
    FileRun& run = radar->second.first;
    if (is_new) run.first = spoke.sequence();
    run.last = spoke.sequence();
    radar->second.second.take(spoke.sequence());
  }
  if (cursor.chunks_damaged() > 0) {
    return fmt::format("damaged {} chunks cannot be read\n", cursor.chunks_damaged());
  }
  std::string told;
  for (const auto& [radar, found] : radars) {
    told += fmt::format("{} {} {} {}\n", radar, found.first.first, found.first.last,
                        found.second.lost());
  }
  return told;
}

[[noreturn]] void be_the_reader(const std::string& file, int to) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::nice(19) == -1) errno = 0;
  const std::string told = read_file(file);
  ::_exit(::write(to, told.data(), told.size()) == static_cast<ssize_t>(told.size()) ? 0 : 1);
}

}  // namespace

FileCheck::FileCheck(std::string file) : file_(std::move(file)) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("no process to check a recording");
  if (pid_ == 0) be_the_reader(file_, pipe[1]);
  ::close(pipe[1]);
  from_ = pipe[0];
  ::fcntl(from_, F_SETFL, O_NONBLOCK);
}

FileCheck::~FileCheck() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ::close(from_);
}

std::optional<FileReport> FileCheck::report() {
  std::array<char, 4096> bytes;
  ssize_t size = 0;
  while ((size = ::read(from_, bytes.data(), bytes.size())) > 0) {
    told_.append(bytes.data(), static_cast<std::size_t>(size));
  }
  if (size < 0 && errno == EAGAIN) return std::nullopt;
  int status = 0;
  ::waitpid(std::exchange(pid_, 0), &status, 0);
  FileReport report{file_, "", {}};
  constexpr std::string_view kDamaged = "damaged ";
  if (status != 0) {
    report.damage = fmt::format("its reader ended with {}", status);
  } else if (told_.starts_with(kDamaged)) {
    report.damage = told_.substr(kDamaged.size());
  } else {
    std::istringstream lines(told_);
    std::uint32_t radar = 0;
    FileRun run;
    while (lines >> radar >> run.first >> run.last >> run.missing) report.radars[radar] = run;
  }
  return report;
}

}  // namespace skerry::bench
