#include "tests/bench/soak/visitors.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

namespace skerry::bench {

using system_test::LoadConsole;
using system_test::LoadReceiver;
using system_test::LoadWebConsole;

struct Visitors::Visitor {
  std::unique_ptr<LoadConsole> console;
  std::uint32_t radar = 0;
  Clock::time_point goes, asks_at;
  std::optional<Clock::time_point> stalls_from, stalls_until;
  bool stalled = false;     // it has been
  bool resets = false;      // it goes without a word
  bool is_leaving = false;  // it has asked for its last status
  bool reads(Clock::time_point now) const {
    return !stalls_from || now < *stalls_from || now >= *stalls_until;
  }
};

namespace {

Visitors::Clock::duration seconds(double value) {
  return std::chrono::duration_cast<Visitors::Clock::duration>(
      std::chrono::duration<double>(value));
}

// A connection that is closed so is cut off by a reset.
void make_abrupt(int socket) {
  const linger at_once{1, 0};
  ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
}

}  // namespace

Visitors::Visitors(const Visited& server, std::size_t count, std::uint64_t seed)
    : server_(server), count_(count), random_(seed) {}
Visitors::~Visitors() = default;

double Visitors::between(double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random_);
}

std::unique_ptr<Visitors::Visitor> Visitors::arrive(Clock::time_point now) {
  constexpr int kSmallBuffer = 32 * 1024;  // of one who will stall: nothing is kept for it
  auto visitor = std::make_unique<Visitor>();
  visitor->radar = static_cast<std::uint32_t>(random_() % server_.radars);
  visitor->goes = now + seconds(between(5.0, 120.0));
  visitor->asks_at = now + seconds(between(1.0, 10.0));
  visitor->resets = random_() % 4 == 0;
  const bool on_tcp = counts_.visits % 2 == 0;
  if (on_tcp && random_() % 8 == 0) {
    visitor->stalls_from = now + seconds(2.0);
    visitor->stalls_until = now + seconds(between(3.0, 12.0));
    visitor->stalled = true;
    ++counts_.stalls;
  }
  if (on_tcp) {
    visitor->console =
        std::make_unique<LoadConsole>(server_.tcp_port, visitor->stalled ? kSmallBuffer : 0);
  } else {
    visitor->console = std::make_unique<LoadWebConsole>(server_.http_port);
  }
  wire::Subscribe wanted;
  wanted.set_radar(visitor->radar);
  wanted.set_new_view(random_() % 4 == 0);
  wanted.set_own_ship_hz(1 + static_cast<std::uint32_t>(random_() % 10));
  visitor->console->subscribe(wanted);
  ++counts_.visits;
  counts_.views += wanted.new_view() ? 1 : 0;
  return visitor;
}

void Visitors::depart(Visitor& visitor) {
  const auto& losses = visitor.console->spokes().losses();
  const auto& clients = visitor.console->status()->clients();
  const auto itself = std::find_if(clients.begin(), clients.end(), [&](const auto& client) {
    return client.peer() == visitor.console->name();
  });
  if (itself == clients.end()) throw std::runtime_error("a console is not in the server's status");
  counts_.spokes += losses.received();
  (visitor.stalled ? counts_.stalls_lost : counts_.lost) += losses.lost();
  const std::uint64_t seen = visitor.console->lost_before_status();
  counts_.untold += seen - std::min<std::uint64_t>(seen, itself->spokes_lost());
  if (!visitor.resets) return;
  make_abrupt(visitor.console->socket());
  ++counts_.resets;
}

void Visitors::ask(Visitor& visitor) {
  ++counts_.orders;
  if (!server_.has_controls) {
    wire::ClientMessage message;
    wire::Playback& order = *message.mutable_playback();
    if (random_() % 2 == 0) {
      order.set_position_s(between(0.0, server_.played_s));
    } else {
      order.set_rate(random_() % 2 == 0 ? 1.0 : between(0.5, 2.0));
    }
    order.set_playing(true);
    visitor.console->send(message);
    return;
  }
  wire::Set set;
  set.set_radar(visitor.radar);
  constexpr std::array<double, 4> kScales = {3.0, 6.0, 12.0, 24.0};
  switch (random_() % 5) {
    case 0:
      set.set_range_nm(kScales[random_() % kScales.size()]);
      break;
    case 1:
      set.set_sea(between(0.0, 80.0));
      break;
    case 2:
      set.set_rain(between(0.0, 80.0));
      break;
    case 3:
      set.set_course_deg(between(0.0, 359.0));
      break;
    default:
      set.set_gain(between(30.0, 70.0));
  }
  visitor.console->set(set);
}

void Visitors::look(Clock::time_point now) {
  std::erase_if(visitors_, [&](const std::unique_ptr<Visitor>& visitor) {
    if (now < visitor->goes || !visitor->reads(now)) return false;
    if (!std::exchange(visitor->is_leaving, true)) visitor->console->ask_status();
    if (!visitor->console->status()) return false;
    depart(*visitor);
    return true;
  });
  while (are_welcome_ && visitors_.size() < count_) visitors_.push_back(arrive(now));
  for (const auto& visitor : visitors_) {
    if (now < visitor->asks_at || visitor->is_leaving) continue;
    visitor->asks_at = now + seconds(between(5.0, 30.0));
    ask(*visitor);
  }
}

void Visitors::leave() {
  are_welcome_ = false;
  for (const auto& visitor : visitors_) visitor->goes = {};
}

void Visitors::add_readers(std::vector<LoadReceiver*>& readers) const {
  const auto now = Clock::now();
  for (const auto& visitor : visitors_) {
    if (visitor->reads(now)) readers.push_back(visitor->console.get());
  }
}

}  // namespace skerry::bench
