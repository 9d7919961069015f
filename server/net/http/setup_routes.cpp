#include "server/net/http/setup_routes.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace skerry::server {
namespace {

constexpr std::string_view kList = "/setups", kOne = "/setups/";

WebAnswer json_text(std::string text) {
  return {.mime = "application/json", .body = std::move(text)};
}

WebAnswer setup_error(unsigned status, std::string_view text) {
  return web_error(status, fmt::format("{}: {}", status, text));
}

std::string list_of(const SetupShelf* shelf) {
  return fmt::format(R"({{"keeps":{},"setups":{}}})", shelf != nullptr,
                     shelf != nullptr ? shelf->list() : "[]");
}

WebAnswer read_setups(const SetupShelf& shelf, const std::string& path) {
  if (path == kList) return json_text(list_of(&shelf));
  const std::string* document = shelf.find(path.substr(kOne.size()));
  if (document == nullptr) return setup_error(404, "there is no set-up of this name");
  return json_text(*document);
}

}  // namespace

bool is_setup_path(std::string_view path) { return path == kList || path.starts_with(kOne); }

void answer_setups(NetContext& context, const TcpPeer& peer, SetupRequest request,
                   std::function<void(WebAnswer)> answer) {
  const bool is_list = request.path == kList;
  const bool reads = request.method == "GET" || request.method == "HEAD";
  if (!reads && (is_list || (request.method != "PUT" && request.method != "DELETE"))) {
    WebAnswer refused =
        setup_error(405, is_list ? "only GET and HEAD are served here"
                                 : "only GET, HEAD, PUT and DELETE are served here");
    if (!is_list) refused.allow = "GET, HEAD, PUT, DELETE";
    return answer(std::move(refused));
  }
  const std::string right = fmt::format("{} {}", reads ? "GET" : request.method, kList);
  if (const auto refused = why_not(request.who, right)) {
    context.refuse("HTTP " + peer.text, text_of(request.who), *refused);
    return answer(setup_error(request.who.role ? 403 : 401, *refused));
  }
  if (!context.setups) {
    if (is_list && reads) return answer(json_text(list_of(nullptr)));
    return answer(setup_error(404, "this server keeps no set-ups; with --setups FOLDER it does"));
  }
  SetupShelf& shelf = *context.setups;
  if (reads) return answer(read_setups(shelf, request.path));
  if (!context.changes.take(peer, std::chrono::steady_clock::now())) {
    const std::string refusal = context.changes.refusal(peer);
    context.complain("too many changes", peer.text + ": " + refusal);
    return answer(setup_error(429, refusal));
  }
  AuditEntry entry{.kind = AuditEntry::Kind::request,
                   .from = "HTTP " + peer.text,
                   .who = text_of(request.who),
                   .what = request.method + " " + request.path};
  auto done = [&context, &shelf, from = peer.text, entry = std::move(entry),
               answer = std::move(answer)](SetupShelf::Outcome outcome) mutable {
    entry.result = outcome.status == 204 ? "ok" : outcome.text;
    context.audit(std::move(entry));
    if (outcome.status == 204) return answer(json_text(list_of(&shelf)));
    context.complain("set-up refused", from + ": " + outcome.text);
    answer(setup_error(outcome.status, outcome.text));
  };
  std::string name = request.path.substr(kOne.size());
  if (request.method == "DELETE") return shelf.remove(name, std::move(done));
  shelf.keep(std::move(name), std::move(request.body), std::move(done));
}

}  // namespace skerry::server
