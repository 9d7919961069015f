#include "server/audit/audit_log.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "server/config/config_error.hpp"

namespace skerry::server {
namespace {

using Kind = AuditEntry::Kind;

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::change:
      return "change";
    case Kind::request:
      return "request";
    case Kind::sign_in:
      return "sign_in";
    case Kind::refusal:
      return "refusal";
    case Kind::server:
      break;
  }
  return "server";
}

std::string utc_text(UtcTime time) {
  const auto ms = std::chrono::floor<std::chrono::milliseconds>(time);
  const auto s = std::chrono::floor<std::chrono::seconds>(ms);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(s)), (ms - s).count());
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(fmt::format("--audit: {}: {}", file.string(), why));
}

// The last whole line of a file of `size` bytes, and where it ends.
std::string last_line(int descriptor, std::uint64_t size, std::uint64_t& end) {
  constexpr std::uint64_t kPiece = 64 * 1024;
  std::string tail(std::min(size, 2 * kPiece), '\0');
  const ssize_t got =
      ::pread(descriptor, tail.data(), tail.size(), static_cast<off_t>(size - tail.size()));
  tail.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  const std::size_t stop = tail.rfind('\n');
  if (stop == std::string::npos) {
    end = 0;
    return {};
  }
  end = size - tail.size() + stop + 1;
  const std::size_t begin = stop == 0 ? std::string::npos : tail.rfind('\n', stop - 1);
  const std::size_t from = begin == std::string::npos ? 0 : begin + 1;
  return tail.substr(from, stop - from);
}

}  // namespace

AuditLog::AuditLog(std::filesystem::path file) : file_(std::move(file)) {
  open();
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "audit");
    run();
  });
}

AuditLog::~AuditLog() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  change_.notify_one();
  thread_.join();
  spdlog::info("audit: {} ends with entry {}, head {}", file_.string(), head_.n, head_.chain);
  ::close(descriptor_);
}

void AuditLog::open() {
  constexpr mode_t kMode = 0640;
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, kMode);
  if (descriptor_ < 0) refuse(file_, fmt::format("cannot be opened: {}", std::strerror(errno)));
  try {
    struct stat about {};
    if (::fstat(descriptor_, &about) != 0 || !S_ISREG(about.st_mode)) refuse(file_, "is no file");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      refuse(file_, "another server writes to it; give each its own file");
    }
    const auto size = static_cast<std::uint64_t>(about.st_size);
    const std::string line = last_line(descriptor_, size, size_);
    if (size_ > 0) {
      const auto head = read_audit_head(line);
      if (!head) {
        refuse(file_,
               "its last line is no entry of an audit file; `skerry audit verify` says "
               "more; give another file, and keep this one");
      }
      head_ = *head;
    } else if (size > 0 && line.empty() && !is_begin_of_entry()) {
      refuse(file_, "is no audit file; give another");
    }
    if (size_ == size) return;
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) {
      refuse(file_, fmt::format("cannot be cut: {}", std::strerror(errno)));
    }
    add({.kind = Kind::server,
         .what =
             fmt::format("{} bytes of an entry that was not finished were cut off", size - size_)});
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

