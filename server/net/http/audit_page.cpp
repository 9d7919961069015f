#include "server/net/http/audit_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace skerry::server {
namespace {

constexpr std::size_t kMostWhoBytes = 200;

std::optional<std::uint32_t> whole_number(const std::string& text, std::uint32_t most) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > most) return std::nullopt;
  return value;
}

std::optional<AuditQuestion> question_of(std::string_view target) {
  const auto query = query_of(target);
  if (!query) return std::nullopt;
  AuditQuestion question;
  for (const auto& [name, value] : *query) {
    if (name == "last") {
      const auto most = whole_number(value, kMostShown);
      if (!most) return std::nullopt;
      question.most = *most;
    } else if (name == "after") {
      const auto after = whole_number(value, UINT32_MAX);
      if (!after) return std::nullopt;
      question.after = *after;
    } else if (name == "who") {
      if (value.size() > kMostWhoBytes) return std::nullopt;
      question.who = value;
    } else if (name == "kind") {
      const auto known = std::find(kAuditKinds.begin(), kAuditKinds.end(), value);
      if (!value.empty() && known == kAuditKinds.end()) return std::nullopt;
      question.kind = value;
    } else {
      return std::nullopt;
    }
  }
  return question;
}

}  // namespace

WebAnswer audit_page(const AuditPort* audit, std::string_view target) {
  const auto question = question_of(target);
  if (!question) {
    return web_error(400, fmt::format("400: expected of the query: last=0..{}, after=NUMBER, "
                                      "who=PART of at most {} bytes, kind=one of {}",
                                      kMostShown, kMostWhoBytes, fmt::join(kAuditKinds, ", ")));
  }
  const AuditAnswer told = audit == nullptr ? AuditAnswer{} : audit->ask(*question);
  WebAnswer page{.mime = "application/json", .body = "{\"entries\":["};
  for (const AuditEntryPtr& entry : told.entries) {
    std::string text;
    if (!google::protobuf::util::MessageToJsonString(*entry, &text).ok()) continue;
    if (page.body.back() == '}') page.body += ",\n";
    page.body += text;
  }
  page.body += fmt::format("],\"newest\":{},\"has_file\":{},\"unwritten\":{}}}\n", told.newest,
                           told.has_file, told.unwritten);
  return page;
}

}  // namespace skerry::server
