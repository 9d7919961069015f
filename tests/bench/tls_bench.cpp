// What a TLS handshake costs the server, with and without a certificate of the client: both sides
// in memory, of which the server's steps are timed.
#include <benchmark/benchmark.h>
#include <openssl/ssl.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "server/net/common/tls_keys.hpp"
#include "server/tls/certificate.hpp"

namespace {

using namespace skerry::server;
namespace fs = std::filesystem;

// Made for this run.
class Keys {
 public:
  Keys() {
    make_authority(folder_, "Bench authority");
    make_server_certificate(folder_, {"localhost"});
    make_client_certificate(folder_, "client", ClientFiles::are_new);
    server = read_tls(
        {folder_ / kServerCertificate, folder_ / kServerKey, folder_ / kAuthorityCertificate});
    alone = read_tls({folder_ / kServerCertificate, folder_ / kServerKey});
  }
  ~Keys() { fs::remove_all(folder_); }
  fs::path file(const char* name) const { return folder_ / name; }

  TlsContextPtr server;  // asks for a certificate
  TlsContextPtr alone;   // does not

 private:
  fs::path folder_ = fs::temp_directory_path() / ("skerry-tls-bench-" + std::to_string(::getpid()));
};

struct FreeContext {
  void operator()(SSL_CTX* context) const { ::SSL_CTX_free(context); }
};
struct FreeConnection {
  void operator()(SSL* connection) const { ::SSL_free(connection); }
};
using Connection = std::unique_ptr<SSL, FreeConnection>;

enum Client { kNotAsked, kHasNone, kHasOne };

void handshake(benchmark::State& state, int version, Client client) {
  static const Keys keys;
  const std::unique_ptr<SSL_CTX, FreeContext> context(::SSL_CTX_new(::TLS_client_method()));
  ::SSL_CTX_set_max_proto_version(context.get(), version);
  if (client == kHasOne) {
    ::SSL_CTX_use_certificate_chain_file(context.get(), keys.file("client.pem").c_str());
    ::SSL_CTX_use_PrivateKey_file(context.get(), keys.file("client.key").c_str(), SSL_FILETYPE_PEM);
  }
  SSL_CTX* const theirs = (client == kNotAsked ? keys.alone : keys.server)->native_handle();
  for (auto _ : state) {
    const Connection server(::SSL_new(theirs)), other(::SSL_new(context.get()));
    BIO *near = nullptr, *far = nullptr;
    ::BIO_new_bio_pair(&near, 1 << 16, &far, 1 << 16);
    ::SSL_set_bio(server.get(), near, near);
    ::SSL_set_bio(other.get(), far, far);
    ::SSL_set_accept_state(server.get());
    ::SSL_set_connect_state(other.get());
    std::chrono::duration<double> spent{0};
    bool is_done = false;
    while (!is_done) {
      const int connected = ::SSL_do_handshake(other.get());
      const auto began = std::chrono::steady_clock::now();
      const int accepted = ::SSL_do_handshake(server.get());
      spent += std::chrono::steady_clock::now() - began;
      is_done = accepted == 1 && connected == 1;
      if (accepted != 1 && ::SSL_get_error(server.get(), accepted) != SSL_ERROR_WANT_READ) {
        throw std::runtime_error("no handshake");
      }
    }
    if (certificate_shown(server.get()).empty() == (client == kHasOne)) {
      throw std::runtime_error("the certificate is not as meant");
    }
    state.SetIterationTime(spent.count());
  }
}

#define SKERRY_HANDSHAKE(name, version, client)       \
  BENCHMARK_CAPTURE(handshake, name, version, client) \
      ->UseManualTime()                               \
      ->Unit(benchmark::kMicrosecond)
SKERRY_HANDSHAKE(tls13_not_asked, TLS1_3_VERSION, kNotAsked);
SKERRY_HANDSHAKE(tls13_without_certificate, TLS1_3_VERSION, kHasNone);
SKERRY_HANDSHAKE(tls13_with_certificate, TLS1_3_VERSION, kHasOne);
SKERRY_HANDSHAKE(tls12_not_asked, TLS1_2_VERSION, kNotAsked);
SKERRY_HANDSHAKE(tls12_without_certificate, TLS1_2_VERSION, kHasNone);
SKERRY_HANDSHAKE(tls12_with_certificate, TLS1_2_VERSION, kHasOne);

}  // namespace

BENCHMARK_MAIN();
