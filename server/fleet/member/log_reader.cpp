#include "server/fleet/member/log_reader.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <utility>

#include "server/fleet/order_watch.hpp"
#include "server/fleet/until_answered.hpp"

namespace skerry::fleet {
namespace {

constexpr std::chrono::milliseconds kAfterError{100};  // after an error

std::string new_mark() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

// The first line that one has and the other has not.
std::string difference(const std::vector<std::string>& ours, const std::string& theirs) {
  std::istringstream lines(theirs);
  std::vector<std::string> known;
  for (std::string line; std::getline(lines, line);) known.push_back(line);
  const std::size_t most = std::max(ours.size(), known.size());
  for (std::size_t i = 0; i < most; ++i) {
    const std::string here = i < ours.size() ? ours[i] : "nothing";
    const std::string there = i < known.size() ? known[i] : "nothing";
    if (here != there) return fmt::format("here it is \"{}\", there \"{}\"", here, there);
  }
  return {};
}

}  // namespace

LogReader::LogReader(const MemberPlan& plan, StoreMark& mark, std::function<void(Heard)> hear)
    : plan_(plan), mark_(mark), hear_(std::move(hear)) {}

void LogReader::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "fleet-log");
    run(stop);
  });
}

void LogReader::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

bool LogReader::tell(StoreError error, bool at_once) {
  const bool passes = may_pass(error.trouble) || error.trouble == Trouble::compacted ||
                      error.trouble == Trouble::full || error.trouble == Trouble::refused;
  const HostTime now = host_now();
  if (passes) troubled_.reset();
  if (!passes && !troubled_) troubled_ = now;
  const bool ended =
      at_once || error.trouble == Trouble::went_back || (troubled_ && now - *troubled_ >= kMend);
  hear_({false, {}, std::move(error), ended});
  return !ended;
}

// How this host's charter differs; empty: it does not.
StoreResult<std::string> LogReader::agree(KeyStore& keys, const LogKeys& names) {
  std::string charter;
  for (const std::string& line : plan_.charter) charter += line + '\n';
  Transaction t;
  t.conditions = {{names.charter(), Condition::Of::created, 0}};
  t.puts = {{names.charter(), charter, 0}};
  t.reads = {names.charter()};
  const auto reply = until_answered(keys, keys.now() + kStoreCall,
                                    [&](HostTime attempt) { return keys.transact(t, attempt); });
  if (!reply) return Failure{reply.error()};
  const auto& found = reply->found.at(0);
  return found ? difference(plan_.charter, found->value) : std::string("nothing is there");
}

// The exercise is there, and is this host's.
bool LogReader::begin(KeyStore& keys, OrderStore& store) {
  const auto opened = store.open(new_mark(), keys.now() + kStoreCall);
  if (!opened) {
    tell(opened.error());
    return false;
  }
  const auto charter = agree(keys, store.keys());
  if (!charter) {
    tell(charter.error());
    return false;
  }
  if (charter->empty()) return true;
  differs_ = true;
  tell({Trouble::refused,
        fmt::format("exercise {} of the fleet is another one than this host's: {}; give all hosts "
                    "the same version, scenario and charts, or the exercise another name",
                    plan_.exercise, *charter),
        false},
       true);
  return false;
}

// Up to which revision it has been heard.
StoreResult<Revision> LogReader::hear_all(KeyStore& keys, OrderStore& store) {
  const auto text = store.read(1, keys.now() + 20 * kStoreCall);
  if (!text) return Failure{text.error()};
  anew_.store(false);
  Heard heard;
  heard.anew = true;
  for (const OrderSeen& order : text->orders) heard.events.emplace_back(order);
  holders_.clear();
  for (const HolderSeen& holder : text->holders) {
    if (!holder.host.empty()) holders_.insert(holder.name);
    heard.events.emplace_back(holder);
  }
  if (text->grant) heard.events.emplace_back(*text->grant);
  std::stable_sort(
      heard.events.begin(), heard.events.end(),
      [](const LogEvent& a, const LogEvent& b) { return revision_of(a) < revision_of(b); });
  hear_(std::move(heard));
  return text->at;
}

// Until all is to be heard anew.  False: it has ended.
bool LogReader::watch(KeyStore& keys, Revision from, const std::stop_token& stop) {
  OrderWatch watch(keys, mark_, plan_.exercise, from, holders_);
  while (!stop.stop_requested() && !anew_.load()) {
    auto events = watch.next(keys.now() + kStoreCall / 2);
    if (!events) {
      if (!tell(events.error())) return false;
      keys.wait_until(keys.now() + kAfterError);
      continue;
    }
    troubled_.reset();
    if (!events->empty()) hear_({false, *std::move(events), std::nullopt, false});
  }
  return true;
}

void LogReader::run(const std::stop_token& stop) {
  const auto keys = plan_.store();
  OrderStore store(*keys, mark_, plan_.exercise);
  bool begun = false;
  while (!stop.stop_requested()) {
    begun = begun || begin(*keys, store);
    if (!begun && (mark_.trouble() || differs_)) return;
    if (begun) {
      const auto at = hear_all(*keys, store);
      if (at && !watch(*keys, *at + 1, stop)) return;
      if (at) continue;
      if (!tell(at.error())) return;
    }
    keys->wait_until(keys->now() + kAfterError);
  }
}

}  // namespace skerry::fleet
