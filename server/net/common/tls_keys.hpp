// TlsKeys: the server's certificate and key, as files and as what connections are made with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "protocol/quantity/time.hpp"
#include "server/net/common/asio.hpp"

namespace skerry::server {

using TlsContextPtr = std::shared_ptr<asio::ssl::context>;

// PEM files.
struct TlsFiles {
  std::filesystem::path certificate, key;
  std::filesystem::path authority = {};  // of clients' certificates; not there: none is asked for
};

// What a server offers with these files: TLS 1.3 and 1.2, forward secret and authenticated ciphers
// alone, no compression and no renegotiation (BSI TR-02102-2; Mozilla's "intermediate").
// With an authority clients are asked for a certificate by it, and may have none; a handshake with
// another one, or one that does not hold now, fails.  A session that had one is not resumed: who
// comes again is verified again.
// Error: std::runtime_error naming the file, what is wrong with it and what to do.
TlsContextPtr read_tls(const TlsFiles& files);

// The SHA-256 of the certificate that the client has shown, as 64 hexadecimal digits, lower case;
// empty: none.  Requires that the handshake is done.
std::string certificate_shown(const SSL* connection);
// When that, or that of the authority that has signed it, ends, to the second; UtcTime::max(): it
// has shown none.  Requires the same.
UtcTime certificate_end(const SSL* connection);
// What is wrong with the certificate that it has shown; nothing: not that, or it has shown none.
std::optional<std::string> certificate_fault(const SSL* connection);

// The files that `skerry tls init FOLDER` makes, server.pem, server.key and authority.pem.
// Thread: net-0, but for the constructor.
class TlsKeys {
 public:
  // Error: as read_tls().
  explicit TlsKeys(const std::string& folder);

  // For connections that begin now; those that are there go on with what they have.
  const TlsContextPtr& context() const { return context_; }
  // Reads the files again if they have changed and then stayed the same for a call: they are not
  // changed at once.  Call it once a second, with `now` to do so at once.  What was wrong with
  // them, once for each change; then the keys from before hold.
  enum class When : std::uint8_t { settled, now };
  std::optional<std::string> refresh(When when = When::settled);

 private:
  struct Stamp {
    std::filesystem::file_time_type certificate, key, authority;
    bool operator==(const Stamp&) const = default;
  };
  Stamp stamp() const;

  TlsFiles files_;
  Stamp read_at_, seen_;
  TlsContextPtr context_;
};

}  // namespace skerry::server
