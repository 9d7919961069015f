#include "server/net/http/login_body.hpp"

#include "protocol/signalk/json.hpp"

namespace skerry::server {

std::optional<LoginBody> read_login_body(std::string_view text, bool is_signalk) {
  const auto json = signalk::read_json(text);
  if (!json) return std::nullopt;
  LoginBody body;
  Credentials& shown = body.credentials;
  shown.name = signalk::text_member(*json, is_signalk ? "username" : "name");
  shown.password = signalk::text_member(*json, "password");
  if (is_signalk) return shown.password.empty() ? std::nullopt : std::optional(body);
  shown.class_code = signalk::text_member(*json, "code");
  const signalk::Json* cookie = signalk::member(*json, "cookie");
  body.cookie = cookie != nullptr && cookie->is_boolean() && cookie->get<bool>();
  // Either, not both: who gives both does not know what she does.
  if (shown.password.empty() == shown.class_code.empty()) return std::nullopt;
  return body;
}

}  // namespace skerry::server
