// A TargetList in words.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/wire/targets.pb.h"

namespace skerry::client {

// Which comes first.  By CPA: those that are still to come, then those that are past, then those
// of which none is known.
enum class TargetSort : std::uint8_t { cpa, range, number };

// Tables of own ship, tracked targets, AIS targets, zones, trial and alerts.
std::string targets_text(const wire::TargetList& list, TargetSort sort);

// A heading and a row for each tracked and each AIS target; what is absent is empty.
std::string targets_csv(const wire::TargetList& list, TargetSort sort);

// What has happened between two lists but that targets move, a line each with the time.
std::vector<std::string> target_changes(const wire::TargetList& before,
                                        const wire::TargetList& after);

// Each rule with its value, its option, what is allowed and what it is for.
std::string rules_text(const wire::TargetRules& rules);
// "CPA limit 0.5 NM, acquire all": what is present.
std::string rules_in_words(const wire::TargetRules& rules);

// "zone 1: acquires, 2 to 3 NM, 315.0 to 045.0 from north"
std::string zone_in_words(const wire::TargetZone& zone);

// "course 090.0 at 12 kn in 5 min"
std::string trial_in_words(const wire::TrialOrder& order);
// A row for each target, the closest first, with its CPA if nothing is done.
std::string trial_text(const wire::TargetList& list);

// "alarm 3044.1 CPA/TCPA"
std::string alert_in_words(const wire::Alert& alert);

// "08:15:30"
std::string clock_in_words(std::uint64_t utc_ns);
// With so many decimals; "-" for what no table has room for.
std::string figure(double value, int decimals);
// "045.0"
std::string direction(double degrees);

}  // namespace skerry::client
