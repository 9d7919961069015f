// Which paths of the delta stream a client wants, and what it asks for on that stream.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/signalk/json.hpp"

namespace skerry::signalk {

// True if `path` fits `pattern`, in which '*' stands for any text, none included.
bool path_matches(std::string_view pattern, std::string_view path);

// Paths of one's own ship, or of the others, by patterns.
class Subscriptions {
 public:
  static constexpr std::size_t kMost = 64;  // patterns; what comes after is not taken
  static constexpr std::size_t kLongestPath = 128;
  static constexpr std::chrono::milliseconds kShortestPeriod{100}, kUsualPeriod{1000};

  void subscribe(std::string_view pattern, std::chrono::milliseconds period);
  void unsubscribe(std::string_view pattern);  // "*" ends all
  bool wants(std::string_view path) const;
  bool empty() const { return wanted_.empty(); }
  // The shortest of those that the path fits; nothing if there is none.
  std::optional<std::chrono::milliseconds> period_of(std::string_view path) const;

 private:
  struct Wanted {
    std::string pattern;
    std::chrono::milliseconds period;
  };
  std::vector<Wanted> wanted_;
};

// One message of a client.
struct StreamRequest {
  struct Path {
    std::string pattern;
    std::chrono::milliseconds period{};
  };
  std::vector<Path> subscribe, unsubscribe;                // of one's own ship
  std::vector<Path> subscribe_others, unsubscribe_others;  // of the other vessels
  // A control to be set: {"path":..,"value":..}, or a "put" with a request id to be answered.
  std::string put_path = {};
  Json put_value = {};
  std::string request_id = {};
  std::string token = {};
};

// Contexts "vessels.*" and "*" are one's own ship and the others, "vessels.urn:..." the others;
// paths of what is no vessel are passed over.  Error: what is wrong with it.
Result<StreamRequest, std::string> read_stream_request(std::string_view text);

}  // namespace skerry::signalk
