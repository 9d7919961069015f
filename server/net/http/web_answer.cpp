#include "server/net/http/web_answer.hpp"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kMimeTypes = {{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".proto", "text/plain; charset=utf-8"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".wasm", "application/wasm"},
}};

std::string mime_of(const fs::path& file) {
  const std::string extension = file.extension().string();
  for (const auto& [known, mime] : kMimeTypes) {
    if (known == extension) return std::string(mime);
  }
  return "application/octet-stream";
}

bool clean(std::string_view path) {
  if (!path.starts_with('/')) return false;
  if (std::any_of(path.begin(), path.end(),
                  [](unsigned char c) { return c < 0x20 || c == 0x7f || c == '\\'; })) {
    return false;
  }
  for (std::size_t begin = 1; begin < path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view segment = path.substr(begin, end - begin);
    if (segment.empty() || segment == "." || segment == "..") return false;
    begin = end + 1;
  }
  return true;
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    unsigned value = 0;
    const char* begin = text.data() + i + 1;
    if (text.size() - i < 3) return std::nullopt;
    const auto [end, error] = std::from_chars(begin, begin + 2, value, 16);
    if (error != std::errc() || end != begin + 2) return std::nullopt;
    decoded += static_cast<char>(value);
    i += 2;
  }
  return decoded;
}

// What an answer is stays as it is said, and addresses of pages are told to nobody.
// Source: Referrer Policy (W3C).
constexpr std::array<std::pair<const char*, const char*>, 2> kForBrowsers = {
    {{"X-Content-Type-Options", "nosniff"}, {"Referrer-Policy", "no-referrer"}}};

// A page of the console has no code or style in its text, and nothing of it is from elsewhere.  The
// instructor's page has the console in a frame.
// Source: Content Security Policy Level 3 (W3C).
// "; connect-src 'self' http://192.0.2.7:7480 ws://192.0.2.7:7480".
std::string connections_to(const std::vector<std::string>& sisters) {
  if (sisters.empty()) return {};
  std::string text = "; connect-src 'self'";
  for (const std::string& origin : sisters) {
    text += " " + origin + " ws" + origin.substr(std::string_view("http").size());
  }
  return text;
}

std::string policy_text(ContentPolicy policy, const std::vector<std::string>& sisters) {
  switch (policy) {
    case ContentPolicy::data:
      return "default-src 'none'; frame-ancestors 'none'";
    case ContentPolicy::own_page:
      return "default-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'self'; "
             "object-src 'none'" +
             connections_to(sisters);
    case ContentPolicy::guest:
      return "frame-ancestors 'self'";
  }
  return "";
}

}  // namespace

http::response<http::string_body> response_of(const WebAnswer& answer, bool with_body,
                                              bool keep_alive) {
  http::response<http::string_body> response;
  response.version(11);
  response.result(answer.status);
  response.set(http::field::server, "skerryd");
  response.set(http::field::content_type, answer.mime);
  response.set(http::field::cache_control, "no-cache");
  for (const auto& [name, value] : kForBrowsers) response.set(name, value);
  response.set("Content-Security-Policy", policy_text(answer.policy, answer.sisters));
  if (!answer.vary.empty()) {
    response.set(http::field::vary, beast::string_view(answer.vary.data(), answer.vary.size()));
  }
  if (!answer.location.empty()) response.set(http::field::location, answer.location);
  if (!answer.set_cookie.empty()) response.set(http::field::set_cookie, answer.set_cookie);
  if (answer.status == 405) {
    response.set(http::field::allow, beast::string_view(answer.allow.data(), answer.allow.size()));
  }
  if (answer.status == 401) response.set(http::field::www_authenticate, "Bearer");
  if (answer.status == 426) response.set(http::field::upgrade, "websocket");
  response.keep_alive(keep_alive);
  response.content_length(answer.body.size());
  if (with_body) response.body() = answer.body;
  return response;
}

WebAnswer web_error(unsigned status, std::string text) {
  text += '\n';
  return {.status = status, .body = std::move(text)};
}

WebAnswer json_answer(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  WebAnswer json{.mime = "application/json"};
  const auto written = google::protobuf::util::MessageToJsonString(message, &json.body, options);
  if (!written.ok()) return web_error(500, "500: " + written.ToString());
  return json;
}

