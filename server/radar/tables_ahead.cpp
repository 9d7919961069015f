#include "server/radar/tables_ahead.hpp"

#include <pthread.h>

#include <utility>

#include "server/radar/thread_priority.hpp"

namespace skerry::server {

bool TablesAhead::ready(const Wish& wish, const std::function<Make()>& make) {
  const auto now = std::chrono::steady_clock::now();
  if (!waits_) since_ = now;
  waits_ = true;
  take_made();
  if (held_ && asked_for_ == wish) return true;
  if (now - since_ > kPatience) return true;
  if (running_.valid()) return false;
  asked_for_ = wish;
  running_ = std::async(std::launch::async,
                        [made = make(), before = std::exchange(held_, nullptr)]() mutable {
                          pthread_setname_np(pthread_self(), "tables");
                          go_with_others();
                          before.reset();
                          return made();
                        });
  return false;
}

void TablesAhead::take_made() {
  if (running_.valid() && running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    held_ = running_.get();
}

void TablesAhead::let_go() {
  waits_ = false;
  take_made();
  held_ = nullptr;
}

}  // namespace skerry::server
