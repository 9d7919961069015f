#include "tests/unit/net/test_tls.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <openssl/x509.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>

namespace skerry::server {

TestTls::TestTls(std::uint16_t port, const TestTlsOptions& options) {
  context_ = ::SSL_CTX_new(::TLS_client_method());
  // Old versions must fail for the server's reasons, not for those of this side.
  ::SSL_CTX_set_security_level(context_, 0);
  if (options.least != 0) ::SSL_CTX_set_min_proto_version(context_, options.least);
  if (options.most != 0) ::SSL_CTX_set_max_proto_version(context_, options.most);
  if (!options.ciphers.empty()) ::SSL_CTX_set_cipher_list(context_, options.ciphers.c_str());
  if (!options.authority.empty()) {
    ::SSL_CTX_load_verify_file(context_, options.authority.c_str());
    ::SSL_CTX_set_verify(context_, SSL_VERIFY_PEER, nullptr);
  }
  if (!options.certificate.empty()) {
    const auto key = std::filesystem::path(options.certificate).replace_extension(".key");
    const bool is_pair =
        ::SSL_CTX_use_certificate_chain_file(context_, options.certificate.c_str()) == 1 &&
        ::SSL_CTX_use_PrivateKey_file(context_, key.c_str(), SSL_FILETYPE_PEM) == 1;
    if (!is_pair) throw std::runtime_error(options.certificate + ": no pair with its key");
  }
  socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
  const timeval patience{30, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_port = htons(port);
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ssl_ = ::SSL_new(context_);
  ::SSL_set_fd(ssl_, socket_);
  ::X509_VERIFY_PARAM_set1_ip_asc(::SSL_get0_param(ssl_), "127.0.0.1");
  if (options.session != nullptr) ::SSL_set_session(ssl_, options.session);
  open_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&where), sizeof where) == 0 &&
          ::SSL_connect(ssl_) == 1;
}

TestTls::~TestTls() {
  ::SSL_free(ssl_);
  ::SSL_CTX_free(context_);
  ::close(socket_);
}

std::string TestTls::fingerprint() const {
  X509* const certificate = ::SSL_get1_peer_certificate(ssl_);
  if (certificate == nullptr) return "no certificate";
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  ::X509_digest(certificate, ::EVP_sha256(), digest.data(), &size);
  ::X509_free(certificate);
  std::string text;
  for (unsigned i = 0; i < size; ++i) text += fmt::format("{}{:02X}", i == 0 ? "" : ":", digest[i]);
  return text;
}

bool TestTls::renegotiate() {
  return ::SSL_renegotiate(ssl_) == 1 && ::SSL_do_handshake(ssl_) == 1 &&
         ::SSL_write(ssl_, "G", 1) == 1 && ::SSL_renegotiate_pending(ssl_) == 0 &&
         ::SSL_num_renegotiations(ssl_) > 0;
}

void TestTls::send(const std::string& text) {
  ::SSL_write(ssl_, text.data(), static_cast<int>(text.size()));
}

std::string TestTls::receive(std::size_t least) {
  std::string all;
  std::array<char, 16384> piece;
  while (all.size() < least) {
    const int got = ::SSL_read(ssl_, piece.data(), piece.size());
    if (got <= 0) break;
    all.append(piece.data(), static_cast<std::size_t>(got));
  }
  return all;
}

}  // namespace skerry::server
