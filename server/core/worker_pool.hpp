// WorkerPool: helpers that share one loop's iterations.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace skerry::server {

// Runs body(0) .. body(count-1) on its threads and the caller's, each iteration once, in any order.
// With no workers the caller does all.  Thread: one caller at a time.
class WorkerPool {
 public:
  // `workers` threads besides the caller; 0 is the default of a server with few radars.
  // Each thread first calls `at_start`.
  explicit WorkerPool(std::size_t workers, std::function<void()> at_start = {});
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  void run(std::size_t count, const std::function<void(std::size_t)>& body);

 private:
  void work(const std::stop_token& stop);
  // Takes and runs iterations of the loop in hand until none is left.  Holds `lock` between them.
  void drain(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable_any more_, done_;
  const std::function<void(std::size_t)>* body_ = nullptr;
  std::size_t next_ = 0, count_ = 0, running_ = 0;
  std::vector<std::jthread> threads_;  // last: they end before what they use
};

}  // namespace skerry::server
