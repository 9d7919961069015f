#include "tests/bench/fan_out/many_consoles.hpp"

#include <signal.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

namespace skerry::bench {

struct ManyConsoles::Shared {
  std::atomic<std::uint64_t> bytes = 0;
  std::atomic<int> ready = 0;  // 1: all are connected; -1: not all could
};

namespace {

constexpr std::size_t kAtOnce = 1 << 20;  // bytes thrown away by one call

std::vector<WireConsole> connected(std::size_t count, Way way, std::uint16_t port, int epoll) {
  std::vector<WireConsole> consoles;
  for (std::size_t i = 0; i < count; ++i) {
    const int fd = consoles.emplace_back(way, port).socket();
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = fd;
    ::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event);
  }
  return consoles;
}

}  // namespace

ManyConsoles::ManyConsoles(std::size_t count, Way way, std::uint16_t port) {
  void* const memory =
      ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no memory for the consoles' counts");
  shared_ = new (memory) Shared;
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("no process for the consoles");
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int epoll = ::epoll_create1(EPOLL_CLOEXEC);
    std::vector<WireConsole> consoles;
    try {
      consoles = connected(count, way, port, epoll);
    } catch (const std::exception&) {
      shared_->ready = -1;
      ::_exit(1);
    }
    shared_->ready = 1;
    std::array<epoll_event, 256> events;
    for (;;) {
      const int ready = ::epoll_wait(epoll, events.data(), static_cast<int>(events.size()), -1);
      for (int i = 0; i < ready; ++i) {
        const int fd = events[static_cast<std::size_t>(i)].data.fd;
        const ssize_t got = ::recv(fd, nullptr, kAtOnce, MSG_TRUNC | MSG_DONTWAIT);
        if (got > 0) shared_->bytes.fetch_add(static_cast<std::uint64_t>(got));
        if (got == 0) ::epoll_ctl(epoll, EPOLL_CTL_DEL, fd, nullptr);
      }
    }
  }
  while (shared_->ready == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (shared_->ready < 0) throw std::runtime_error("not all consoles could connect");
}

ManyConsoles::~ManyConsoles() {
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
  ::munmap(shared_, sizeof(Shared));
}

std::uint64_t ManyConsoles::bytes() const { return shared_->bytes.load(); }

}  // namespace skerry::bench
