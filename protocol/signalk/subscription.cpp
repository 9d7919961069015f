#include "protocol/signalk/subscription.hpp"

#include <algorithm>

namespace skerry::signalk {
namespace {

using std::chrono::milliseconds;

bool is_own_ship(const std::string& context) {
  return context.empty() || context == "self" || context == "*" || context == "vessels.self" ||
         context == "vessels.*";
}

bool is_others(const std::string& context) {
  return context == "*" || context == "vessels.*" || context.starts_with("vessels.urn:");
}

milliseconds period_in(const Json& entry) {
  constexpr double kLongest = 3'600'000;
  if (text_member(entry, "policy") == "instant") return Subscriptions::kShortestPeriod;
  for (const char* name : {"period", "minPeriod"}) {
    const Json* value = member(entry, name);
    const auto number = value != nullptr ? number_in(*value) : std::nullopt;
    if (!number) continue;
    return std::max(milliseconds(static_cast<std::int64_t>(std::clamp(*number, 0.0, kLongest))),
                    Subscriptions::kShortestPeriod);
  }
  return Subscriptions::kUsualPeriod;
}

void read_paths(const Json& list, std::vector<StreamRequest::Path>& out) {
  if (!list.is_array()) return;
  for (const Json& entry : list) {
    if (out.size() == Subscriptions::kMost) return;
    const std::string path = text_member(entry, "path");
    if (path.empty() || path.size() > Subscriptions::kLongestPath) continue;
    out.push_back({path, period_in(entry)});
  }
}

}  // namespace

bool path_matches(std::string_view pattern, std::string_view path) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, after_star = 0;
  while (t < path.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      after_star = t;
    } else if (p < pattern.size() && pattern[p] == path[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++after_star;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

void Subscriptions::subscribe(std::string_view pattern, milliseconds period) {
  const auto known = std::find_if(wanted_.begin(), wanted_.end(),
                                  [&](const Wanted& each) { return each.pattern == pattern; });
  if (known != wanted_.end()) {
    known->period = period;
  } else if (wanted_.size() < kMost && pattern.size() <= kLongestPath) {
    wanted_.push_back({std::string(pattern), period});
  }
}

void Subscriptions::unsubscribe(std::string_view pattern) {
  std::erase_if(wanted_,
                [&](const Wanted& each) { return pattern == "*" || each.pattern == pattern; });
}

bool Subscriptions::wants(std::string_view path) const { return period_of(path).has_value(); }

std::optional<milliseconds> Subscriptions::period_of(std::string_view path) const {
  std::optional<milliseconds> shortest;
  for (const Wanted& each : wanted_) {
    if (!path_matches(each.pattern, path)) continue;
    if (!shortest || each.period < *shortest) shortest = each.period;
  }
  return shortest;
}

Result<StreamRequest, std::string> read_stream_request(std::string_view text) {
  const auto document = read_json(text);
  if (!document || !document->is_object()) {
    return Failure{std::string("a message that is no JSON object")};
  }
  StreamRequest request;
  const std::string context = text_member(*document, "context");
  const auto read_lists = [&](auto& subscribe, auto& unsubscribe) {
    if (const Json* list = member(*document, "subscribe")) read_paths(*list, subscribe);
    for (const char* name : {"unsubscribe", "desubscribe"}) {
      if (const Json* list = member(*document, name)) read_paths(*list, unsubscribe);
    }
  };
  if (is_own_ship(context)) read_lists(request.subscribe, request.unsubscribe);
  if (is_others(context)) read_lists(request.subscribe_others, request.unsubscribe_others);
  request.request_id = text_member(*document, "requestId").substr(0, Subscriptions::kLongestPath);
  request.token = text_member(*document, "token");
  const Json* put = member(*document, "put");
  const Json& holder = put != nullptr && put->is_object() ? *put : *document;
  request.put_path = text_member(holder, "path");
  if (request.put_path.size() > Subscriptions::kLongestPath) {
    return Failure{std::string("a path that is too long")};
  }
  if (!request.put_path.empty()) {
    const Json* value = member(holder, "value");
    // {"path":..,"value":1,"endValue":2} says it all beside the path.
    request.put_value = value != nullptr && value->is_object() ? *value : holder;
  }
  return request;
}

}  // namespace skerry::signalk
