// Certificates: an authority of one's own, and certificates by it, without any network.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skerry::server {

inline constexpr const char* kAuthorityCertificate = "authority.pem";
inline constexpr const char* kAuthorityKey = "authority.key";
inline constexpr const char* kServerCertificate = "server.pem";
inline constexpr const char* kServerKey = "server.key";

// Browsers take no certificate of a server that holds for longer than 825 days (CA/Browser Forum
// Baseline Requirements 6.3.2, and Apple's for authorities that users add).  Clients' hold as long.
inline constexpr std::chrono::days kServerValidity{825};
inline constexpr std::chrono::days kAuthorityValidity{3650};

// A key (EC P-256) and a self-signed certificate that may sign those of servers, in `folder`, which
// is made if missing; the key can be read by its owner alone.
// Error: std::runtime_error naming the file: it cannot be written, or is there already.
void make_authority(const std::filesystem::path& folder, const std::string& name);

// A key and a certificate for a server that is reached by these names: host names and IP addresses,
// at least one.  Signed by the authority in `folder`, and written there in place of an earlier one.
// Error: std::runtime_error naming the file or name.
void make_server_certificate(const std::filesystem::path& folder,
                             const std::vector<std::string>& names);

// A key and a certificate by which a client says who it is: NAME.key and NAME.pem, signed by the
// authority in `folder`, and written there.  `renews`: in place of those that must be there;
// otherwise there must be none.
// Error: std::runtime_error naming the file or name; then the files are as before.
enum class ClientFiles : std::uint8_t { are_new, are_renewed };
void make_client_certificate(const std::filesystem::path& folder, const std::string& name,
                             ClientFiles files);
// Of a client of that name.
std::filesystem::path client_certificate_file(const std::filesystem::path& folder,
                                              const std::string& name);

struct CertificateFacts {
  std::vector<std::string> names;  // that it is for
  std::string common_name;         // of a client: its name
  bool is_for_clients = false;     // a client may show it
  std::string ends;                // "2029-03-01"
  std::chrono::sys_seconds until;  // the same to the second
  long days_left = 0;              // negative: it has ended
  std::string fingerprint;         // SHA-256, "AB:CD:..."
  std::string sha256;              // the same as 64 hexadecimal digits, lower case
};

// Of the first certificate in a PEM file.
// Error: std::runtime_error naming the file and the line of the block that is none.
CertificateFacts facts_of_certificate(const std::filesystem::path& file);

// Error: the same, or that the certificate has ended or does not hold yet.
void require_certificate(const std::filesystem::path& file);

}  // namespace skerry::server
