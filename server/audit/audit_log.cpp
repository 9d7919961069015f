#include "server/audit/audit_log.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "protocol/picture/label_text.hpp"
#include "protocol/quantity/time.hpp"
#include "server/config/config_error.hpp"

namespace skerry::server {
namespace {

using Kind = AuditEntry::Kind;

bool is_refusal(Kind kind) { return kind == Kind::refusal || kind == Kind::sign_in; }

// "console 10.0.0.5" of "console 10.0.0.5:4711".
std::string without_port(const std::string& from) { return from.substr(0, from.rfind(':')); }

std::shared_ptr<recording::AuditEntry> message_of(const AuditEntry& from) {
  auto entry = std::make_shared<recording::AuditEntry>();
  entry->set_utc(utc_text(std::chrono::system_clock::now()));
  entry->set_kind(std::string(kAuditKinds[static_cast<std::size_t>(from.kind)]));
  entry->set_who(from.who);
  entry->set_from(from.from);
  entry->set_what(from.what);
  entry->set_before(from.before);
  entry->set_after(from.after);
  if (from.times > 1) entry->set_times(from.times);
  entry->set_result(from.result);
  return entry;
}

// A file that was moved away has the number of its last entry behind its name, with so many digits
// that names are in the order of entries.
constexpr std::size_t kDigitsOfMoved = 10;

// The end of the newest of them: a server that ended between the move and the first entry of the
// next file, which is missing or empty, goes on from it.
AuditHead end_of_moved(const std::filesystem::path& file) {
  const std::string begin = file.filename().string() + ".";
  std::filesystem::path newest;
  std::error_code error;
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool is_moved = name.starts_with(begin) && name.size() == begin.size() + kDigitsOfMoved &&
                          name.find_first_not_of("0123456789", begin.size()) == std::string::npos;
    if (is_moved && (newest.empty() || entry.path() > newest)) newest = entry.path();
  }
  if (newest.empty()) return {};
  try {
    return AuditFile(newest).head();
  } catch (const std::runtime_error& wrong) {
    spdlog::warn("audit: {} begins anew, as it cannot go on from another: {}", file.string(),
                 wrong.what());
    return {};
  }
}

// Small letters as large, of the Latin ones.
bool has_part(const std::string& text, const std::string& part) {
  const auto is_same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  return part.empty() ||
         std::search(text.begin(), text.end(), part.begin(), part.end(), is_same) != text.end();
}

bool is_asked_for(const recording::AuditEntry& entry, const AuditQuestion& question) {
  return (question.kind.empty() || entry.kind() == question.kind) &&
         (has_part(entry.who(), question.who) || has_part(entry.from(), question.who));
}

}  // namespace

