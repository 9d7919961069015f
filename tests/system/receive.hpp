// Steps that tests of the native stream share.  An answer that does not come within a
// minute, or any error, is a std::runtime_error.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "clients/common/spoke_client.hpp"
#include "protocol/video/scan.hpp"
#include "tests/system/running_server.hpp"

namespace skerry::system_test {

inline constexpr std::chrono::seconds kAnswerTime{60};

client::SpokeClient connected(const ServerProcess& server);
client::SpokeClient subscribed(const ServerProcess& server, std::uint32_t radar);

client::ClientEvent next_event(client::SpokeClient& client);
Spoke next_spoke(client::SpokeClient& client);

// The next whole turn that begins with spoke 0 from now on and is of one range scale.
Scan next_scan(client::SpokeClient& client);

// Reads on until an event of that type meets the condition.
template <typename Event>
Event await(client::SpokeClient& client, const std::function<bool(const Event&)>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kAnswerTime;
  while (std::chrono::steady_clock::now() < deadline) {
    client::ClientEvent event = next_event(client);
    if (auto* wanted = std::get_if<Event>(&event); wanted && condition(*wanted)) {
      return std::move(*wanted);
    }
  }
  throw std::runtime_error("what was waited for never came from " + client.name());
}

// Asks for the status again and again until it meets the condition.
wire::Status await_status(client::SpokeClient& client,
                          const std::function<bool(const wire::Status&)>& condition);

// A console on a thread of its own that never stops reading, to see whether something else
// disturbs it.
class Witness {
 public:
  Witness(const ServerProcess& server, std::uint32_t radar);

  struct Seen {
    std::uint64_t received = 0;
    std::uint64_t lost = 0;
    std::string error;  // why it ended early, if it did
  };
  // Returns when `more` further spokes have come, or it ended early.
  void await_more(std::uint64_t more) const;
  // Ends it after `more` further spokes have come.
  Seen finish(std::uint64_t more);

 private:
  void read(const std::stop_token& stop);

  client::SpokeClient client_;
  std::atomic<std::uint64_t> received_{0};  // UINT64_MAX once it has ended
  std::atomic<std::uint64_t> wanted_{UINT64_MAX};
  Seen seen_;
  std::jthread thread_;
};

}  // namespace skerry::system_test
