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
  std::string client;
  bool renews = false;
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
  const std::string what =
      !facts.names.empty()   ? fmt::format("for {}; ", fmt::join(facts.names, ", "))
      : facts.is_for_clients ? fmt::format("of the client {}; ", facts.common_name)
                             : "";
  return fmt::format("{}until {} ({} days); SHA-256 {}", what, facts.ends, facts.days_left,
                     facts.fingerprint);
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

echo::Command make_tls_client_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "client", "Makes a certificate by which another program says who it is, NAME.pem");
  const auto given = std::make_shared<TlsGiven>();
  command->add_option("NAME", given->client, "of the client, and of its two files")->required();
  command->add_option("FOLDER", given->folder, "of the authority that skerryd --tls reads")
      ->capture_default_str();
  command->add_flag("--renew", given->renews, "another in place of the one before");
  return {command, [given] {
            make_client_certificate(
                given->folder, given->client,
                given->renews ? ClientFiles::are_renewed : ClientFiles::are_new);
            const fs::path file = client_certificate_file(given->folder, given->client);
            fmt::print(
                stderr,
                "{0}: {1}\n"
                "{2}Say what it may do, where the server's tokens are:\n"
                "  skerry token new {3} --role observer --certificate {0}\n"
                "Then move it and {4} to the client's host, and start the client with\n"
                "  SKERRY_CERT={3}.pem SKERRY_KEY={3}.key SKERRY_CA={5}\n",
                file.string(), facts_text(facts_of_certificate(file)),
                given->renews
                    ? fmt::format("The entry of the one before does not hold for it: `skerry token "
                                  "revoke {}` ends that.\n",
                                  given->client)
                    : "",
                given->client, (fs::path(given->folder) / (given->client + ".key")).string(),
                kAuthorityCertificate);
            return echo::kExitOk;
          }};
}

// Those of clients, by name.  What else is there is none of this tool's.
std::vector<fs::path> client_certificates(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".pem" || file.filename() == kAuthorityCertificate ||
        file.filename() == kServerCertificate) {
      continue;
    }
    if (entry.is_regular_file()) found.push_back(file);
  }
  std::sort(found.begin(), found.end());
  return found;
}

echo::Command make_tls_show_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("show", "Tells what the certificates are for and how long");
  const auto given = tls_given_to(*command);
  return {command, [given] {
            const fs::path folder = given->folder;
            const auto tell = [](const fs::path& file) {
              echo::write_out(
                  fmt::format("{}: {}\n", file.string(), facts_text(facts_of_certificate(file))));
            };
            tell(folder / kAuthorityCertificate);
            tell(folder / kServerCertificate);
            for (const fs::path& file : client_certificates(folder)) {
              try {
                tell(file);
              } catch (const std::runtime_error& error) {
                echo::write_out(std::string(error.what()) + "\n");
              }
            }
            return echo::kExitOk;
          }};
}

}  // namespace

std::vector<echo::Command> make_tls_commands(CLI::App& app) {
  return {make_tls_init_command(app), make_tls_renew_command(app), make_tls_client_command(app),
          make_tls_show_command(app)};
}

}  // namespace skerry::server