// Of a file without a whole line.
bool AuditLog::is_begin_of_entry() const {
  constexpr std::string_view kBegin = "{\"n\":1,";
  std::string text(kBegin.size(), '\0');
  const ssize_t got = ::pread(descriptor_, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return kBegin.starts_with(text);
}

bool AuditLog::is_in_budget(Kind kind) {
  Budget& budget = budgets_[static_cast<std::size_t>(kind)];
  refill(budget);
  if (budget.left < 1.0) {
    ++budget.left_out;
    return false;
  }
  budget.left -= 1.0;
  return true;
}

void AuditLog::refill(Budget& budget) {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> since = now - std::exchange(budget.looked, now);
  budget.left = std::min(kMostAtOnce, budget.left + since.count() * kMostASecond);
}

void AuditLog::wait_for_disk(AuditEntry entry) {
  if (waiting_.size() < kMostWaiting) {
    waiting_.push_back({std::move(entry), std::chrono::system_clock::now()});
  } else {
    ++missing_;
  }
}

void AuditLog::tell_left_out() {
  for (std::size_t kind = 0; kind < budgets_.size(); ++kind) {
    Budget& budget = budgets_[kind];
    if (budget.left_out == 0) continue;
    refill(budget);
    if (budget.left < 1.0 && !ends_) continue;
    budget.left -= 1.0;
    wait_for_disk({.kind = static_cast<Kind>(kind),
                   .what = fmt::format("{} more of this kind, which came too fast",
                                       std::exchange(budget.left_out, 0))});
  }
}

void AuditLog::add(AuditEntry entry) {
  for (std::string* text :
       {&entry.from, &entry.who, &entry.what, &entry.before, &entry.after, &entry.result}) {
    if (!text->empty()) *text = printable(*text, kMostText);
  }
  {
    const std::lock_guard lock(mutex_);
    if (!is_in_budget(entry.kind)) return;
    if (entry.who.empty()) {
      if (const auto known = known_.find(entry.from); known != known_.end()) {
        entry.who = known->second.who;
      }
    }
    wait_for_disk(std::move(entry));
  }
  change_.notify_one();
}

void AuditLog::know(const std::string& from, const std::string& who) {
  const std::lock_guard lock(mutex_);
  const auto known = known_.find(from);
  if (known != known_.end()) {
    known->second = {who, std::nullopt};
  } else if (known_.size() < kMostKnown) {
    known_.emplace(from, Known{who, std::nullopt});
  }
}

void AuditLog::forget(const std::string& from) {
  const std::lock_guard lock(mutex_);
  const auto known = known_.find(from);
  if (known != known_.end()) known->second.gone = std::chrono::steady_clock::now();
}

void AuditLog::drop_the_gone() {
  const auto now = std::chrono::steady_clock::now();
  std::erase_if(known_, [&](const auto& each) {
    return each.second.gone && now - *each.second.gone > kRemembered;
  });
}

AuditHead AuditLog::head() const {
  const std::lock_guard lock(mutex_);
  return head_;
}

void AuditLog::run() {
  std::unique_lock lock(mutex_);
  bool takes = true;
  while (takes || !ends_) {
    change_.wait_for(lock, kAgain, [&] { return ends_ || (takes && !waiting_.empty()); });
    tell_left_out();
    drop_the_gone();
    if (waiting_.empty()) {
      if (ends_) return;
      continue;
    }
    const std::deque<Waiting> taken = waiting_;
    lock.unlock();
    takes = write(taken);
    tell_disk(takes);
    lock.lock();
    if (!takes) continue;
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(taken.size()));
    if (missing_ > 0) {
      wait_for_disk({.what = fmt::format("{} entries are missing: the disk took nothing for too "
                                         "long",
                                         std::exchange(missing_, 0))});
    }
  }
  spdlog::error("audit: {} entries could not be written to {}", waiting_.size() + missing_,
                file_.string());
}

bool AuditLog::write(const std::deque<Waiting>& entries) {
  AuditHead head = head_;  // this thread's alone to change
  std::string text;
  for (const auto& [from, utc] : entries) {
    audit::Entry entry;
    entry.set_utc(utc_text(utc));
    entry.set_kind(name_of(from.kind));
    entry.set_who(from.who);
    entry.set_from(from.from);
    entry.set_what(from.what);
    entry.set_before(from.before);
    entry.set_after(from.after);
    if (from.times > 1) entry.set_times(from.times);
    entry.set_result(from.result);
    text += audit_line(std::move(entry), head);
  }
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t wrote = ::write(descriptor_, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) break;
    done += static_cast<std::size_t>(wrote);
  }
  if (done < text.size() || ::fdatasync(descriptor_) != 0) {
    const int why = errno;
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) errno = why;
    return false;
  }
  size_ += text.size();
  const std::lock_guard lock(mutex_);
  head_ = head;
  return true;
}

void AuditLog::tell_disk(bool takes) {
  if (!takes && !std::exchange(is_told_, true)) {
    spdlog::error("audit: {} takes nothing ({}); up to {} entries wait", file_.string(),
                  std::strerror(errno), kMostWaiting);
  } else if (takes && std::exchange(is_told_, false)) {
    spdlog::warn("audit: {} takes entries again", file_.string());
  }
}

}  // namespace skerry::server
