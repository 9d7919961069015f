#include "server/net/common/tls_keys.hpp"

#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include <stdexcept>
#include <string_view>
#include <utility>

#include "server/tls/certificate.hpp"

namespace skerry::server {
namespace {

constexpr const char* kCiphers =
    "ECDHE-ECDSA-AES128-GCM-SHA256:ECDHE-RSA-AES128-GCM-SHA256:"
    "ECDHE-ECDSA-AES256-GCM-SHA384:ECDHE-RSA-AES256-GCM-SHA384:"
    "ECDHE-ECDSA-CHACHA20-POLY1305:ECDHE-RSA-CHACHA20-POLY1305";
constexpr const char* kGroups = "X25519:P-256:P-384";

constexpr std::string_view kAdvice = "; `skerry tls init FOLDER` makes a certificate and its key";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}{}", file.string(), what, kAdvice));
}

// A key that needs a passphrase would otherwise ask for it on the terminal.
int no_passphrase(char*, int, int, void*) { return 0; }

// Browsers offer "h2" before it; whoever offers neither is served all the same.
int choose_protocol(SSL*, const unsigned char** chosen, unsigned char* length,
                    const unsigned char* offered, unsigned offered_length, void*) {
  constexpr std::string_view kHttp = "http/1.1";
  const std::string_view all(reinterpret_cast<const char*>(offered), offered_length);
  for (std::size_t at = 0; at < all.size();) {
    const auto size = static_cast<unsigned char>(all[at]);
    if (all.substr(at + 1, size) == kHttp) {
      *chosen = offered + at + 1;
      *length = size;
      return SSL_TLSEXT_ERR_OK;
    }
    at += 1u + size;
  }
  return SSL_TLSEXT_ERR_NOACK;
}

}  // namespace

TlsContextPtr read_tls(const std::filesystem::path& certificate, const std::filesystem::path& key) {
  ::ERR_clear_error();
  require_certificate(certificate);
  auto context = std::make_shared<asio::ssl::context>(asio::ssl::context::tls_server);
  SSL_CTX* const raw = context->native_handle();
  ::SSL_CTX_set_min_proto_version(raw, TLS1_2_VERSION);
  ::SSL_CTX_set_options(raw, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION |
                                 SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_PRIORITIZE_CHACHA);
  ::SSL_CTX_set_mode(raw, SSL_MODE_RELEASE_BUFFERS);
  ::SSL_CTX_set_session_cache_mode(raw, SSL_SESS_CACHE_OFF);
  ::SSL_CTX_set_default_passwd_cb(raw, no_passphrase);
  ::SSL_CTX_set_alpn_select_cb(raw, choose_protocol, nullptr);
  if (::SSL_CTX_set_cipher_list(raw, kCiphers) != 1 ||
      ::SSL_CTX_set1_groups_list(raw, kGroups) != 1) {
    throw std::runtime_error("OpenSSL knows none of the ciphers that skerryd offers");
  }
  error_code error;
  context->use_certificate_chain_file(certificate.string(), error);
  if (error) refuse(certificate, "no certificate that OpenSSL takes: " + error.message());
  context->use_private_key_file(key.string(), asio::ssl::context::pem, error);
  if (error) {
    refuse(key, std::filesystem::exists(key)
                    ? "not the private key of " + certificate.filename().string() +
                          " in PEM without a passphrase: " + error.message()
                    : "there is no such file; expected a private key in PEM");
  }
  if (::SSL_CTX_check_private_key(raw) != 1) refuse(key, "the key is of another certificate");
  ::ERR_clear_error();
  return context;
}

TlsKeys::TlsKeys(const std::string& folder)
    : certificate_(std::filesystem::path(folder) / kServerCertificate),
      key_(std::filesystem::path(folder) / kServerKey),
      read_at_(stamp()),
      seen_(read_at_),
      context_(read_tls(certificate_, key_)) {}

TlsKeys::Stamp TlsKeys::stamp() const {
  std::error_code ignored;
  return {std::filesystem::last_write_time(certificate_, ignored),
          std::filesystem::last_write_time(key_, ignored)};
}

std::optional<std::string> TlsKeys::refresh(When when) {
  const Stamp now = stamp();
  const bool is_settled = std::exchange(seen_, now) == now;
  if (when == When::settled && (now == read_at_ || !is_settled)) return std::nullopt;
  read_at_ = now;
  try {
    context_ = read_tls(certificate_, key_);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return std::nullopt;
}

}  // namespace skerry::server
