#include "tests/bench/fan_out/bare_sender.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace skerry::bench {
namespace {

// In epoll's data; smaller numbers are consoles.
constexpr std::uint64_t kListener = ~0ull, kTimer = ~1ull;
constexpr int kNiceness = -5;  // as the server's network thread

void watch(int epoll, int fd, std::uint32_t events, std::uint64_t which) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = which;
  ::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event);
}

}  // namespace

BareSender::BareSender(const BareStream& stream)
    : stream_(stream), pieces_(stream.ring, std::vector<char>(stream.piece_bytes)) {
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof where;
  if (::bind(listener_, reinterpret_cast<const sockaddr*>(&where), size) != 0 ||
      ::listen(listener_, SOMAXCONN) != 0 ||
      ::getsockname(listener_, reinterpret_cast<sockaddr*>(&where), &size) != 0) {
    throw std::runtime_error("the bare sender cannot listen");
  }
  port_ = ntohs(where.sin_port);
  epoll_ = ::epoll_create1(EPOLL_CLOEXEC);
  timer_ = ::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
  itimerspec pace{};
  pace.it_interval.tv_nsec = std::lround(1e9 / stream.pieces_per_second);
  pace.it_value = pace.it_interval;
  ::timerfd_settime(timer_, 0, &pace, nullptr);
  watch(epoll_, listener_, EPOLLIN, kListener);
  watch(epoll_, timer_, EPOLLIN, kTimer);
  consoles_.reserve(8192);
  thread_ = std::thread([this] { run(); });
}

BareSender::~BareSender() {
  ends_ = true;
  thread_.join();
  for (const Console& console : consoles_) ::close(console.fd);
  for (const int fd : {listener_, epoll_, timer_}) ::close(fd);
}

void BareSender::pin_to(int core) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  ::pthread_setaffinity_np(thread_.native_handle(), sizeof cores, &cores);
}

double BareSender::cpu_seconds() const {
  clockid_t clock{};
  ::pthread_getcpuclockid(const_cast<std::thread&>(thread_).native_handle(), &clock);
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

void BareSender::accept_all() {
  for (;;) {
    const int fd = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0) return;
    const int on = 1, buffer = static_cast<int>(stream_.send_buffer);
    ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &buffer, sizeof buffer);
    watch(epoll_, fd, EPOLLOUT | EPOLLET, consoles_.size());
    consoles_.push_back({.fd = fd, .next = newest_});
  }
}

void BareSender::send_to(Console& console) {
  if (newest_ - console.next > stream_.ring) {
    lost_ += newest_ - 1 - console.next;
    console.next = newest_ - 1;
    console.offset = 0;
  }
  while (console.next < newest_) {
    const std::vector<char>& piece = pieces_[console.next % stream_.ring];
    const ssize_t done = ::send(console.fd, piece.data() + console.offset,
                                piece.size() - console.offset, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (done < 0) {
      console.full = true;
      return;
    }
    console.offset += static_cast<std::size_t>(done);
    if (console.offset < piece.size()) continue;
    console.offset = 0;
    ++console.next;
    ++sent_;
  }
}

void BareSender::run() {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
  std::array<epoll_event, 256> events;
  while (!ends_) {
    const int ready = ::epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), 100);
    for (int i = 0; i < ready; ++i) {
      const std::uint64_t which = events[static_cast<std::size_t>(i)].data.u64;
      if (which == kListener) {
        accept_all();
      } else if (which == kTimer) {
        std::uint64_t due = 0;
        if (::read(timer_, &due, sizeof due) != sizeof due) continue;
        for (std::uint64_t made = 0; made < due; ++made) {
          std::vector<char>& piece = pieces_[newest_ % stream_.ring];
          std::memset(piece.data(), static_cast<int>(newest_), piece.size());
          ++newest_;
        }
        for (Console& console : consoles_) {
          if (!console.full) send_to(console);
        }
      } else {
        consoles_[which].full = false;
        send_to(consoles_[which]);
      }
    }
  }
}

}  // namespace skerry::bench
