// Signal K's REST by HTTP: what is asked of it, by whom, and what the audit has of it.
#pragma once

#include <string>

#include "server/net/common/net_context.hpp"
#include "server/net/http/http_request.hpp"
#include "server/net/http/web_answer.hpp"
#include "server/net/signalk/signalk_site.hpp"

namespace skerry::server {

struct SignalkAsked {
  const TcpPeer& peer;
  std::string token;    // that it showed; empty: none
  std::string address;  // of this host, that it came to; empty: not known
};

// `path`: is_signalk_path().  Thread: net-0.
WebAnswer answer_signalk(NetContext& context, SignalkSite& site, const HttpRequest& request,
                         std::string path, const SignalkAsked& by);

}  // namespace skerry::server
