#include "server/net/common/tls_keys.hpp"

#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <ctime>
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

// A ticket keeps the client's certificate as it was verified then.
SSL_TICKET_RETURN take_ticket(SSL*, SSL_SESSION* session, const unsigned char*, std::size_t,
                              SSL_TICKET_STATUS status, void*) {
  if (status != SSL_TICKET_SUCCESS && status != SSL_TICKET_SUCCESS_RENEW) {
    return SSL_TICKET_RETURN_IGNORE_RENEW;
  }
  if (::SSL_SESSION_get0_peer(session) != nullptr) return SSL_TICKET_RETURN_IGNORE_RENEW;
  return status == SSL_TICKET_SUCCESS ? SSL_TICKET_RETURN_USE : SSL_TICKET_RETURN_USE_RENEW;
}

// Clients' certificates are those that `file` has signed itself, which need be no root.  It stays
// away from what the server sends of its own chain.
void ask_for_certificates(SSL_CTX* context, const std::filesystem::path& file) {
  facts_of_certificate(file);  // or why there is none
  X509_STORE* const store = ::X509_STORE_new();
  if (store == nullptr || ::SSL_CTX_set0_verify_cert_store(context, store) != 1 ||
      ::X509_STORE_load_file(store, file.c_str()) != 1 ||
      ::X509_STORE_set_flags(store, X509_V_FLAG_PARTIAL_CHAIN) != 1) {
    refuse(file, "no authority that OpenSSL takes");
  }
  // Browsers that have none by it do not bother anybody with the question.
  ::SSL_CTX_set_client_CA_list(context, ::SSL_load_client_CA_file(file.c_str()));
  constexpr int kIntermediates = 0;
  ::SSL_CTX_set_verify_depth(context, kIntermediates);
  // Bytes of all that a client sends of its chain: some ten certificates.
  constexpr long kMostOfChain = 16 * 1024;
  ::SSL_CTX_set_max_cert_list(context, kMostOfChain);
  ::SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
  constexpr std::string_view kResumedHere = "skerryd";  // a session by its own tickets alone
  ::SSL_CTX_set_session_id_context(context,
                                   reinterpret_cast<const unsigned char*>(kResumedHere.data()),
                                   static_cast<unsigned>(kResumedHere.size()));
  ::SSL_CTX_set_session_ticket_cb(context, nullptr, take_ticket, nullptr);
}

}  // namespace

TlsContextPtr read_tls(const TlsFiles& files) {
  const auto& [certificate, key, authority] = files;
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
  if (std::filesystem::exists(authority)) ask_for_certificates(raw, authority);
  ::ERR_clear_error();
  return context;
}

std::string certificate_shown(const SSL* connection) {
  const X509* const certificate = ::SSL_get0_peer_certificate(connection);
  if (certificate == nullptr) return {};
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  ::X509_digest(certificate, ::EVP_sha256(), digest.data(), &size);
  std::string text;
  for (unsigned i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

UtcTime certificate_end(const SSL* connection) {
  UtcTime first = UtcTime::max();
  if (::SSL_get0_peer_certificate(connection) == nullptr) return first;
  STACK_OF(X509)* const chain = ::SSL_get0_verified_chain(connection);
  for (int i = 0; i < sk_X509_num(chain); ++i) {
    std::tm end{};
    if (::ASN1_TIME_to_tm(::X509_get0_notAfter(sk_X509_value(chain, i)), &end) != 1) continue;
    // Later than UtcTime can tell is as good as never.
    const std::chrono::sys_seconds ends{std::chrono::seconds(::timegm(&end))};
    if (ends < std::chrono::floor<std::chrono::seconds>(UtcTime::max())) {
      first = std::min(first, UtcTime(ends));
    }
  }
  return first;
}

std::optional<std::string> certificate_fault(const SSL* connection) {
  const long fault = ::SSL_get_verify_result(connection);
  if (fault == X509_V_OK) return std::nullopt;
  return ::X509_verify_cert_error_string(fault);
}

TlsKeys::TlsKeys(const std::string& folder)
    : files_{std::filesystem::path(folder) / kServerCertificate,
             std::filesystem::path(folder) / kServerKey,
             std::filesystem::path(folder) / kAuthorityCertificate},
      read_at_(stamp()),
      seen_(read_at_),
      context_(read_tls(files_)) {}

TlsKeys::Stamp TlsKeys::stamp() const {
  const auto time_of = [](const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::last_write_time(file, ignored);
  };
  return {time_of(files_.certificate), time_of(files_.key), time_of(files_.authority)};
}

std::optional<std::string> TlsKeys::refresh(When when) {
  const Stamp now = stamp();
  const bool is_settled = std::exchange(seen_, now) == now;
  if (when == When::settled && (now == read_at_ || !is_settled)) return std::nullopt;
  read_at_ = now;
  try {
    context_ = read_tls(files_);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return std::nullopt;
}

}  // namespace skerry::server
