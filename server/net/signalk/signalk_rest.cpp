#include "server/net/signalk/signalk_rest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "server/net/common/net_clock.hpp"

namespace skerry::server {
namespace {

using signalk::Json;
using Parts = std::vector<std::string_view>;

// The path of the list of radars; older displays look elsewhere.
struct Root {
  std::string_view path;
  bool keyed;  // answered as Dialect::keyed
};
constexpr std::array<Root, 4> kRoots = {{{signalk::kRadarsPath, false},
                                         {"/signalk/v2/api/radars", false},
                                         {"/signalk/v1/api/vessels/self/radars", true},
                                         {"/v1/api/radars", true}}};

// What may be asked before a token is given.
constexpr std::array<std::string_view, 6> kDiscovery = {"/signalk",
                                                        "/signalk/v2/features",
                                                        "/signalk/v1/auth/login",
                                                        "/signalk/v1/auth/logout",
                                                        "/skServer/loginStatus",
                                                        "/loginstatus"};

WebAnswer document(const Json& json, unsigned status = 200) {
  return {.status = status, .mime = "application/json", .body = signalk::text_of(json)};
}

WebAnswer outcome_answer(const SignalkOutcome& outcome) {
  Json reply = signalk::reply_document(outcome.status, outcome.message);
  if (outcome.target) reply["targetId"] = *outcome.target;
  return document(reply, outcome.status);
}

WebAnswer failure(unsigned status, std::string message) {
  return outcome_answer({.status = status, .message = std::move(message)});
}

bool is_at(std::string_view path, std::string_view root) {
  return path.starts_with(root) && (path.size() == root.size() || path[root.size()] == '/');
}

Parts parts_of(std::string_view path) {
  Parts parts;
  while (!path.empty()) {
    path.remove_prefix(1);
    const auto end = std::min(path.find('/'), path.size());
    if (end > 0) parts.push_back(path.substr(0, end));
    path.remove_prefix(end);
  }
  return parts;
}

const Root* root_of(std::string_view path) {
  const auto found = std::find_if(kRoots.begin(), kRoots.end(),
                                  [path](const Root& root) { return is_at(path, root.path); });
  return found == kRoots.end() ? nullptr : found;
}

// One request about radars; `parts` are those of the path behind the list's.
class RadarRequest {
 public:
  RadarRequest(SignalkSite& site, const SignalkRequest& request, Parts parts)
      : site_(site), request_(request), parts_(std::move(parts)) {}

  WebAnswer list(signalk::Dialect dialect) {
    std::vector<signalk::ListedRadar> radars;
    for (SignalkSite::Mounted& each : site_.radars()) {
      radars.push_back({described(each), site_.states(each)});
    }
    return document(signalk::radar_list_document(radars, dialect, request_.place));
  }

  WebAnswer answer() {
    if (parts_.front() == "interfaces" && parts_.size() == 1) {
      return document(signalk::interfaces_document(request_.address));
    }
    radar_ = site_.find(parts_.front());
    if (radar_ == nullptr) return failure(404, "no radar of that id");
    return reads() ? read() : change();
  }

 private:
  bool reads() const { return request_.method == "GET" || request_.method == "HEAD"; }
  std::string_view part(std::size_t i) const {
    return i < parts_.size() ? parts_[i] : std::string_view();
  }
  signalk::Radar described(const SignalkSite::Mounted& mounted) const {
    signalk::Radar radar = mounted.radar;
    radar.address = request_.address;
    return radar;
  }

  WebAnswer read() {
    const std::string_view what = part(1);
    if (parts_.size() == 1) return document(signalk::radar_document(described(*radar_)));
    if (parts_.size() == 2 && what == "capabilities") {
      return document(signalk::capabilities_document(described(*radar_)));
    }
    if (parts_.size() == 2 && what == "state") {
      return document(
          signalk::radar_state_document(described(*radar_), site_.states(*radar_), utc_now()));
    }
    if (what == "controls" && parts_.size() <= 3) return read_controls();
    if (parts_.size() == 2 && what == "targets") return document(Json(site_.targets(*radar_)));
    if (parts_.size() == 2 && (what == "spokes" || what == "stream")) {
      return failure(426, "this is a WebSocket");
    }
    return failure(404, "a radar has nothing of that name");
  }

  WebAnswer read_controls() {
    const Json all = signalk::controls_document(site_.states(*radar_));
    if (parts_.size() == 2) return document(all);
    const Json* one = signalk::member(all, std::string(part(2)).c_str());
    return one != nullptr ? document(*one) : failure(404, "no control of that name");
  }

