// ClientSocket: a TCP connection to a server, in the clear or under TLS.  Not installed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "clients/common/asio.hpp"

namespace skerry::client {

// A host as users give it: "bridge", or "tls://bridge" for a server that has a certificate.
struct HostName {
  explicit HostName(const std::string& text);
  std::string name;
  bool secure = false;
};

// Operations as of an Asio stream: at most one read and one write are in flight.  Under TLS the
// server's certificate must be for the host's name and signed by an authority of the file that the
// environment's SKERRY_CA names, or, without it, of the system's.  A server that asks for a
// certificate of the client is shown that of SKERRY_CERT, whose key is in SKERRY_KEY.
// Thread: one at a time.
class ClientSocket {
 public:
  using tcp = boost::asio::ip::tcp;
  using error_code = boost::system::error_code;
  using Done = std::function<void(const error_code&)>;
  using Moved = std::function<void(const error_code&, std::size_t)>;

  explicit ClientSocket(boost::asio::io_context& io);
  ~ClientSocket();

  tcp::socket& tcp_socket() { return socket_; }
  const tcp::socket& tcp_socket() const { return socket_; }

  // Once tcp_socket() is connected.  Error: what is wrong with SKERRY_CA, SKERRY_CERT or
  // SKERRY_KEY; empty if nothing is.
  std::string begin_tls(const HostName& host);
  void async_handshake(Done done);
  // Why the handshake failed, for people: the certificate's fault, if it was that.
  std::string handshake_fault(const error_code& error) const;
  // What an operation's error means to people.  By TLS 1.3 a server refuses the client's
  // certificate after the client's handshake is done.
  std::string in_words(const error_code& error) const;

  void async_read_some(boost::asio::mutable_buffer into, Moved moved);
  void async_write(boost::asio::const_buffer from, Moved moved);
  void close();

 private:
  struct Tls;
  tcp::socket socket_;
  std::unique_ptr<Tls> tls_;
};

}  // namespace skerry::client
