#include "server/access_tool/audit_command.hpp"

#include <fmt/format.h>

#include <cctype>
#include <deque>
#include <memory>
#include <string>

#include "echo/tool_console/console.hpp"
#include "server/audit/audit_chain.hpp"
#include "server/config/config_error.hpp"

namespace skerry::server {
namespace {

namespace console = skerry::echo;

// Options of a command, kept as long as the command.
struct AuditAsked {
  std::string file, head, who, kind;
  std::size_t last = 0;  // 0: all
};

std::string wrong_of(const AuditAsked& given, const AuditCheck& check) {
  return fmt::format("{}:{}: {}", given.file, check.wrong_line, check.wrong);
}

console::Command make_verify_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("verify", "Says whether the file is as it was written, and its head");
  auto given = std::make_shared<AuditAsked>();
  command->add_option("FILE", given->file, "that skerryd --audit wrote")->required();
  command
      ->add_option("--head", given->head,
                   "a head that was noted: finds out a lost end, or a file made anew")
      ->type_name("HEAD")
      ->check([](const std::string& head) {
        const bool is_one = head.size() == 64 &&
                            head.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
        return is_one ? "" : "a head has 64 hexadecimal digits: " + head;
      })
      ->transform([](std::string head) {
        for (char& c : head) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return head;
      });
  return {command, [given] {
            const AuditCheck check = check_audit(given->file, given->head);
            if (check.wrong_line > 0) {
              return console::report(
                  wrong_of(*given, check),
                  fmt::format("{} entries before it are as they were written.", check.head.n));
            }
            if (!given->head.empty() && !check.has_wanted) {
              return console::report(
                  fmt::format("{}: its {} entries hold together, but none has the head {}",
                              given->file, check.head.n, given->head),
                  "Entries are missing at its end, or it was made anew.");
            }
            std::string out = fmt::format("{}: {} entries", given->file, check.head.n);
            if (check.head.n > 0) {
              out += fmt::format(", {} to {}, as they were written\n", check.first_utc,
                                 check.last_utc);
              out += fmt::format("head {}\n", check.head.chain);
            } else {
              out += '\n';
            }
            if (check.unfinished_bytes > 0) {
              out += fmt::format("behind them {} bytes of an entry that is not finished\n",
                                 check.unfinished_bytes);
            }
            console::write_out(out);
            return console::kExitOk;
          }};
}

// Whoever can write the file can put anything into it.
std::string shown(const std::string& text) { return printable(text, text.size()); }

std::string line_of(const audit::Entry& entry) {
  std::string line =
      fmt::format("{:>6} {} {:<8}", entry.n(), shown(entry.utc()), shown(entry.kind()));
  if (!entry.who().empty()) line += " " + shown(entry.who());
  if (!entry.from().empty()) line += fmt::format(" ({})", shown(entry.from()));
  if (!entry.what().empty()) line += " " + shown(entry.what());
  if (!entry.after().empty()) {
    line += fmt::format(": {} -> {}", shown(entry.before()), shown(entry.after()));
  }
  if (entry.times() > 1) line += fmt::format(" ({} changes)", entry.times());
  if (!entry.result().empty()) line += ": " + shown(entry.result());
  return line + "\n";
}

console::Command make_show_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("show", "Prints the entries, a line each");
  auto given = std::make_shared<AuditAsked>();
  command->add_option("FILE", given->file, "that skerryd --audit wrote")->required();
  command->add_option("--last", given->last, "only so many, the newest (all)");
  command->add_option("--who", given->who, "only of whom this is part of the name");
  command->add_option("--kind", given->kind, "only of this kind")
      ->check(CLI::IsMember({"change", "request", "sign_in", "refusal", "server"}));
  return {command, [given] {
            std::deque<std::string> lines;
            const AuditCheck check = check_audit(given->file, {}, [&](const audit::Entry& entry) {
              if (!given->kind.empty() && entry.kind() != given->kind) return;
              if (entry.who().find(given->who) == std::string::npos) return;
              lines.push_back(line_of(entry));
              if (given->last == 0) {
                console::write_out(lines.front());
                lines.clear();
              } else if (lines.size() > given->last) {
                lines.pop_front();
              }
            });
            for (const std::string& line : lines) console::write_out(line);
            if (check.wrong_line == 0) return console::kExitOk;
            return console::report(wrong_of(*given, check),
                                   "What follows is not shown; `skerry audit verify` says more.");
          }};
}

}  // namespace

std::vector<console::Command> make_audit_commands(CLI::App& app) {
  return {make_verify_command(app), make_show_command(app)};
}

}  // namespace skerry::server
