// ClientError: why a receiver has nothing (more) to give.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "protocol/quantity/result.hpp"

namespace skerry::client {

// The native protocol's usual places.
inline constexpr const char* kDefaultHost = "127.0.0.1";
inline constexpr std::uint16_t kDefaultTcpPort = 7410;
inline constexpr std::uint16_t kDefaultUdpPort = 7411;
inline constexpr std::uint16_t kDefaultCat240Port = 8600;

enum class ClientErrorKind : std::uint8_t {
  unreachable,  // no such host, no way to it, or a local address that cannot be used
  refused,      // nobody listens there
  timed_out,    // no connection or no answer in time
  closed,       // the connection ended
  rejected,     // the server answered with an error
  malformed,    // what came is not the native protocol
};

struct ClientError {
  ClientErrorKind kind = ClientErrorKind::closed;
  std::string text;  // one sentence that names host and port; printable ASCII
  int code = 0;      // rejected: the server's wire::Reply::Code
};

template <typename T>
using ClientResult = Result<T, ClientError>;
using Done = std::monostate;

inline Failure<ClientError> failure(ClientErrorKind kind, std::string text) {
  return Failure{ClientError{kind, std::move(text)}};
}

}  // namespace skerry::client
