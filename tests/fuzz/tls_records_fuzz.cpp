// What a stranger sends to a port that does TLS: the decision by the first byte, the handshake with
// the server's own options, with and without a client's certificate, and what it then says.
#include <string>

#include "server/tls/certificate.hpp"
#include "tests/fuzz/fuzz_require.hpp"
#include "tests/fuzz/tls_connection.hpp"

namespace {

using namespace skerry;
using Kind = fuzz::TlsOutcome::Kind;

constexpr std::uint8_t kHandshakeRecord = 22;
// What a server sends to one that does no more than to begin: its certificate, an alert, tickets.
constexpr std::size_t kMostAnswer = 16 * 1024;

const std::string& digest_of_client() {
  static const std::string digest =
      server::facts_of_certificate(fuzz::TlsConnection::key_file("client.pem")).sha256;
  return digest;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  fuzz::TlsConnection connection;
  fuzz::require(connection.outcome().times == 0, "who says nothing is not handed on");
  // In pieces, as a network cuts it.
  fuzz::Choices choices(input);
  for (auto rest = input; !rest.empty();) {
    const std::size_t piece = std::min(rest.size(), 1 + choices.below(16384));
    connection.send(rest.first(piece));
    rest = rest.subspan(piece);
  }
  connection.finish();
  const fuzz::TlsOutcome& outcome = connection.outcome();
  const std::size_t answered = connection.take_answer().size();
  fuzz::require(outcome.times <= 1, "a connection is handed on once");
  fuzz::require(outcome.is_secure == (outcome.kind == Kind::secure), "its peer knows how");
  fuzz::require(outcome.certificate.empty() || outcome.certificate == digest_of_client(),
                "no bytes make a certificate that the authority has not signed");
  fuzz::require(answered <= kMostAnswer, "the answer is bounded");
  if (size == 0) {
    fuzz::require(outcome.kind == Kind::none, "who says nothing and goes is forgotten");
  } else if (data[0] != kHandshakeRecord) {
    fuzz::require(outcome.kind == Kind::plain, "what is no handshake is plain");
    fuzz::require(outcome.heard == Bytes(input.begin(), input.end()), "and all of it is heard");
    fuzz::require(outcome.certificate.empty() && answered == 0, "by nobody, without an answer");
  } else {
    fuzz::require(outcome.kind != Kind::plain, "what begins a handshake is never plain");
    fuzz::require(outcome.heard.size() < size, "records hold less than they are");
  }
  return 0;
}