AuditLog::AuditLog(const std::filesystem::path& file, std::uint64_t roll_bytes)
    : path_(file), roll_bytes_(roll_bytes) {
  if (!path_.empty()) {
    file_ = std::make_unique<AuditFile>(path_);
    head_ = file_->size() > 0 ? file_->head() : end_of_moved(path_);
    last_n_ = head_.n;
    if (file_->size() == 0 && head_.n > 0) tell_new_file();
    if (file_->bytes_cut() > 0) {
      add({.what = fmt::format("{} bytes of an entry that was not finished were cut off",
                               file_->bytes_cut())});
    }
  }
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
  if (file_) {
    spdlog::info("audit: {} ends with entry {}, head {}", path_.string(), head_.n, head_.chain);
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

bool AuditLog::wait_for_disk(const AuditEntry& entry) {
  const std::size_t room = is_refusal(entry.kind) ? kMostWaiting / 2 : kMostWaiting;
  if (waiting_.size() >= room) return false;
  waiting_.push_back(message_of(entry));
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
    if (!wait_for_disk(entry)) ++missing_;
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

AuditAnswer AuditLog::ask(const AuditQuestion& question) const {
  AuditAnswer answer;
  const std::lock_guard lock(mutex_);
  answer.newest = last_n_;
  answer.has_file = !path_.empty();
  answer.unwritten = answer.has_file ? waiting_.size() : 0;
  for (auto it = recent_.rbegin(); it != recent_.rend(); ++it) {
    if (answer.entries.size() >= question.most || (*it)->n() <= question.after) break;
    if (is_asked_for(**it, question)) answer.entries.push_back(*it);
  }
  return answer;
}

AuditHead AuditLog::head() const {
  const std::lock_guard lock(mutex_);
  return head_;
}

void AuditLog::give_to(Taker taker) {
  const std::lock_guard lock(taker_mutex_);
  taker_ = std::move(taker);
}

void AuditLog::reopen() {
  {
    const std::lock_guard lock(mutex_);
    reopens_ = true;
  }
  change_.notify_one();
}

std::vector<AuditEntryPtr> AuditLog::number_new() {
  std::vector<AuditEntryPtr> numbered;
  for (; numbered_ < waiting_.size(); ++numbered_) {
    waiting_[numbered_]->set_n(++last_n_);
    numbered.push_back(waiting_[numbered_]);
    recent_.push_back(waiting_[numbered_]);
  }
  while (recent_.size() > kMostRecent) recent_.pop_front();
  return numbered;
}

void AuditLog::hand_on(const std::vector<AuditEntryPtr>& entries) {
  const std::lock_guard lock(taker_mutex_);
  if (!taker_) return;
  for (const AuditEntryPtr& entry : entries) taker_(entry);
}

void AuditLog::run() {
  std::unique_lock lock(mutex_);
  bool takes = true, ends = false;
  auto tried = std::chrono::steady_clock::now();
  while (takes || !ends) {
    change_.wait_for(lock, kAgain, [&] {
      return ends_ || reopens_ || numbered_ < waiting_.size() || (takes && !waiting_.empty());
    });
    ends = ends_;  // what is left out is told once more after that was said
    tell_left_out();
    const auto fresh = number_new();
    const bool reopens = std::exchange(reopens_, false);
    const auto now = std::chrono::steady_clock::now();
    std::vector<AuditEntryPtr> batch;
    if (takes || ends || reopens || now - tried >= kAgain) {
      batch.assign(waiting_.begin(), waiting_.end());
    }
    lock.unlock();
    hand_on(fresh);
    if (reopens) go_on_in_next_file();
    AuditHead head = head_;  // this thread's alone to change
    const bool has_written = !batch.empty() && write(batch, head);
    if (!batch.empty()) {
      tried = now;
      takes = has_written;
      tell_disk(takes);
    }
    if (has_written && !ends) move_away(head, now);
    lock.lock();
    if (has_written) {
      head_ = head;
      const auto count = static_cast<std::ptrdiff_t>(batch.size());
      waiting_.erase(waiting_.begin(), waiting_.begin() + count);
      numbered_ -= batch.size();
    }
    if (ends && waiting_.empty()) return;
  }
  spdlog::error("audit: {} entries could not be written to {}", waiting_.size() + missing_,
                path_.string());
}

void AuditLog::move_away(const AuditHead& end, std::chrono::steady_clock::time_point now) {
  if (!file_ || roll_bytes_ == 0 || file_->size() < roll_bytes_ || now < move_not_before_) return;
  move_not_before_ = now + kMoveAgain;
  if (file_->is_in_place()) {
    std::filesystem::path away = path_;
    away += fmt::format(".{:0{}}", end.n, kDigitsOfMoved);
    std::error_code error;
    const bool is_taken = std::filesystem::exists(away, error);
    if (!is_taken) std::filesystem::rename(path_, away, error);
    if (is_taken || error) {
      spdlog::error("audit: {} cannot be moved away to {}: {}", path_.string(), away.string(),
                    is_taken ? "something has that name" : error.message());
      return;
    }
  }
  reopen();
}

void AuditLog::go_on_in_next_file() {
  if (!file_) return;
  if (file_->is_in_place()) {
    spdlog::info("audit: {} is where it was and goes on; to begin another, move it away first",
                 path_.string());
    return;
  }
  try {
    file_ = std::make_unique<AuditFile>(path_, AuditFile::Kind::next_only);
    move_not_before_ = {};
    tell_new_file();
  } catch (const std::runtime_error& wrong) {
    spdlog::error("audit: it goes on in the file that was moved away: {}", wrong.what());
    add({.what = fmt::format("no new file: {}", wrong.what())});
  }
}

void AuditLog::tell_new_file() {
  const AuditHead end = head();
  spdlog::info("audit: {} goes on from entry {}, head {}", path_.string(), end.n, end.chain);
  add({.what = fmt::format("a new file goes on from entry {}, head {}", end.n, end.chain)});
}

bool AuditLog::write(const std::vector<AuditEntryPtr>& entries, AuditHead& head) {
  if (!file_) return true;
  const bool goes_on = file_->size() == 0 && head.n > 0;
  std::string text;
  for (const AuditEntryPtr& from : entries) {
    audit::Entry entry = *from;
    if (goes_on && text.empty()) entry.set_follows(head.chain);
    text += audit_line(std::move(entry), head);
  }
  return file_->append(text);
}

void AuditLog::tell_disk(bool takes) {
  if (!takes && !std::exchange(is_told_, true)) {
    spdlog::error("audit: {} takes nothing ({}); up to {} entries wait", path_.string(),
                  std::strerror(errno), kMostWaiting);
  } else if (takes && std::exchange(is_told_, false)) {
    spdlog::warn("audit: {} takes entries again", path_.string());
  }
}

}  // namespace skerry::server
