#include "server/audit/audit_chain.hpp"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "protocol/digest/digest.hpp"

namespace skerry::server {
namespace {

using google::protobuf::util::JsonStringToMessage;

constexpr std::string_view kChain = ",\"chain\":\"", kEnd = "\"}";
constexpr std::size_t kDigits = 64;

std::string digest_of(std::string_view before, std::string_view body) {
  Sha256 digest;
  digest.add(before);
  digest.add(body);
  return hexadecimal(digest.take());
}

}  // namespace

std::string audit_line(audit::Entry entry, AuditHead& head) {
  entry.set_n(head.n + 1);
  std::string text;
  const auto written = google::protobuf::util::MessageToJsonString(entry, &text);
  if (!written.ok()) throw std::runtime_error("audit: " + written.ToString());
  text.pop_back();  // }
  head = {entry.n(), digest_of(head.chain, text)};
  text += kChain;
  text += head.chain;
  text += kEnd;
  text += '\n';
  return text;
}

namespace {

struct Parts {
  std::string_view body, chain;
  audit::Entry entry;
};

Result<Parts, std::string> parts_of(std::string_view line) {
  const std::size_t tail = kChain.size() + kDigits + kEnd.size();
  if (line.size() <= tail || !line.ends_with(kEnd) ||
      line.substr(line.size() - tail, kChain.size()) != kChain) {
    return Failure{std::string("no entry: it does not end with its chain")};
  }
  Parts parts;
  parts.body = line.substr(0, line.size() - tail);
  parts.chain = line.substr(line.size() - kEnd.size() - kDigits, kDigits);
  google::protobuf::util::JsonParseOptions options;
  options.ignore_unknown_fields = true;  // of later versions; the chain is over them all the same
  if (!JsonStringToMessage(std::string(parts.body) + '}', &parts.entry, options).ok()) {
    return Failure{std::string("no entry: it cannot be read")};
  }
  return parts;
}

}  // namespace

std::optional<AuditHead> read_audit_head(std::string_view line) {
  const auto parts = parts_of(line);
  if (!parts || parts->entry.n() == 0) return std::nullopt;
  return AuditHead{parts->entry.n(), std::string(parts->chain)};
}

Result<audit::Entry, std::string> read_audit_line(std::string_view line, AuditHead& head) {
  auto parts = parts_of(line);
  if (!parts) return Failure{parts.error()};
  audit::Entry& entry = parts->entry;
  if (!entry.follows().empty()) {
    if (entry.n() > 1 && head == AuditHead{}) head = {entry.n() - 1, entry.follows()};
    if (entry.follows() != head.chain) {
      return Failure{
          fmt::format("entry {} goes on from another audit than it stands in", entry.n())};
    }
  }
  if (entry.n() != head.n + 1) {
    return Failure{fmt::format("entry {} follows entry {}", entry.n(), head.n)};
  }
  if (digest_of(head.chain, parts->body) != parts->chain) {
    return Failure{fmt::format("entry {} or one before it is not as it was written", entry.n())};
  }
  head = {entry.n(), std::string(parts->chain)};
  return std::move(entry);
}

AuditCheck check_audit(const std::filesystem::path& file, std::string_view wanted,
                       const std::function<void(const audit::Entry&)>& each,
                       const AuditHead& before) {
  const auto cannot = [&](const char* why) {
    return std::runtime_error(fmt::format("{} cannot be read: {}", file.string(), why));
  };
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    throw cannot("it is no file");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw cannot(std::strerror(errno));
  AuditCheck check;
  check.head = before;
  check.has_wanted = wanted == check.head.chain;
  std::string line;
  for (std::uint64_t number = 1;; ++number) {
    line.clear();
    char c = 0;
    while (line.size() < kMostAuditLine && stream.get(c) && c != '\n') line += c;
    if (stream.bad()) throw cannot(std::strerror(errno));
    if (!stream) {
      check.unfinished_bytes = line.size();
      return check;
    }
    // A line that is too long is cut here, and so has no chain at its end.
    const auto entry = read_audit_line(line, check.head);
    if (!entry) {
      check.wrong_line = number;
      check.wrong = entry.error();
      return check;
    }
    if (number == 1) {
      check.first_utc = entry->utc();
      if (!entry->follows().empty()) check.follows = {entry->n() - 1, entry->follows()};
      check.has_wanted = check.has_wanted || wanted == entry->follows();
    }
    check.last_utc = entry->utc();
    ++check.entries;
    check.has_wanted = check.has_wanted || wanted == check.head.chain;
    if (each) each(*entry);
  }
}

}  // namespace skerry::server
