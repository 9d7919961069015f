// AlertTalker: a plotter's alerts as sentences, and what displays answer.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/nmea/alert_sentences.hpp"
#include "protocol/wire/targets.pb.h"
#include "server/navigation/navigation_plan.hpp"

namespace skerry::server {

// Thread: one at a time.
class AlertTalker {
 public:
  // Requires one of alf, alc and alr.  ALF: the alerts that have changed since the last ALF, and
  // those that have gone, as normal.  ALC, ALR: all there are.
  std::vector<std::string> sentences(NavigationSentence sentence, const wire::TargetList& list);

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // number, instance
  std::vector<std::string> changes(const wire::TargetList& list);

  std::map<Key, wire::Alert> told_;
  unsigned alf_sequence_ = 0, alc_sequence_ = 0;
};

// What an ACN or ACK orders; silence is of all alerts, whichever it names.  Nothing: it is of a
// maker's own alert, none of which is ours, or it asks for no more than to be told again, or that
// another takes over, which is not done here.
std::optional<wire::TargetOrder> order_of(const nmea::Acn& command);
std::optional<wire::TargetOrder> order_of(const nmea::Ack& command);

}  // namespace skerry::server
