// WireConsole: one console's connection, subscribed to radar 0, that can be read or thrown away.
#pragma once

#include <openssl/ssl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace skerry::bench {

// How a console comes.  A native connection to a bare sender says nothing.
enum class Way : std::uint8_t { bare, native, ws, wss };
const char* name_of(Way way);

class WireConsole {
 public:
  // Connects to 127.0.0.1, and shakes hands, upgrades and subscribes as that way has it.
  // Error: std::runtime_error saying which of them failed.
  WireConsole(Way way, std::uint16_t port);
  WireConsole(WireConsole&&) noexcept = default;

  int socket() const { return *socket_; }
  // What was sent, decrypted; 0: the server has closed.
  std::size_t read(std::span<char> into);

 private:
  struct Closes {
    using pointer = int*;
    void operator()(int* socket) const;
  };
  struct Frees {
    void operator()(SSL* ssl) const { ::SSL_free(ssl); }
  };
  void write(std::span<const char> bytes);

  std::unique_ptr<int, Closes> socket_;
  std::unique_ptr<SSL, Frees> ssl_;
};

}  // namespace skerry::bench