std::string http_refusal(const std::string& reason) {
  const std::string body = "503: " + reason + "\n";
  return fmt::format(
      "HTTP/1.1 503 Service Unavailable\r\nServer: skerryd\r\nConnection: close\r\n"
      "Cache-Control: no-cache\r\nContent-Type: text/plain; charset=utf-8\r\n"
      "Content-Length: {}\r\n\r\n{}",
      body.size(), body);
}

std::string clean_path(std::string_view target) {
  const auto path = percent_decoded(target.substr(0, target.find_first_of("?#")));
  return path && clean(*path) ? *path : std::string();
}

std::optional<std::map<std::string, std::string>> query_of(std::string_view target) {
  std::map<std::string, std::string> members;
  target = target.substr(0, target.find('#'));
  const std::size_t begin = std::min(target.find('?'), target.size());
  for (std::string_view rest = target.substr(std::min(begin + 1, target.size())); !rest.empty();) {
    const std::string_view member = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(member.size() + 1, rest.size()));
    const std::size_t equals = std::min(member.find('='), member.size());
    std::string value(member.substr(std::min(equals + 1, member.size())));
    std::replace(value.begin(), value.end(), '+', ' ');
    const auto name = percent_decoded(member.substr(0, equals)), decoded = percent_decoded(value);
    if (!name || !decoded || !members.emplace(*name, *decoded).second) return std::nullopt;
  }
  return members;
}

WebFiles::WebFiles(std::span<const WebFile> built_in, const std::string& root)
    : built_in_(built_in) {
  if (root.empty()) return;
  std::error_code error;
  const fs::path canonical = fs::canonical(root, error);
  if (error || !fs::is_directory(canonical, error)) {
    throw std::runtime_error(
        fmt::format("web root '{}' is no directory that can be read; give one that holds "
                    "index.html with --web-root, or leave it out to use the built-in console",
                    root));
  }
  root_ = canonical.string();
}

WebAnswer WebFiles::get(std::string_view target) const {
  std::string path = clean_path(target);
  if (path.empty()) return web_error(400, "400: the path of this request cannot be read");
  const bool is_folder = path.ends_with('/');
  WebAnswer answer = get_file(is_folder ? path + "index.html" : path);
  if (answer.status != 404 || path == "/") return answer;
  if (is_folder) path.pop_back();
  const std::string name = path.substr(path.rfind('/') + 1);
  WebAnswer page = get_file(path + ".html");
  if (page.status != 200) return answer;
  if (!is_folder) return page;
  const std::size_t query = std::min(target.find('?'), target.size());
  answer = web_error(302, "302: without the slash");
  answer.location = "../" + name + std::string(target.substr(query, target.find('#') - query));
  return answer;
}

const WebFile* WebFiles::find_built_in(const std::string& path) const {
  const auto file = std::find_if(built_in_.begin(), built_in_.end(),
                                 [&path](const WebFile& known) { return known.path == path; });
  return file == built_in_.end() ? nullptr : &*file;
}

WebAnswer WebFiles::get_file(const std::string& path) const {
  const WebFile* file = find_built_in(path);
  if (!root_.empty()) {
    WebAnswer answer = get_from_root(path);
    answer.policy = file != nullptr ? ContentPolicy::own_page : ContentPolicy::guest;
    return answer;
  }
  if (file == nullptr) return web_error(404, "404: no such file; the console is at /");
  return {.mime = std::string(file->mime),
          .body = std::string(file->body),
          .policy = ContentPolicy::own_page};
}

WebAnswer WebFiles::get_from_root(const std::string& path) const {
  const WebAnswer not_found = web_error(404, "404: no such file; the console is at /");
  std::error_code error;
  const fs::path file = fs::canonical(fs::path(root_ + path), error);
  if (error || !file.string().starts_with(root_ + "/")) return not_found;
  if (!fs::is_regular_file(file, error) || error) return not_found;
  const auto size = fs::file_size(file, error);
  if (error || size > kMaxFile) return not_found;
  std::string body(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(body.data(), static_cast<std::streamsize>(size))) return not_found;
  return {.mime = mime_of(file), .body = std::move(body)};
}

}  // namespace skerry::server
