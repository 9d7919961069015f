#include "clients/common/client_socket.hpp"

#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

namespace skerry::client {
namespace {

namespace asio = boost::asio;
namespace ssl = boost::asio::ssl;

constexpr std::string_view kSecure = "tls://";

// Empty: not given.
std::string_view in_environment(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? "" : text;
}

std::string no_such_pem(const char* name, std::string_view file, const char* expected) {
  return fmt::format("{}: {}: {}; expected {}", name, file,
                     std::filesystem::exists(file) ? "not that in PEM" : "there is no such file",
                     expected);
}

// What is wrong with the certificate that the client has; empty if nothing is, or it has none.
std::string take_certificate(ssl::context& context) {
  constexpr const char *kCert = "SKERRY_CERT", *kKey = "SKERRY_KEY";
  const std::string_view certificate = in_environment(kCert), key = in_environment(kKey);
  if (certificate.empty() && key.empty()) return {};
  if (certificate.empty() || key.empty()) {
    return fmt::format(
        "{} is given and {} is not; a client's certificate needs both: NAME.pem and NAME.key, as "
        "`skerry tls client NAME` made them",
        key.empty() ? kCert : kKey, key.empty() ? kKey : kCert);
  }
  // A key that needs a passphrase would otherwise ask for it on the terminal.
  ::SSL_CTX_set_default_passwd_cb(context.native_handle(),
                                  [](char*, int, int, void*) { return 0; });
  boost::system::error_code error;
  context.use_certificate_chain_file(std::string(certificate), error);
  if (error) {
    return no_such_pem(kCert, certificate,
                       "a client's certificate, as `skerry tls client NAME` makes NAME.pem");
  }
  context.use_private_key_file(std::string(key), ssl::context::pem, error);
  const bool is_of_another =
      ERR_GET_REASON(static_cast<unsigned long>(error.value())) == X509_R_KEY_VALUES_MISMATCH;
  if (error && is_of_another) {
    return fmt::format("{}: {}: the key of another certificate than {}, {}", kKey, key, kCert,
                       certificate);
  }
  if (error) {
    return no_such_pem(kKey, key, "the certificate's private key, without a passphrase");
  }
  return {};
}

bool refuses_certificate(const boost::system::error_code& error) {
  if (error.category() != asio::error::get_ssl_category()) return false;
  switch (ERR_GET_REASON(static_cast<unsigned long>(error.value()))) {
    case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_UNSUPPORTED_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_REVOKED:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
    case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
      return true;
    default:
      return false;
  }
}

}  // namespace

HostName::HostName(const std::string& text) : name(text) {
  if (!text.starts_with(kSecure)) return;
  secure = true;
  name = text.substr(kSecure.size());
}

struct ClientSocket::Tls {
  Tls(tcp::socket& socket, ssl::context keys) : context(std::move(keys)), stream(socket, context) {}
  ssl::context context;
  ssl::stream<tcp::socket&> stream;
};

ClientSocket::ClientSocket(asio::io_context& io) : socket_(io) {}
ClientSocket::~ClientSocket() = default;

std::string ClientSocket::begin_tls(const HostName& host) {
  ssl::context keys(ssl::context::tls_client);
  ::SSL_CTX_set_min_proto_version(keys.native_handle(), TLS1_2_VERSION);
  error_code error;
  if (const std::string_view file = in_environment("SKERRY_CA"); !file.empty()) {
    keys.load_verify_file(std::string(file), error);
    if (error) {
      return fmt::format(
          "SKERRY_CA: {}: no certificates in PEM that can be read; expected the "
          "authority.pem that `skerry tls init` made",
          file);
    }
  } else {
    keys.set_default_verify_paths(error);
  }
  if (std::string fault = take_certificate(keys); !fault.empty()) return fault;
  auto tls = std::make_unique<Tls>(socket_, std::move(keys));
  SSL* const raw = tls->stream.native_handle();
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
  if (fault == X509_V_OK) return in_words(error);
  return fmt::format(
      "its certificate is not trusted: {}; SKERRY_CA names the file of authorities, "
      "the server's authority.pem",
      ::X509_verify_cert_error_string(fault));
}

std::string ClientSocket::in_words(const error_code& error) const {
  if (!tls_ || !refuses_certificate(error)) return error.message();
  return fmt::format("it does not take the certificate of SKERRY_CERT: {}", error.message());
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
