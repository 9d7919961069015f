#include "server/audit/audit_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "protocol/picture/label_text.hpp"
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

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(fmt::format("--audit: {}: {}", file.string(), why));
}

bool is_refusal(Kind kind) { return kind == Kind::refusal || kind == Kind::sign_in; }

// "console 10.0.0.5" of "console 10.0.0.5:4711".
std::string without_port(const std::string& from) { return from.substr(0, from.rfind(':')); }

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

std::string AuditLog::read_tail(std::uint64_t size, std::uint64_t bytes) const {
  std::string tail(static_cast<std::size_t>(bytes), '\0');
  const ssize_t got =
      ::pread(descriptor_, tail.data(), tail.size(), static_cast<off_t>(size - bytes));
  if (got != static_cast<ssize_t>(bytes)) {
    refuse(file_, fmt::format("cannot be read: {}", std::strerror(errno)));
  }
  return tail;
}

void AuditLog::open() {
  constexpr mode_t kMode = 0640;
  constexpr const char* kNone =
      "its end is no entry of an audit file; give another file, and keep this one (`skerry audit "
      "verify` says more)";
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, kMode);
  if (descriptor_ < 0) refuse(file_, fmt::format("cannot be opened: {}", std::strerror(errno)));
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      refuse(file_, "another server writes to it; give each its own file");
    }
    struct stat about {};
    if (::fstat(descriptor_, &about) != 0 || !S_ISREG(about.st_mode)) refuse(file_, "is no file");
    const auto size = static_cast<std::uint64_t>(about.st_size);
    const std::string tail = read_tail(size, std::min<std::uint64_t>(size, 2 * kMostAuditLine));
    const std::size_t end = tail.rfind('\n') + 1;  // 0: there is no line
    size_ = size - (tail.size() - end);
    const std::uint64_t rest = size - size_;
    if (rest > kMostAuditLine) refuse(file_, kNone);
    if (end > 0) {
      const std::size_t begin = end > 1 ? tail.rfind('\n', end - 2) + 1 : 0;
      const auto head = read_audit_head(std::string_view(tail).substr(begin, end - 1 - begin));
      if (!head) refuse(file_, kNone);
      head_ = *head;
    } else if (size > 0) {
      // The first entry was being written.
      constexpr std::string_view kBegin = "{\"n\":1,";
      if (!kBegin.starts_with(tail.substr(0, kBegin.size()))) refuse(file_, kNone);
      size_ = 0;
    }
    if (rest == 0) return;
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) {
      refuse(file_, fmt::format("cannot be cut: {}", std::strerror(errno)));
    }
    add({.what = fmt::format("{} bytes of an entry that was not finished were cut off", rest)});
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

bool AuditLog::Budget::has(std::chrono::steady_clock::time_point now) {
  const std::chrono::duration<double> since = now - std::exchange(looked_, now);
  left_ = std::min(pace_.at_once, left_ + since.count() * pace_.a_second);
  return left_ >= 1.0;
}

bool AuditLog::is_in_budget(const AuditEntry& entry) {
  if (entry.kind == Kind::server) return true;
  const auto now = std::chrono::steady_clock::now();
  const bool refusal = is_refusal(entry.kind);
  Budget& all = refusal ? all_refusals_ : all_deeds_;
  std::pair<bool, std::string> peer{refusal, without_port(entry.from)};
  if (budgets_.size() >= kMostPeers && !budgets_.contains(peer)) peer.second = "others";
  Budget& budget =
      budgets_.try_emplace(std::move(peer), refusal ? kRefusals : kDeeds).first->second;
  const bool has_all = all.has(now), has_own = budget.has(now);
  if (!has_all || !has_own) {
    ++budget.left_out;
    return false;
  }
  all.take();
  budget.take();
  return true;
}

bool AuditLog::wait_for_disk(AuditEntry entry) {
  const std::size_t room = is_refusal(entry.kind) ? kMostWaiting / 2 : kMostWaiting;
  if (waiting_.size() >= room) return false;
  waiting_.push_back({std::move(entry), std::chrono::system_clock::now()});
  return true;
}

// Every kAgain.
void AuditLog::tell_left_out() {
  const auto now = std::chrono::steady_clock::now();
  if (missing_ > 0 && wait_for_disk({.what = fmt::format("{} entries are missing: the disk took "
                                                         "nothing for too long",
                                                         missing_)})) {
    missing_ = 0;
  }
  for (auto it = budgets_.begin(); it != budgets_.end();) {
    auto& [peer, budget] = *it;
    const bool has = budget.has(now);
    if (budget.left_out > 0 && (has || ends_) &&
        wait_for_disk(
            {.kind = peer.first ? Kind::refusal : Kind::change,
             .from = peer.second,
             .what = fmt::format("{} more from there, which came too fast", budget.left_out)})) {
      budget.left_out = 0;
      budget.take();
    }
    it = budget.left_out == 0 && budget.is_full() ? budgets_.erase(it) : std::next(it);
  }
}

void AuditLog::add(AuditEntry entry) {
  for (std::string* text :
       {&entry.from, &entry.who, &entry.what, &entry.before, &entry.after, &entry.result}) {
    if (!text->empty()) *text = printable(*text, kMostText);
  }
  {
    const std::lock_guard lock(mutex_);
    if (!is_in_budget(entry)) return;
    if (entry.who.empty()) {
      if (const auto known = known_.find(entry.from); known != known_.end()) {
        entry.who = known->second;
      }
    }
    if (!wait_for_disk(std::move(entry))) ++missing_;
  }
  change_.notify_one();
}

void AuditLog::know(const std::string& from, const std::string& who) {
  const std::lock_guard lock(mutex_);
  if (known_.size() < kMostKnown) known_[from] = who;
}

void AuditLog::forget(const std::string& from) {
  const std::lock_guard lock(mutex_);
  known_.erase(from);
}

std::string AuditLog::who_at(const std::string& from) const {
  const std::lock_guard lock(mutex_);
  const auto known = known_.find(from);
  return known == known_.end() ? std::string() : known->second;
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
  const auto cut = [this] {
    const int why = errno;
    has_rest_ = ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0;
    errno = why;
    return !has_rest_;
  };
  if (has_rest_ && !cut()) return false;
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t wrote = ::write(descriptor_, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) break;
    done += static_cast<std::size_t>(wrote);
  }
  if (done < text.size() || ::fdatasync(descriptor_) != 0) {
    cut();
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
