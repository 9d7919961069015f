// ALF, ALC, ACN and ARC: alerts as bridge alert management has them.  ALR and ACK: alarms before
// it.  HBT: that equipment is alive.
// Source: IEC 61162-1 ed. 4 and 5 and IEC 62923-1; nmea/README.md "Alerts", which says from where
// the orders of fields were taken.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// The letters are those of the fields.
enum class AlertCategory : char { a = 'A', b = 'B', c = 'C' };
enum class AlertPriority : char { emergency = 'E', alarm = 'A', warning = 'W', caution = 'C' };
enum class AlertState : char {
  unacknowledged = 'V',
  silenced = 'S',
  acknowledged = 'A',  // or a caution, which nobody acknowledges
  transferred = 'O',   // another has the responsibility
  rectified = 'U',     // and not acknowledged
  normal = 'N',
};
enum class AlertCommand : char {
  acknowledge = 'A',
  request = 'Q',  // send it again
  transfer = 'O',
  silence = 'S',
};

inline constexpr unsigned kMostAlertIdentifier = 9'999'999, kMostAlertInstance = 999'999,
                          kMostAlertRevision = 99, kMostAlertEscalation = 9;
inline constexpr std::size_t kMostAlertTitle = 16;  // characters

// Which alert it is.
struct AlertKey {
  std::string manufacturer = {};          // three letters; empty for alerts of standards
  unsigned identifier = 0;                // 0 .. kMostAlertIdentifier; 0 in a command: all alerts
  std::optional<unsigned> instance = {};  // 0 .. kMostAlertInstance; otherwise an empty field
  friend bool operator==(const AlertKey&, const AlertKey&) = default;
};

// One ALF.  A second one of the same alert has no time, category, priority and state.
struct Alf {
  unsigned total = 1;     // 1 or 2
  unsigned number = 1;    // 1 .. total
  unsigned sequence = 0;  // the same in both; 0 .. 9, of what is larger the last digit
  std::optional<Duration> time_of_change = {};  // of day
  std::optional<AlertCategory> category = {};
  std::optional<AlertPriority> priority = {};
  std::optional<AlertState> state = {};
  AlertKey key = {};
  unsigned revision = 1;    // 1 .. kMostAlertRevision: counts changes, and after 99 begins at 1
  unsigned escalation = 0;  // 0 .. kMostAlertEscalation
  std::string text = {};    // as much of it as fits: 24 characters of a first, 36 of a second
};
// Revision and escalation are written as the nearest that is allowed.  An identifier that is out of
// range is an empty field, and such a sentence is refused by who reads it: so with all that follow.
std::string encode(const Alf& alf, std::string_view talker = "RA");
Result<Alf, WireError> decode_alf(const Sentence& sentence);

// An alert with its texts: one sentence, or two if there is a description.
struct Alert {
  std::optional<Duration> time_of_change = {};
  AlertCategory category = AlertCategory::b;
  AlertPriority priority = AlertPriority::caution;
  AlertState state = AlertState::normal;
  AlertKey key = {};
  unsigned revision = 1;
  unsigned escalation = 0;
  std::string title = {};        // cut to kMostAlertTitle
  std::string description = {};  // cut to what has room in a sentence
};
std::vector<std::string> encode_alert(const Alert& alert, unsigned sequence,
                                      std::string_view talker = "RA");

// One alert of the cyclic list.
struct AlertEntry {
  AlertKey key = {};
  unsigned revision = 1;  // that of the alert's last ALF
  friend bool operator==(const AlertEntry&, const AlertEntry&) = default;
};
// One ALC.
struct Alc {
  unsigned total = 1;     // 1 .. 99
  unsigned number = 1;    // 1 .. total
  unsigned sequence = 0;  // 0 .. 99
  std::vector<AlertEntry> entries = {};
};
// As many sentences as needed, one if there are no alerts.  No entry is split.  After 99 sentences,
// which hold at least 198 entries, the rest is left out.  `sequence`: its last two digits count.
std::vector<std::string> encode_alc(std::span<const AlertEntry> entries, unsigned sequence,
                                    std::string_view talker = "RA");
Result<Alc, WireError> decode_alc(const Sentence& sentence);

// What an operator does with an alert elsewhere.
struct Acn {
  std::optional<Duration> time_of_day = {};
  AlertKey key = {};
  AlertCommand command = AlertCommand::acknowledge;
};
std::string encode(const Acn& acn, std::string_view talker = "RA");
// Without the flag C at its end it is no command, and is refused.
Result<Acn, WireError> decode_acn(const Sentence& sentence);

// A command of an ACN that is not obeyed.
struct Arc {
  std::optional<Duration> time_of_day = {};  // of the refusal
  AlertKey key = {};
  AlertCommand refused = AlertCommand::acknowledge;
};
std::string encode(const Arc& arc, std::string_view talker = "RA");
Result<Arc, WireError> decode_arc(const Sentence& sentence);

struct Alr {
  std::optional<Duration> time_of_change = {};
  unsigned number = 0;       // 0 .. 999
  bool is_exceeded = false;  // the alarm's condition
  bool is_acknowledged = false;
  std::string text = {};  // as much of it as fits
};
std::string encode(const Alr& alr, std::string_view talker = "RA");
Result<Alr, WireError> decode_alr(const Sentence& sentence);

// An alarm of an ALR is acknowledged.
struct Ack {
  unsigned number = 0;  // 0 .. 999
};
std::string encode(const Ack& ack, std::string_view talker = "RA");
Result<Ack, WireError> decode_ack(const Sentence& sentence);

struct Hbt {
  std::optional<double> interval_s = {};  // until the next; 1 .. 999, otherwise an empty field
  bool is_well = true;                    // the equipment works as it should
  unsigned sequence = 0;                  // 0 .. 9, of what is larger the last digit
};
std::string encode(const Hbt& hbt, std::string_view talker = "RA");
Result<Hbt, WireError> decode_hbt(const Sentence& sentence);

}  // namespace skerry::nmea
