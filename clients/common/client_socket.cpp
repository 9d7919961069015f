#include "clients/common/client_socket.hpp"

#include <fmt/format.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <cstdlib>
#include <string_view>
#include <utility>

namespace skerry::client {
namespace {

namespace asio = boost::asio;
namespace ssl = boost::asio::ssl;

constexpr std::string_view kSecure = "tls://";

}  // namespace

HostName::HostName(const std::string& text) : name(text) {
  if (!text.starts_with(kSecure)) return;
  secure = true;
  name = text.substr(kSecure.size());
}

struct ClientSocket::Tls {
  explicit Tls(tcp::socket& socket) : stream(socket, context) {}
  ssl::context context{ssl::context::tls_client};
  ssl::stream<tcp::socket&> stream;
};

ClientSocket::ClientSocket(asio::io_context& io) : socket_(io) {}
ClientSocket::~ClientSocket() = default;

std::string ClientSocket::begin_tls(const HostName& host) {
  auto tls = std::make_unique<Tls>(socket_);
  SSL* const raw = tls->stream.native_handle();
  ::SSL_CTX_set_min_proto_version(tls->context.native_handle(), TLS1_2_VERSION);
  ::SSL_set_min_proto_version(raw, TLS1_2_VERSION);
  error_code error;
  const char* file = std::getenv("SKERRY_CA");
  if (file != nullptr && *file != '\0') {
    tls->context.load_verify_file(file, error);
    if (error) {
      return fmt::format(
          "SKERRY_CA: {}: no certificates in PEM that can be read; expected the "
          "authority.pem that `skerry tls init` made",
          file);
    }
  } else {
    tls->context.set_default_verify_paths(error);
  }
  ::SSL_set_verify(raw, SSL_VERIFY_PEER, nullptr);
  const auto address = asio::ip::make_address(host.name, error);
  if (!error) {
    ::X509_VERIFY_PARAM_set1_ip_asc(::SSL_get0_param(raw), address.to_string().c_str());
  } else {
    ::SSL_set1_host(raw, host.name.c_str());
    ::SSL_set_tlsext_host_name(raw, host.name.c_str());
  }
  tls_ = std::move(tls);
  return {};
}

void ClientSocket::async_handshake(Done done) {
  tls_->stream.async_handshake(ssl::stream_base::client, std::move(done));
}

std::string ClientSocket::handshake_fault(const error_code& error) const {
  const long fault = ::SSL_get_verify_result(tls_->stream.native_handle());
  if (fault == X509_V_OK) return error.message();
  return fmt::format(
      "its certificate is not trusted: {}; SKERRY_CA names the file of authorities, "
      "the server's authority.pem",
      ::X509_verify_cert_error_string(fault));
}

void ClientSocket::async_read_some(asio::mutable_buffer into, Moved moved) {
  if (tls_) {
    tls_->stream.async_read_some(into, std::move(moved));
  } else {
    socket_.async_read_some(into, std::move(moved));
  }
}

void ClientSocket::async_write(asio::const_buffer from, Moved moved) {
  if (tls_) {
    asio::async_write(tls_->stream, from, std::move(moved));
  } else {
    asio::async_write(socket_, from, std::move(moved));
  }
}

void ClientSocket::close() {
  error_code ignored;
  socket_.close(ignored);
}

}  // namespace skerry::client
