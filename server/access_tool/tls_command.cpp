#include "server/access_tool/tls_command.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "echo/tool_console/console.hpp"
#include "server/tls/certificate.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

struct TlsGiven {
  std::string folder = "tls";
  std::vector<std::string> names;
};

std::shared_ptr<TlsGiven> tls_given_to(CLI::App& command) {
  auto given = std::make_shared<TlsGiven>();
  command.add_option("FOLDER", given->folder, "that skerryd --tls reads")->capture_default_str();
  return given;
}

std::string host_name_here() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : std::string();
}

// How this host may be reached: its name and addresses, and loopback.
std::vector<std::string> names_of_this_host() {
  std::vector<std::string> names;
  if (const std::string name = host_name_here(); !name.empty()) names.push_back(name);
  names.insert(names.end(), {"localhost", "127.0.0.1", "::1"});
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return names;
  for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || (each->ifa_flags & IFF_LOOPBACK) != 0) continue;
    if (each->ifa_addr->sa_family != AF_INET) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
    ::inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
    if (std::find(names.begin(), names.end(), text.data()) == names.end()) {
      names.emplace_back(text.data());
    }
  }
  ::freeifaddrs(all);
  return names;
}

std::string facts_text(const CertificateFacts& facts) {
  return fmt::format("for {}; until {} ({} days); SHA-256 {}", fmt::join(facts.names, ", "),
                     facts.ends, facts.days_left, facts.fingerprint);
}

void tell_steps(const fs::path& folder, const CertificateFacts& facts) {
  fmt::print(
      stderr,
      "{0}: {1}\n"
      "Start the server with\n"
      "  skerryd --bind ADDRESS --tls {2} --users users.yaml\n"
      "A browser needs two steps, once on each computer:\n"
      "  1. Copy {3} to it (a memory stick will do; the file is no secret).\n"
      "  2. Import it as an authority for web sites. Chromium, Chrome, Edge: Settings,\n"
      "     Privacy and security, Security, Manage certificates, Authorities, Import.\n"
      "     Firefox: Settings, Privacy & Security, View Certificates, Authorities, Import.\n"
      "Then open https://{4}:7480/.  Commands take it from the environment:\n"
      "  SKERRY_CA={3} skerry status --host tls://{4}\n"
      "{5} makes further certificates, and the server does not need it: keep it elsewhere.\n",
      (folder / kServerCertificate).string(), facts_text(facts), folder.string(),
      (folder / kAuthorityCertificate).string(), facts.names.front(),
      (folder / kAuthorityKey).string());
}

echo::Command make_tls_init_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("init", "Makes an authority, and a certificate for this server");
  const auto given = tls_given_to(*command);
  command->add_option("--name", given->names,
                      "host name or address by which the server is reached; several may be given "
                      "(this host's name and addresses)");
  return {command, [given] {
            if (given->names.empty()) given->names = names_of_this_host();
            make_authority(given->folder, "Skerry authority of " + given->names.front());
            make_server_certificate(given->folder, given->names);
            tell_steps(given->folder,
                       facts_of_certificate(fs::path(given->folder) / kServerCertificate));
            return echo::kExitOk;
          }};
}

echo::Command make_tls_renew_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("renew", "Makes another certificate by the same authority");
  const auto given = tls_given_to(*command);
  command->add_option("--name", given->names, "as of init (those of the certificate before)");
  return {command, [given] {
            const fs::path file = fs::path(given->folder) / kServerCertificate;
            if (given->names.empty()) given->names = facts_of_certificate(file).names;
            make_server_certificate(given->folder, given->names);
            fmt::print(stderr,
                       "{}: {}\nA server that runs takes it within two seconds; connections that "
                       "are there go on.\n",
                       file.string(), facts_text(facts_of_certificate(file)));
            return echo::kExitOk;
          }};
}

echo::Command make_tls_show_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("show", "Tells what the certificates are for and how long");
  const auto given = tls_given_to(*command);
  return {command, [given] {
            for (const char* name : {kAuthorityCertificate, kServerCertificate}) {
              const fs::path file = fs::path(given->folder) / name;
              const CertificateFacts facts = facts_of_certificate(file);
              echo::write_out(fmt::format(
                  "{}: {}\n", file.string(),
                  facts.names.empty() ? fmt::format("until {} ({} days); SHA-256 {}", facts.ends,
                                                    facts.days_left, facts.fingerprint)
                                      : facts_text(facts)));
            }
            return echo::kExitOk;
          }};
}

}  // namespace

std::vector<echo::Command> make_tls_commands(CLI::App& app) {
  return {make_tls_init_command(app), make_tls_renew_command(app), make_tls_show_command(app)};
}

}  // namespace skerry::server
