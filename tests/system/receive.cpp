#include "tests/system/receive.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>
#include <variant>

namespace skerry::system_test {
namespace {

template <typename T>
T value_of(client::ClientResult<T> result) {
  if (!result) throw std::runtime_error(result.error().text);
  return std::move(result).value();
}

}  // namespace

client::SpokeClient connected(const ServerProcess& server) {
  return value_of(
      client::SpokeClient::connect(client::kDefaultHost, server.tcp_port(), kAnswerTime));
}

client::SpokeClient subscribed(const ServerProcess& server, std::uint32_t radar) {
  client::SpokeClient client = connected(server);
  value_of(client.subscribe(radar, 0, kAnswerTime));
  return client;
}

client::ClientEvent next_event(client::SpokeClient& client) {
  auto event = value_of(client.receive(kAnswerTime));
  if (!event) throw std::runtime_error("nothing came from " + client.name());
  return std::move(*event);
}

Spoke next_spoke(client::SpokeClient& client) {
  return await<Spoke>(client, [](const Spoke&) { return true; });
}

Scan next_scan(client::SpokeClient& client) {
  ScanAssembler assembler;
  bool begun = false;
  for (;;) {
    Spoke spoke = next_spoke(client);
    begun = begun || spoke.header.index == 0;
    if (!begun) continue;
    auto scan = assembler.feed(std::move(spoke));
    if (scan && scan->is_complete() && scan->has_one_range_scale()) return std::move(*scan);
  }
}

wire::Status await_status(client::SpokeClient& client,
                          const std::function<bool(const wire::Status&)>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kAnswerTime;
  for (;;) {
    wire::Status status = value_of(client.get_status(kAnswerTime));
    if (condition(status)) return status;
    if (std::chrono::steady_clock::now() > deadline) {
      throw std::runtime_error("the server never came to the state waited for; its status:\n" +
                               status.DebugString());
    }
  }
}

Witness::Witness(const ServerProcess& server, std::uint32_t radar)
    : client_(subscribed(server, radar)),
      thread_([this](const std::stop_token& stop) { read(stop); }) {}

void Witness::read(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested() && received_ < wanted_) {
      next_spoke(client_);
      ++received_;
      received_.notify_all();
    }
  } catch (const std::exception& error) {
    seen_.error = error.what();
  }
  seen_.received = client_.losses().received();
  seen_.lost = client_.losses().lost();
  received_ = UINT64_MAX;  // whoever waits for more waits no longer
  received_.notify_all();
}

void Witness::await_more(std::uint64_t more) const {
  std::uint64_t seen = received_;
  for (const std::uint64_t wanted = seen + more; seen < wanted; seen = received_) {
    received_.wait(seen);
  }
}

Witness::Seen Witness::finish(std::uint64_t more) {
  wanted_ = received_ + more;
  thread_.join();
  return seen_;
}

}  // namespace skerry::system_test
