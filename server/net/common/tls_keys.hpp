// TlsKeys: the server's certificate and key, as files and as what connections are made with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "server/net/common/asio.hpp"

namespace skerry::server {

using TlsContextPtr = std::shared_ptr<asio::ssl::context>;

// What a server offers with these files: TLS 1.3 and 1.2, forward secret and authenticated ciphers
// alone, no compression and no renegotiation (BSI TR-02102-2; Mozilla's "intermediate").
// Error: std::runtime_error naming the file, what is wrong with it and what to do.
TlsContextPtr read_tls(const std::filesystem::path& certificate, const std::filesystem::path& key);

// The two files that `skerry tls init FOLDER` makes, server.pem and server.key.  Thread: net-0, but
// for the constructor.
class TlsKeys {
 public:
  // Error: as read_tls().
  explicit TlsKeys(const std::string& folder);

  // For connections that begin now; those that are there go on with what they have.
  const TlsContextPtr& context() const { return context_; }
  // Reads the files again if they have changed and then stayed the same for a call: two files are
  // not changed at once.  Call it once a second, with `now` to do so at once.  What was wrong with
  // them, once for each change; then the keys from before hold.
  enum class When : std::uint8_t { settled, now };
  std::optional<std::string> refresh(When when = When::settled);

 private:
  struct Stamp {
    std::filesystem::file_time_type certificate, key;
    bool operator==(const Stamp&) const = default;
  };
  Stamp stamp() const;

  std::filesystem::path certificate_, key_;
  Stamp read_at_, seen_;
  TlsContextPtr context_;
};

}  // namespace skerry::server
