// Answers to HTTP requests, decided and made without a socket.
#pragma once

#include <google/protobuf/message.h>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/net/common/asio.hpp"
#include "server/net/common/net_config.hpp"

namespace skerry::server {

// What a browser may do with an answer (Content-Security-Policy).
enum class ContentPolicy : std::uint8_t {
  data,      // it is no page: nothing at all
  own_page,  // load what is this server's, and run no code but that of its files
  guest,     // of another maker's application in the web root: only be in no other site's frame
};

struct WebAnswer {
  unsigned status = 200;
  std::string mime = "text/plain; charset=utf-8";
  std::string body = {};
  std::string_view vary = {};  // the request header that decided about the answer; a literal
  std::string location = {};   // of a redirection
  std::string set_cookie = {};
  ContentPolicy policy = ContentPolicy::data;
  // Of an own page: origins of other servers that it may connect to as well.
  std::vector<std::string> sisters = {};
  std::string_view allow = "GET, HEAD";  // of 405: the methods that there are; a literal
};

// The response to be sent; `with_body` is false for HEAD.
http::response<http::string_body> response_of(const WebAnswer& answer, bool with_body,
                                              bool keep_alive);

// An error with its text as the body.
WebAnswer web_error(unsigned status, std::string text);

// A message as JSON, with all its fields and their names as the schema has them.
WebAnswer json_answer(const google::protobuf::Message& message);

// The whole response to a connection whose request is not even read, for want of a place: 503.
std::string http_refusal(const std::string& reason);

// The path of a request target: without query, percent-decoded.  Empty if it is no clean absolute
// path: bad escapes, control characters, backslashes, empty or dot segments.
std::string clean_path(std::string_view target);

// The members of a request target's query, percent-decoded, + as a space.  Nothing if it has bad
// escapes, or a member twice.
std::optional<std::map<std::string, std::string>> query_of(std::string_view target);

// The web console, from memory or from a directory.
class WebFiles {
 public:
  static constexpr std::size_t kMaxFile = 16 * 1024 * 1024;

  // `built_in` must outlive it.  With a non-empty `root` only files in that directory are served,
  // links out of it not followed.
  // Error: std::runtime_error if `root` is no directory.
  WebFiles(std::span<const WebFile> built_in, const std::string& root);

  // `target` as in the request line.  "/" is "/index.html", "/name" is "/name.html" if there is no
  // file of that name; "/name/" leads to "/name", on which a page's relative links rest.  Reads the
  // disk if there is a root: meant for working on the console.  Files of the console are own
  // pages, what else is in the root is a guest's.
  WebAnswer get(std::string_view target) const;

 private:
  WebAnswer get_file(const std::string& path) const;
  const WebFile* find_built_in(const std::string& path) const;
  WebAnswer get_from_root(const std::string& path) const;

  std::span<const WebFile> built_in_;
  std::string root_;  // canonical; empty: none
};

}  // namespace skerry::server
