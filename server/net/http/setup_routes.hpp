// Set-ups of consoles by HTTP: /setups lists them, /setups/NAME is one.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "server/net/common/net_context.hpp"
#include "server/net/http/web_answer.hpp"

namespace skerry::server {

// Whether the path (clean_path) is one of theirs.
bool is_setup_path(std::string_view path);

struct SetupRequest {
  std::string method;  // GET, HEAD, PUT or DELETE; others are answered 405
  std::string path;    // is_setup_path()
  std::string body;    // of PUT: the set-up
  Who who;
};

// GET of the list or a set-up; PUT and DELETE of a set-up, whose answer is the list as it is then.
// `answer` is called once: at once, or when the disk has the change.  Thread: net-0.
void answer_setups(NetContext& context, const TcpPeer& peer, SetupRequest request,
                   std::function<void(WebAnswer)> answer);

}  // namespace skerry::server
