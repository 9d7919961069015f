// Writes the seeds of the fuzz target tls_records, and tells what the server makes of each.
// Usage: tls_seeds <tests/fuzz/corpus>
//
// The keys in tls_keys are anybody's: certificates of server and client by one authority, whose own
// key was thrown away, and of a stranger by himself, from 2020 to 2220.  With other keys, or where
// OpenSSL draws its random numbers in another order, a recorded handshake ends at its Finished:
// make the seeds anew.
#include <fmt/format.h>
#include <openssl/ssl.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tests/fuzz/corpus_folder.hpp"
#include "tests/fuzz/fuzz_require.hpp"
#include "tests/fuzz/tls_connection.hpp"

namespace {

using namespace skerry;
using Kind = fuzz::TlsOutcome::Kind;

constexpr std::uint64_t kClientsSeed = 2;

struct ClientOptions {
  int version = TLS1_3_VERSION;
  std::string certificate = {};  // "client"; empty: none
  std::string says = {};         // once it is connected
  std::string alpn = {};
  SSL_SESSION* session = nullptr;
};

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

// A client of OpenSSL, all of whose bytes are kept.
class RecordedClient {
 public:
  explicit RecordedClient(const ClientOptions& options) {
    random_.use();
    context_ = ::SSL_CTX_new(::TLS_client_method());
    ::SSL_CTX_set_min_proto_version(context_, options.version);
    ::SSL_CTX_set_max_proto_version(context_, options.version);
    if (!options.certificate.empty()) {
      const auto file = [&](const char* kind) {
        return fuzz::TlsConnection::key_file(options.certificate + kind);
      };
      ::SSL_CTX_use_certificate_chain_file(context_, file(".pem").c_str());
      ::SSL_CTX_use_PrivateKey_file(context_, file(".key").c_str(), SSL_FILETYPE_PEM);
    }
    if (!options.alpn.empty()) {
      ::SSL_CTX_set_alpn_protos(context_,
                                reinterpret_cast<const unsigned char*>(options.alpn.data()),
                                static_cast<unsigned>(options.alpn.size()));
    }
    ssl_ = ::SSL_new(context_);
    from_server_ = ::BIO_new(::BIO_s_mem());
    to_server_ = ::BIO_new(::BIO_s_mem());
    ::SSL_set_bio(ssl_, from_server_, to_server_);
    if (options.session != nullptr) ::SSL_set_session(ssl_, options.session);
    const bool is_done = step([&] { return ::SSL_connect(ssl_); });
    if (is_done && !options.says.empty()) {
      step([&] {
        return ::SSL_write(ssl_, options.says.data(), static_cast<int>(options.says.size()));
      });
    }
    char ignored = 0;
    random_.use();
    ::SSL_read(ssl_, &ignored, 1);  // the tickets
    if (is_done) {
      random_.use();
      ::SSL_shutdown(ssl_);
      pass_on();
    }
    session_ = ::SSL_get1_session(ssl_);
    server_.finish();
  }
  ~RecordedClient() {
    ::SSL_SESSION_free(session_);
    ::SSL_free(ssl_);
    ::SSL_CTX_free(context_);
  }
  RecordedClient(const RecordedClient&) = delete;
  RecordedClient& operator=(const RecordedClient&) = delete;

  const Bytes& sent() const { return sent_; }
  SSL_SESSION* session() const { return session_; }

 private:
  // Until it has done so; false: the server does not go along.
  template <typename Act>
  bool step(const Act& act) {
    for (;;) {
      random_.use();
      const int done = act();
      const std::size_t before = sent_.size();
      const bool heard = pass_on();
      if (done == 1 || (done > 0 && sent_.size() > before)) return true;
      if (!heard) return false;
    }
  }
  // False if nothing came back.
  bool pass_on() {
    char* data = nullptr;
    const long size = ::BIO_get_mem_data(to_server_, &data);
    const Bytes bytes(data, data + size);
    (void)BIO_reset(to_server_);
    sent_.insert(sent_.end(), bytes.begin(), bytes.end());
    server_.send(bytes);
    const Bytes answer = server_.take_answer();
    if (!answer.empty()) {
      ::BIO_write(from_server_, answer.data(), static_cast<int>(answer.size()));
    }
    return !answer.empty();
  }

  fuzz::TlsConnection server_;
  fuzz::FixedRandom random_{kClientsSeed};
  SSL_CTX* context_ = nullptr;
  SSL* ssl_ = nullptr;
  BIO *from_server_ = nullptr, *to_server_ = nullptr;
  SSL_SESSION* session_ = nullptr;
  Bytes sent_;
};

const char* name_of(Kind kind) {
  return kind == Kind::none ? "ended" : kind == Kind::plain ? "plain" : "secure";
}

class Seeds {
 public:
  explicit Seeds(const std::filesystem::path& folder) : corpus_(folder) {}

