#include "server/core/paced_thread.hpp"

#include <pthread.h>

#include <condition_variable>
#include <mutex>
#include <utility>

namespace skerry::server {

void PacedThread::start(const char* name, std::chrono::milliseconds pause,
                        std::function<void(const std::stop_token&)> look) {
  thread_ = std::jthread([name, pause, look = std::move(look)](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), name);
    std::mutex mutex;
    std::condition_variable_any stopped;
    std::unique_lock lock(mutex);
    while (!stop.stop_requested()) {
      look(stop);
      stopped.wait_for(lock, stop, pause, [&] { return stop.stop_requested(); });
    }
  });
}

}  // namespace skerry::server