  WebAnswer change() {
    const std::string_view what = part(1);
    const bool puts = request_.method == "PUT", posts = request_.method == "POST";
    if (request_.method == "DELETE" && what == "targets" && parts_.size() == 3) {
      return outcome_answer(site_.drop(*radar_, part(2), request_.origin));
    }
    if (!puts && !posts) return failure(501, "not something that can be done here");
    const auto body = signalk::read_json(request_.body);
    if (!body) return failure(400, "the body is not JSON");
    if (puts && what == "controls" && parts_.size() == 3) {
      return outcome_answer(site_.set_control(*radar_, part(2), *body, request_.origin));
    }
    if (puts && (parts_.size() == 1 || (what == "controls" && parts_.size() == 2))) {
      const Json* value = signalk::member(*body, "value");
      return outcome_answer(
          site_.set_controls(*radar_, value != nullptr ? *value : *body, request_.origin));
    }
    // Signal K server 2.23 has power, range, gain, sea and rain beside `controls`.
    if (puts && parts_.size() == 2 && signalk::find_control(what) != nullptr) {
      return outcome_answer(site_.set_control(*radar_, what, *body, request_.origin));
    }
    if (posts && what == "targets" &&
        (parts_.size() == 2 || (parts_.size() == 3 && part(2) == "acquire"))) {
      return outcome_answer(site_.acquire(*radar_, *body, request_.origin));
    }
    return failure(501, "not something that can be done here");
  }

  SignalkSite& site_;
  const SignalkRequest& request_;
  Parts parts_;
  SignalkSite::Mounted* radar_ = nullptr;
};

// The ships as a tree, or a branch of it.
WebAnswer full_model(SignalkSite& site, const Parts& parts) {
  Json tree{{"version", "1.7.0"},
            {"self", signalk::kSelf},
            {"vessels", Json{{"self", signalk::own_ship_document(site.own_ship(), utc_now())}}}};
  for (const signalk::OtherVessel& vessel : site.vessels()) {
    tree["vessels"][vessel.key] = signalk::other_vessel_document(vessel, utc_now());
  }
  const Json* at = &tree;
  for (const std::string_view name : parts) {
    at = signalk::member(*at, std::string(name).c_str());
    if (at == nullptr) return failure(404, "nothing is known of that path");
  }
  return document(*at);
}

}  // namespace

bool is_signalk_path(std::string_view path) {
  return is_at(path, "/signalk") || is_at(path, "/skServer") || path == "/loginstatus" ||
         is_at(path, "/v1/api/radars");
}

std::string_view signalk_right(std::string_view method, std::string_view path) {
  if (path.size() > 1 && path.ends_with('/')) path.remove_suffix(1);
  if (std::find(kDiscovery.begin(), kDiscovery.end(), path) != kDiscovery.end()) {
    return "signalk.discover";
  }
  return method == "GET" || method == "HEAD" ? "signalk.read" : "signalk.change";
}

WebAnswer signalk_answer(SignalkSite& site, const SignalkConfig& config, const Gate& gate,
                         const SignalkRequest& request) {
  if (request.refusal) return failure(request.is_known ? 403 : 401, *request.refusal);
  std::string_view path = request.path;
  if (path.size() > 1 && path.ends_with('/')) path.remove_suffix(1);
  if (const Root* root = root_of(path)) {
    RadarRequest radars(site, request, parts_of(path.substr(root->path.size())));
    if (path.size() > root->path.size()) return radars.answer();
    if (request.method != "GET" && request.method != "HEAD") {
      return failure(501, "the list of radars can only be read");
    }
    return radars.list(root->keyed ? signalk::Dialect::keyed : config.dialect);
  }
  if (request.method != "GET" && request.method != "HEAD") {
    return failure(501, "only radars can be changed here");
  }
  if (path == "/signalk") {
    return document(signalk::endpoints_document(site.server(), request.place));
  }
  if (path == signalk::kStreamPath) return failure(426, "this is a WebSocket");
  if (path == "/signalk/v2/features") return document(signalk::features_document());
  if (path == "/skServer/loginStatus" || path == "/loginstatus") {
    return document(signalk::login_status_document(request.has_token, gate.knows_tokens()));
  }
  constexpr std::string_view kModel = "/signalk/v1/api";
  if (is_at(path, kModel)) return full_model(site, parts_of(path.substr(kModel.size())));
  return failure(404, "nothing of that name is served");
}

std::optional<SignalkStream> signalk_stream(SignalkSite& site, std::string_view path) {
  if (path.size() > 1 && path.ends_with('/')) path.remove_suffix(1);
  if (path == signalk::kStreamPath) return SignalkStream{};
  const Root* root = root_of(path);
  if (root == nullptr) return std::nullopt;
  const Parts parts = parts_of(path.substr(root->path.size()));
  if (parts.size() == 1 && parts[0] == "stream") return SignalkStream{};
  if (parts.size() != 2 || (parts[1] != "spokes" && parts[1] != "stream")) return std::nullopt;
  SignalkSite::Mounted* radar = site.find(parts[0]);
  return radar != nullptr ? std::optional(SignalkStream{radar}) : std::nullopt;
}

std::string_view token_of(std::string_view authorization) {
  for (const std::string_view scheme : {"Bearer ", "JWT "}) {
    if (authorization.starts_with(scheme)) return authorization.substr(scheme.size());
  }
  return {};
}

}  // namespace skerry::server
