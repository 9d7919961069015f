#include "server/navigation/alert_talker.hpp"

#include "protocol/nmea/position_sentences.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {
namespace {

constexpr unsigned kMostAlrNumber = 999;

std::optional<Duration> time_of(const wire::Alert& alert) {
  return nmea::time_of_day(UtcTime(Duration(static_cast<std::int64_t>(alert.utc_ns()))));
}

nmea::AlertState state_of(const wire::Alert& alert) {
  switch (alert.state()) {
    case wire::ALERT_SILENCED:
      return nmea::AlertState::silenced;
    case wire::ALERT_ACKNOWLEDGED:
      return nmea::AlertState::acknowledged;
    case wire::ALERT_RECTIFIED:
      return nmea::AlertState::rectified;
    default:
      return nmea::AlertState::unacknowledged;
  }
}

nmea::AlertPriority priority_of(const wire::Alert& alert) {
  switch (alert.priority()) {
    case wire::ALERT_ALARM:
      return nmea::AlertPriority::alarm;
    case wire::ALERT_WARNING:
      return nmea::AlertPriority::warning;
    default:
      return nmea::AlertPriority::caution;
  }
}

nmea::AlertCategory category_of(const wire::Alert& alert) {
  if (alert.category() == "A") return nmea::AlertCategory::a;
  return alert.category() == "C" ? nmea::AlertCategory::c : nmea::AlertCategory::b;
}

nmea::AlertKey key_of(const wire::Alert& alert) {
  return {.manufacturer = {}, .identifier = alert.number(), .instance = alert.instance()};
}

std::vector<std::string> alf_of(const wire::Alert& alert, nmea::AlertState state,
                                unsigned sequence) {
  return nmea::encode_alert({.time_of_change = time_of(alert),
                             .category = category_of(alert),
                             .priority = priority_of(alert),
                             .state = state,
                             .key = key_of(alert),
                             .revision = alert.revision(),
                             .escalation = alert.escalations(),
                             .title = alert.title(),
                             .description = alert.text()},
                            sequence);
}

void append(std::vector<std::string>& to, std::vector<std::string> lines) {
  to.insert(to.end(), std::make_move_iterator(lines.begin()), std::make_move_iterator(lines.end()));
}

}  // namespace

std::vector<std::string> AlertTalker::changes(const wire::TargetList& list) {
  std::vector<std::string> lines;
  std::map<Key, wire::Alert> now;
  for (const wire::Alert& alert : list.alerts()) {
    const Key key(alert.number(), alert.instance());
    const auto before = told_.find(key);
    if (before == told_.end() || before->second.revision() != alert.revision()) {
      append(lines, alf_of(alert, state_of(alert), alf_sequence_++));
    }
    now.emplace(key, alert);
  }
  for (auto& [key, alert] : told_) {
    if (now.contains(key)) continue;
    alert.set_utc_ns(list.utc_ns());
    alert.set_revision(alert.revision() % nmea::kMostAlertRevision + 1);
    append(lines, alf_of(alert, nmea::AlertState::normal, alf_sequence_++));
  }
  told_ = std::move(now);
  return lines;
}

std::vector<std::string> AlertTalker::sentences(NavigationSentence sentence,
                                                const wire::TargetList& list) {
  if (sentence == NavigationSentence::alf) return changes(list);
  if (sentence == NavigationSentence::alc) {
    std::vector<nmea::AlertEntry> entries;
    for (const wire::Alert& alert : list.alerts()) {
      entries.push_back({.key = key_of(alert), .revision = alert.revision()});
    }
    return nmea::encode_alc(entries, alc_sequence_++);
  }
  std::vector<std::string> lines;
  for (const wire::Alert& alert : list.alerts()) {
    lines.push_back(encode(nmea::Alr{.time_of_change = time_of(alert),
                                     .number = alert.number() % (kMostAlrNumber + 1),
                                     .is_exceeded = alert.state() != wire::ALERT_RECTIFIED,
                                     .is_acknowledged = alert.state() == wire::ALERT_ACKNOWLEDGED,
                                     .text = alert.text()}));
  }
  return lines;
}

std::optional<wire::TargetOrder> order_of(const nmea::Acn& command) {
  if (!command.key.manufacturer.empty()) return std::nullopt;  // of another's alert
  wire::TargetOrder order;
  if (command.command == nmea::AlertCommand::silence) {
    order.set_silence(true);
    return order;
  }
  if (command.command != nmea::AlertCommand::acknowledge) return std::nullopt;
  auto& key = *order.add_acknowledge();
  key.set_number(command.key.identifier);
  key.set_instance(command.key.instance.value_or(0));
  return order;
}

std::optional<wire::TargetOrder> order_of(const nmea::Ack& command) {
  wire::TargetOrder order;
  // ALR has the last three digits of an alert's number, all of them of the 3000s.
  order.add_acknowledge()->set_number(3000 + command.number);
  return order;
}

}  // namespace skerry::server
