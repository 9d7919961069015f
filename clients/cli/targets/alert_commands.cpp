// skerry targets acknowledge and silence: alerts.
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/cli/console.hpp"
#include "clients/cli/targets/target_words.hpp"
#include "clients/cli/targets/targets_link.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using AlertKey = wire::TargetOrder::AlertKey;

// "3044" and "3044.2".
std::optional<AlertKey> alert_key(const std::string& text) {
  const char* const end = text.data() + text.size();
  std::uint32_t number = 0, instance = 0;
  auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc{}) return std::nullopt;
  if (read.ptr != end) {
    if (*read.ptr != '.') return std::nullopt;
    read = std::from_chars(read.ptr + 1, end, instance);
    if (read.ec != std::errc{} || read.ptr != end || instance == 0) return std::nullopt;
  }
  AlertKey key;
  key.set_number(number);
  key.set_instance(instance);
  return key;
}

bool is_open(const wire::Alert& alert) {
  return alert.priority() != wire::ALERT_CAUTION && alert.state() != wire::ALERT_ACKNOWLEDGED;
}

bool is_meant(const wire::Alert& alert, const std::vector<AlertKey>& keys) {
  if (keys.empty()) return true;
  for (const AlertKey& key : keys) {
    if (key.number() == alert.number() &&
        (key.instance() == 0 || key.instance() == alert.instance())) {
      return true;
    }
  }
  return false;
}

int acknowledge(const TargetsPlace& place, const std::vector<AlertKey>& keys) {
  auto link = TargetsLink::open(place);
  if (!link) return report_targets(link.error());
  wire::TargetOrder order;
  for (const AlertKey& key : keys) *order.add_acknowledge() = key;
  std::string done;
  for (const wire::Alert& alert : link->list().alerts()) {
    if (!is_open(alert) || !is_meant(alert, keys)) continue;
    done +=
        fmt::format("acknowledged: {}: {}\n", alert_in_words(alert), printable(alert.text(), 200));
    if (!keys.empty()) continue;
    AlertKey* const key = order.add_acknowledge();
    key->set_number(alert.number());
    key->set_instance(alert.instance());
  }
  // What is not there is for the server to say.
  if (order.acknowledge_size() > 0) {
    if (const auto reply = link->order(order); !reply) return report_targets(reply.error());
  }
  write_out(done.empty() ? "nothing to acknowledge\n" : done);
  return kExitOk;
}

Command make_acknowledge_command(const TargetsApp& targets) {
  const auto texts = std::make_shared<std::vector<std::string>>();
  CLI::App* part = targets.add_part("acknowledge", "Acknowledges alerts; without any: all");
  part->add_option("ALERT", *texts,
                   "NUMBER.INSTANCE as skerry targets has it, or NUMBER: all of that number");
  part->footer(
      "Examples:\n"
      "  skerry targets acknowledge\n"
      "  skerry targets acknowledge 3044.2 3052\n");
  return {part, [place = targets.place, texts] {
            std::vector<AlertKey> keys;
            for (const std::string& text : *texts) {
              const auto key = alert_key(text);
              if (!key) {
                return misuse_of_targets(fmt::format(
                    "acknowledge: '{}' is no alert; expected NUMBER or NUMBER.INSTANCE, as 3044.1",
                    printable(text, 40)));
              }
              keys.push_back(*key);
            }
            return acknowledge(*place, keys);
          }};
}

Command make_silence_command(const TargetsApp& targets) {
  CLI::App* part = targets.add_part("silence", "Silences what sounds, for 30 s");
  return {part, [place = targets.place] {
            wire::TargetOrder order;
            order.set_silence(true);
            return order_targets(*place, order, "silenced");
          }};
}

}  // namespace

std::vector<Command> make_alert_commands(const TargetsApp& targets) {
  return {make_acknowledge_command(targets), make_silence_command(targets)};
}

}  // namespace skerry::client
