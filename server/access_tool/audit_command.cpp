#include "server/access_tool/audit_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "echo/tool_console/console.hpp"
#include "protocol/recording/audit_text.hpp"
#include "server/access_tool/audit_entries.hpp"
#include "server/config/config_error.hpp"
#include "server/core/audit_port.hpp"

namespace skerry::server {
namespace {

namespace console = skerry::echo;

// Options of a command, kept as long as the command.
struct AuditAsked {
  std::vector<std::string> files;
  std::string head, who, kind;
  std::size_t last = 0;  // 0: all
};

std::string wrong_of(const std::string& file, const AuditCheck& check) {
  return fmt::format("{}:{}: {}", file, check.wrong_line, check.wrong);
}

std::string good_text(const std::string& file, const AuditCheck& check) {
  std::string out = fmt::format("{}: {} entries", file, check.entries);
  if (check.entries > 0) {
    out += fmt::format(", {} to {}, as they were written\n", check.first_utc, check.last_utc);
    if (check.follows.n > 0) {
      out += fmt::format("goes on from entry {}, head {}\n", check.follows.n, check.follows.chain);
    }
    out += fmt::format("head {}\n", check.head.chain);
  } else {
    out += '\n';
  }
  if (check.unfinished_bytes > 0) {
    out += fmt::format("behind them {} bytes of an entry that is not finished\n",
                       check.unfinished_bytes);
  }
  return out;
}

// Of the files, oldest first; `each` is given their entries.  Exit code.
int verify_chain(const std::vector<std::string>& files, const std::string& wanted,
                 const std::function<void(const audit::Entry&)>& each) {
  AuditHead end, begin;
  bool has_head = false;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const AuditCheck check = check_audit(files[i], wanted, each, end);
    if (check.wrong_line > 0) {
      const std::string hint =
          i > 0 && check.wrong_line == 1
              ? fmt::format(
                    "It does not go on from {}, which ends with entry {}; give the files "
                    "in their order, the oldest first, and all of them.",
                    files[i - 1], end.n)
              : fmt::format("{} entries before it are as they were written.", check.entries);
      return console::report(wrong_of(files[i], check), hint);
    }
    has_head = has_head || check.has_wanted;
    end = check.head;
    if (i == 0) begin = check.follows;
    console::write_out(good_text(files[i], check));
  }
  if (wanted.empty() || has_head) return console::kExitOk;
  return console::report(
      fmt::format("{}: all entries hold together, but none has the head {}", files.back(), wanted),
      begin.n > 0 ? fmt::format("It may be in a file before {}, which goes on from entry {}; or "
                                "entries are missing at the end.",
                                files.front(), begin.n)
                  : "Entries are missing at the end, or it was made anew.");
}

int verify_files(const AuditAsked& given) {
  std::vector<std::string> files;
  std::vector<RecordedEntries> recordings;
  for (const std::string& file : given.files) {
    if (is_recording(file)) {
      recordings.emplace_back(file);
    } else {
      files.push_back(file);
    }
  }
  if (files.empty()) {
    return console::report(
        recordings.front().file() + " is a recording, which has entries without their chain",
        "Give the files of skerryd --audit too; `skerry audit show` reads it alone.");
  }
  const int chain = verify_chain(files, given.head, [&](const audit::Entry& entry) {
    for (RecordedEntries& recorded : recordings) recorded.compare(entry);
  });
  if (chain != console::kExitOk) return chain;
  for (const RecordedEntries& recorded : recordings) {
    if (const auto fault = recorded.fault()) {
      return console::report(*fault,
                             "The audit was made anew, or is another server's, or files of it are "
                             "not given.");
    }
    console::write_out(
        fmt::format("{}: {} entries, as the files have them\n", recorded.file(), recorded.count()));
  }
  return console::kExitOk;
}

console::Command make_verify_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("verify", "Says whether files are as they were written, and their heads");
  auto given = std::make_shared<AuditAsked>();
  command
      ->add_option("FILE", given->files,
                   "that skerryd --audit wrote; several: one audit, the oldest file first; beside "
                   "them recordings, whose entries must be the same")
      ->required();
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
  return {command, [given] { return verify_files(*given); }};
}

// Whoever can write the file can put anything into it.
std::string shown(const std::string& text) { return printable(text, text.size()); }

std::string line_of(const audit::Entry& entry) {
  std::string line =
      fmt::format("{:>6} {} {:<8}", entry.n(), shown(entry.utc()), shown(entry.kind()));
  if (!entry.who().empty()) line += " " + shown(entry.who());
  if (!entry.from().empty()) line += fmt::format(" ({})", shown(entry.from()));
  line += " " + shown(recording::audit_text(entry));
  return line + "\n";
}

int show_entries(const AuditAsked& given) {
  std::deque<std::string> lines;
  const auto show = [&](const audit::Entry& entry) {
    if (!given.kind.empty() && entry.kind() != given.kind) return;
    if (entry.who().find(given.who) == std::string::npos) return;
    lines.push_back(line_of(entry));
    if (given.last == 0) {
      console::write_out(lines.front());
      lines.clear();
    } else if (lines.size() > given.last) {
      lines.pop_front();
    }
  };
  std::vector<std::string> wrong;
  for (const std::string& file : given.files) {
    if (auto fault = read_entries(file, show)) wrong.push_back(*std::move(fault));
  }
  for (const std::string& line : lines) console::write_out(line);
  for (const std::string& text : wrong) console::report(text, {});
  return wrong.empty() ? console::kExitOk : console::kExitFailure;
}

console::Command make_show_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("show", "Prints the entries, a line each");
  auto given = std::make_shared<AuditAsked>();
  command
      ->add_option("FILE", given->files,
                   "that skerryd --audit wrote, or a recording; several: one after the other")
      ->required();
  command->add_option("--last", given->last, "only so many, the newest (all)");
  command->add_option("--who", given->who, "only of whom this is part of the name");
  command->add_option("--kind", given->kind, "only of this kind")
      ->check(CLI::IsMember(std::vector<std::string>(kAuditKinds.begin(), kAuditKinds.end())));
  return {command, [given] { return show_entries(*given); }};
}

}  // namespace

std::vector<console::Command> make_audit_commands(CLI::App& app) {
  return {make_verify_command(app), make_show_command(app)};
}

}  // namespace skerry::server
