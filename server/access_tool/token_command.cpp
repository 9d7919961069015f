#include "server/access_tool/token_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include "echo/tool_console/console.hpp"
#include "protocol/picture/label_text.hpp"
#include "server/access/token_file.hpp"
#include "server/tls/certificate.hpp"

namespace skerry::server {
namespace {

namespace console = skerry::echo;

UtcTime utc_now() { return std::chrono::system_clock::now(); }

// Options of a command, kept as long as the command.
struct Given {
  std::string file = "tokens.yaml";
  std::string name;
  std::string role = "observer";
  std::string ship;
  double seconds = 0;  // 0: without end
  std::string certificate;
};

std::shared_ptr<Given> given_to(CLI::App& command) {
  auto given = std::make_shared<Given>();
  command.add_option("--tokens", given->file, "the file that skerryd --tokens reads")
      ->type_name("FILE")
      ->capture_default_str();
  return given;
}

// Of a client that shows this certificate; without another end it ends with it.
KeptToken entry_of_certificate(const std::string& file) {
  require_certificate(file);
  const CertificateFacts facts = facts_of_certificate(file);
  if (!facts.is_for_clients) {
    throw std::runtime_error(
        file + ": no client's certificate; `skerry tls client NAME` makes one, NAME.pem");
  }
  KeptToken kept;
  kept.certificate = facts.sha256;
  kept.ends = facts.until;
  return kept;
}

void tell_kept(const Given& given, const KeptToken& kept) {
  fmt::print(stderr, "Kept in {} as {}, {}{}{}.\n", given.file, given.name, given.role,
             given.ship.empty() ? "" : " of the ship " + given.ship,
             kept.ends ? ", until " + utc_text(*kept.ends) : "");
}

console::Command make_new_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("new", "Makes a token and prints it, this once");
  const auto given = given_to(*command);
  command->add_option("NAME", given->name, "of who will hold it, for logs and lists")->required();
  command->add_option("--role", given->role, "what she may do; `skerry token rights` has the table")
      ->check(CLI::IsMember(role_names()))
      ->capture_default_str();
  command->add_option("--ship", given->ship, "the own ship that it is for (all)");
  command->add_option("--for", given->seconds, "how long it holds: 90m, 8h, 30d (without end)")
      ->transform(
          CLI::AsNumberWithUnit(std::map<std::string, double>{{"m", 60}, {"h", 3600}, {"d", 86400}},
                                CLI::AsNumberWithUnit::UNIT_REQUIRED))
      ->check(CLI::Range(60.0, 3660.0 * 86400.0))
      ->type_name("TIME");
  command
      ->add_option("--certificate", given->certificate,
                   "makes none: who comes with this client's certificate, as `skerry tls client` "
                   "makes it, needs none; --for is at most as long as it holds")
      ->type_name("FILE");
  return {command, [given] {
            const bool is_certificate = !given->certificate.empty();
            const std::string token = is_certificate ? "" : make_token();
            KeptToken kept;
            if (is_certificate) {
              kept = entry_of_certificate(given->certificate);
            } else {
              kept.sha256 = digest_of(token);
            }
            kept.name = given->name;
            kept.role = role_named(given->role);
            kept.ship = given->ship;
            if (given->seconds > 0) {
              const UtcTime ends = utc_now() + seconds_as_duration(given->seconds);
              kept.ends = std::min(ends, kept.ends.value_or(ends));
            }
            change_tokens(given->file, [&](TokenFile& file) { file.add(kept); });
            if (!is_certificate) console::write_out(token + "\n");
            tell_kept(*given, kept);
            fmt::print(
                stderr, "{}",
                is_certificate
                    ? "It is known by its certificate; a server heeds it within a second.\n"
                    : "It is not shown again.  It goes into SKERRY_TOKEN, into the field Token "
                      "of a console,\nor into a header Authorization: Bearer.\n");
            return console::kExitOk;
          }};
}

console::Command make_list_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("list", "Lists the tokens of the file");
  const auto given = given_to(*command);
  return {command, [given] {
            const TokenFile file = TokenFile::read(given->file);
            std::string out = fmt::format("{:<24} {:<11} {:<20} {:<11} {}\n", "name", "role",
                                          "ship", "by", "ends");
            for (const KeptToken& token : file.tokens()) {
              const bool ended = token.ends && utc_now() >= *token.ends;
              out += fmt::format("{:<24} {:<11} {:<20} {:<11} {}{}\n", token.name,
                                 name_of(token.role), token.ship.empty() ? "all" : token.ship,
                                 token.is_certificate() ? "certificate" : "token",
                                 token.ends ? utc_text(*token.ends) : "never",
                                 ended ? " (has ended)" : "");
            }
            console::write_out(out);
            return console::kExitOk;
          }};
}

console::Command make_revoke_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("revoke", "Takes a token out of the file; a server heeds it in a second");
  const auto given = given_to(*command);
  command->add_option("NAME", given->name, "as `list` has it")->required();
  return {command, [given] {
            bool was_there = false;
            TokenFile::read(given->file);  // there is one
            change_tokens(given->file,
                          [&](TokenFile& file) { was_there = file.remove(given->name); });
            if (was_there) return console::kExitOk;
            return console::report(fmt::format("{} has no token '{}'", given->file, given->name),
                                   "`skerry token list` has their names.");
          }};
}

console::Command make_rights_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("rights", "Prints who may do what, as a page (RIGHTS.md)");
  return {command, [] {
            console::write_out(rights_page());
            return console::kExitOk;
          }};
}

}  // namespace

std::vector<console::Command> make_token_commands(CLI::App& app) {
  return {make_new_command(app), make_list_command(app), make_revoke_command(app),
          make_rights_command(app)};
}

}  // namespace skerry::server
