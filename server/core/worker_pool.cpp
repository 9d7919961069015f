#include "server/core/worker_pool.hpp"

namespace skerry::server {

WorkerPool::WorkerPool(std::size_t workers, std::function<void()> at_start) {
  for (std::size_t i = 0; i < workers; ++i) {
    threads_.emplace_back([this, at_start](const std::stop_token& stop) {
      if (at_start) at_start();
      work(stop);
    });
  }
}

WorkerPool::~WorkerPool() {
  for (std::jthread& thread : threads_) thread.request_stop();
}

void WorkerPool::drain(std::unique_lock<std::mutex>& lock) {
  while (next_ < count_) {
    const std::size_t index = next_++;
    const auto& body = *body_;
    ++running_;
    lock.unlock();
    body(index);
    lock.lock();
    --running_;
  }
  if (running_ == 0) done_.notify_all();
}

void WorkerPool::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (more_.wait(lock, stop, [this] { return next_ < count_; })) drain(lock);
}

void WorkerPool::run(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::unique_lock lock(mutex_);
  body_ = &body;
  next_ = 0;
  count_ = count;
  if (!threads_.empty() && count > 1) more_.notify_all();
  drain(lock);
  done_.wait(lock, [this] { return next_ >= count_ && running_ == 0; });
  count_ = next_ = 0;
}

}  // namespace skerry::server