  // What becomes of it must be this.
  void write(const std::string& name, const Bytes& bytes, Kind expected, bool certificate = false) {
    fuzz::TlsConnection connection;
    connection.send(bytes);
    connection.finish();
    const fuzz::TlsOutcome& outcome = connection.outcome();
    fmt::print("{:<28} {:6} bytes: {}, {} heard{}\n", name, bytes.size(), name_of(outcome.kind),
               outcome.heard.size(), outcome.certificate.empty() ? "" : ", certificate");
    fuzz::require(outcome.kind == expected, name.c_str());
    fuzz::require(outcome.certificate.empty() != certificate, name.c_str());
    corpus_.write(name, bytes);
  }

 private:
  fuzz::CorpusFolder corpus_;
};

// The first record of what a client sent.
Bytes first_record(const Bytes& sent) {
  const std::size_t size = std::size_t{5} + sent[3] * 256U + sent[4];
  return {sent.begin(), sent.begin() + static_cast<std::ptrdiff_t>(std::min(size, sent.size()))};
}

Bytes joined(const Bytes& a, const Bytes& b) {
  Bytes both = a;
  both.insert(both.end(), b.begin(), b.end());
  return both;
}

// A hello in records of one byte each.
Bytes in_shreds(const Bytes& hello) {
  Bytes shreds;
  for (std::size_t i = 5; i < hello.size(); ++i) {
    shreds.insert(shreds.end(), {hello[0], hello[1], hello[2], 0, 1, hello[i]});
  }
  return shreds;
}

void write_handshakes(Seeds& seeds, const std::string& name, int version) {
  const std::string request = "GET /status HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
  const RecordedClient plain({.version = version, .says = request});
  const Bytes hello = first_record(plain.sent());
  seeds.write(name + "_hello", hello, Kind::none);
  seeds.write(name + "_hello_cut", {hello.begin(), hello.begin() + 40}, Kind::none);
  seeds.write(name + "_hello_in_shreds", in_shreds(hello), Kind::none);
  seeds.write(name + "_hello_twice", joined(hello, hello), Kind::none);
  const Bytes alert{21, 3, 3, 0, 2, 2, 40};  // fatal: handshake_failure
  seeds.write(name + "_hello_alert", joined(hello, alert), Kind::none);
  seeds.write(name + "_handshake", plain.sent(), Kind::secure);
  const RecordedClient talks({.version = version, .says = std::string(9000, 'x')});
  seeds.write(name + "_application_data", talks.sent(), Kind::secure);
  const RecordedClient h2({.version = version, .alpn = std::string("\2h2\10http/1.1", 12)});
  seeds.write(name + "_alpn", h2.sent(), Kind::secure);
  const RecordedClient known({.version = version, .certificate = "client", .says = request});
  seeds.write(name + "_certificate", known.sent(), Kind::secure, true);
  const RecordedClient stranger({.version = version, .certificate = "stranger", .says = request});
  seeds.write(name + "_other_authority", stranger.sent(), Kind::none);
  // Tickets have a time: they are refused two hours from now, and all is negotiated.
  const RecordedClient again({.version = version, .says = request, .session = plain.session()});
  seeds.write(name + "_resumed", again.sent(), Kind::secure);
}

}  // namespace

int main(int argc, char** argv) {
  Seeds seeds(fuzz::corpora(argc, argv) / "tls_records");
  write_handshakes(seeds, "tls12", TLS1_2_VERSION);
  write_handshakes(seeds, "tls13", TLS1_3_VERSION);
  seeds.write("alert", {21, 3, 3, 0, 2, 2, 40}, Kind::plain);
  seeds.write("application_data", {23, 3, 3, 0, 4, 1, 2, 3, 4}, Kind::plain);
  seeds.write("http", bytes_of("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"), Kind::plain);
  seeds.write("sslv2_hello", {0x80, 0x2E, 1, 0, 2, 0, 0x15, 0, 0, 0, 0x10}, Kind::plain);
  seeds.write("one_byte", {22}, Kind::none);
  seeds.write("garbage", joined({22, 3, 1, 0, 4}, bytes_of("zzzz")), Kind::none);
  seeds.write("longest_record", joined({22, 3, 3, 0xFF, 0xFF}, Bytes(66'000, 0)), Kind::none);
  seeds.write("empty_records", joined({22, 3, 1, 0, 0}, {22, 3, 1, 0, 0}), Kind::none);
  return 0;
}
