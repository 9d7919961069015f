// Messages of Signal K clients: bodies of changes and messages of the stream.
#include <string>
#include <string_view>

#include "protocol/signalk/control_value.hpp"
#include "protocol/signalk/documents.hpp"
#include "protocol/signalk/subscription.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using namespace skerry::signalk;

bool is_choice(double value, const ControlDefinition& definition) {
  for (const ControlChoice& choice : definition.choices) {
    if (choice.value == value) return choice.settable;
  }
  return definition.choices.empty();
}

void check_number(const std::optional<double>& value, const ControlDefinition& definition) {
  if (!value) return;
  fuzz::require(*value >= definition.min && *value <= definition.max, "a value is in its range");
  fuzz::require(is_choice(*value, definition), "and one of the choices, if there are any");
}

void check_changes(const Json& body) {
  for (const ControlDefinition& definition : control_definitions()) {
    const auto change = read_change(body, definition);
    if (!change) {
      fuzz::require(change.error().starts_with(definition.key), "a refusal names the control");
      fuzz::require(change.error().size() < 500, "and is of bounded length");
      continue;
    }
    fuzz::require(!definition.read_only, "what cannot be set is not set");
    check_number(change->value, definition);
    check_number(change->end, definition);
    fuzz::require(!change->automatic || definition.has_auto, "automatic where there is one");
    fuzz::require(change->value || change->end || change->automatic || change->enabled,
                  "a change changes something");
  }
}

void check_requests(std::string_view text) {
  const auto request = read_stream_request(text);
  if (!request) {
    fuzz::require(!request.error().empty(), "a refusal says why");
    return;
  }
  fuzz::require(request->subscribe.size() <= Subscriptions::kMost, "paths are bounded");
  fuzz::require(request->put_path.size() <= Subscriptions::kLongestPath, "and so is each");
  Subscriptions wanted;
  for (const auto& path : request->subscribe) {
    fuzz::require(path.period >= Subscriptions::kShortestPeriod, "nothing is sent without a pause");
    wanted.subscribe(path.pattern, path.period);
    fuzz::require(wanted.wants(path.pattern), "a pattern fits itself");
  }
  wanted.unsubscribe("*");
  fuzz::require(wanted.empty(), "all subscriptions can be ended");
  if (!request->put_path.empty()) check_changes(request->put_value);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check_requests(text);
  if (const auto body = read_json(text)) {
    check_changes(*body);
    const std::string written = text_of(*body);
    const auto again = read_json(written);
    fuzz::require(written.size() > kMaxText || (again && text_of(*again) == written),
                  "what is written reads the same");
  }
  return 0;
}
