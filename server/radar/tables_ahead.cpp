#include "server/radar/tables_ahead.hpp"

#include <pthread.h>

#include <exception>
#include <system_error>
#include <utility>

#include "server/radar/thread_priority.hpp"

namespace skerry::server {

bool TablesAhead::ready(const Wish& wish, const std::function<Make()>& make) {
  const auto now = std::chrono::steady_clock::now();
  if (!waits_ || !(wished_ == wish)) since_ = now;
  waits_ = true;
  wished_ = wish;
  take_made();
  if (held_ && asked_for_ == wish) return true;
  if (now - since_ > patience_) {
    waits_ = false;  // the next wish has its own
    return true;
  }
  if (running_.valid()) return false;
  asked_for_ = wish;
  try {
    running_ = std::async(std::launch::async,
                          [made = make(), before = std::exchange(held_, nullptr)]() mutable {
                            pthread_setname_np(pthread_self(), "tables");
                            go_with_others();
                            before.reset();
                            return made();
                          });
  } catch (const std::system_error&) {  // no thread is to be had: the radar makes them itself
    waits_ = false;
    return true;
  }
  return false;
}

void TablesAhead::take_made() {
  if (!running_.valid() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  try {
    held_ = running_.get();
  } catch (const std::exception&) {  // tried again while the wish has patience
    held_ = nullptr;
  }
}

void TablesAhead::let_go() {
  waits_ = false;
  take_made();
  held_ = nullptr;
}

}  // namespace skerry::server
