// Class codes, as who leads the exercise orders them.
#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "protocol/wire/printable_text.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/native/native_session.hpp"

namespace skerry::server {
namespace {

wire::ClassList class_list(const ClassCodes& codes, UtcTime now) {
  wire::ClassList list;
  for (const auto& [ship, code] : codes.codes()) {
    if (now >= code.ends) continue;
    wire::ClassCode& told = *list.add_codes();
    told.set_ship(ship);
    if (code.takes_in()) told.set_code(code.digits);
    told.set_ends_utc_ns(static_cast<std::uint64_t>(code.ends.time_since_epoch().count()));
    for (const std::string& name : codes.trainees_of(ship, now)) told.add_trainees(name);
    told.set_wrong(code.wrong);
    told.set_wrong_most(ClassCodes::kMostWrong);
  }
  return list;
}

// Why it was not made, if so.
std::optional<std::string> make_code(NetContext& context, const wire::NewClassCode& wanted) {
  if (!context.has_ship(wanted.ship())) {
    return fmt::format("there is no own ship '{}'; {}", printable(wanted.ship()),
                       context.ships_in_words());
  }
  const std::chrono::minutes time =
      wanted.minutes() == 0 ? ClassCodes::kUsual : std::chrono::minutes(wanted.minutes());
  const unsigned digits = wanted.digits() == 0 ? ClassCodes::kFewestDigits : wanted.digits();
  try {
    context.gate.make_class_code(wanted.ship(), time, digits, utc_now());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return std::nullopt;
}

}  // namespace

void NativeSession::order_class(std::uint32_t request, const wire::ClassOrder& order) {
  std::optional<std::string> wrong;
  std::string what;
  if (order.has_make()) {
    what = fmt::format("a class code for {}", printable(order.make().ship()));
    wrong = make_code(context_, order.make());
  } else if (order.order_case() == wire::ClassOrder::kEnd) {
    what = fmt::format("end the class code for {}", printable(order.end()));
    if (!context_.gate.end_class_code(order.end())) {
      wrong = fmt::format("the ship '{}' has no class code", printable(order.end()));
    }
  }
  if (!what.empty()) {
    context_.audit({.kind = AuditEntry::Kind::request,
                    .from = origin(),
                    .who = who_,
                    .what = what,
                    .result = wrong.value_or("ok")});
  }
  if (wrong) return reply(request, wire::Reply::UNKNOWN, "class code: " + *std::move(wrong));
  wire::ServerMessage message;
  *message.mutable_classes() = class_list(context_.gate.class_codes(), utc_now());
  send(message);
  reply(request, wire::Reply::OK, "");
}

}  // namespace skerry::server
