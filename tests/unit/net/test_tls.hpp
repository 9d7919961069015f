// A blocking TLS client for tests, on OpenSSL alone.
#pragma once

#include <openssl/ssl.h>

#include <cstdint>
#include <memory>
#include <string>

namespace skerry::server {

struct TestTlsOptions {
  std::string authority = {};  // file; empty: any certificate will do
  int least = 0, most = 0;     // TLS1_2_VERSION and the like; 0: what OpenSSL has
  std::string ciphers = {};    // of TLS 1.2; empty: those of OpenSSL
  // Of the client, with its chain, and NAME.key beside it: a file; empty: none.
  std::string certificate = {};
  SSL_SESSION* session = nullptr;  // to resume; nullptr: none
};

// A connection to 127.0.0.1.  A read that gets nothing for 30 s ends as if it was closed.
class TestTls {
 public:
  // Connects and shakes hands; is_open() tells whether that went well.
  explicit TestTls(std::uint16_t port, const TestTlsOptions& options = {});
  ~TestTls();
  TestTls(const TestTls&) = delete;
  TestTls& operator=(const TestTls&) = delete;

  bool is_open() const { return open_; }
  std::string version() const { return ::SSL_get_version(ssl_); }
  std::string cipher() const { return ::SSL_get_cipher_name(ssl_); }
  std::string fingerprint() const;  // of the server's certificate, hexadecimal
  // What the connection may be resumed by, once something was received; free it.
  SSL_SESSION* session() const { return ::SSL_get1_session(ssl_); }
  bool is_resumed() const { return ::SSL_session_reused(ssl_) == 1; }
  bool renegotiate();  // false if the server does not go along
  void send(const std::string& text);
  std::string receive(std::size_t least);  // so many bytes, or all until it closed
  std::string receive_all() { return receive(std::string::npos); }

 private:
  SSL_CTX* context_ = nullptr;
  SSL* ssl_ = nullptr;
  int socket_ = -1;
  bool open_ = false;
};

}  // namespace skerry::server
