// One connection to the server's ports that do TLS, over a pair of sockets, with random numbers
// that are the same each time: so a client's bytes that were recorded once are a whole handshake
// again.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "protocol/wire/byte_order.hpp"

namespace skerry::fuzz {

// Where OpenSSL's random numbers come from, from now on and in the whole program (SplitMix64).
struct FixedRandom {
  std::uint64_t state;
  void use();
};

struct TlsOutcome {
  enum class Kind : std::uint8_t { none, plain, secure };  // none: it ended before, or never began
  Kind kind = Kind::none;
  int times = 0;            // it was handed on
  std::string certificate;  // as TcpPeer has it
  bool is_secure = false;   // the same
  Bytes heard;              // after that, until the client ended
};

// What TlsOpening makes of a client, over the keys in tls_keys.  Thread: one in a program.
class TlsConnection {
 public:
  TlsConnection();
  // Ends it, and checks that the server holds nothing of it.
  ~TlsConnection();
  TlsConnection(const TlsConnection&) = delete;
  TlsConnection& operator=(const TlsConnection&) = delete;

  // Sends, and lets the server do what it can do then.
  void send(std::span<const std::uint8_t> bytes);
  void finish();  // sends no more
  // All that the server has sent and was not taken yet.
  Bytes take_answer();

  const TlsOutcome& outcome() const;

  static std::string key_file(const std::string& name);  // of tls_keys

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace skerry::fuzz
