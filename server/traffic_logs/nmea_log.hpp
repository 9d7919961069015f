// NmeaLog: a log of AIS sentences, line by line, into tracks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/nmea/ais_sentences.hpp"
#include "server/traffic_logs/track_book.hpp"

namespace skerry::server {

// The time of a sentence is the first of these that there is: that of its line (log_line.hpp), the
// one that it is handed in with (of a datagram), that of the last ZDA or RMC in the log.
// Sentences of one message are put together by their source, as TAG blocks name it.
// Thread: one at a time.
class NmeaLog {
 public:
  static constexpr std::size_t kLongestLine = 4096;
  static constexpr std::size_t kMostSources = 64;  // apart; those beyond share one

  // Which must outlive it.
  explicit NmeaLog(TrackBook& book) : book_(book) {}

  void take(std::string_view line, std::optional<UtcTime> heard = {});
  // At the end of the log: messages that were not finished are counted.
  void finish();

  std::uint64_t sentences() const { return sentences_; }  // VDM and VDO of messages that were used

 private:
  struct Source {
    nmea::AisAssembler assembler;
    std::uint64_t given_up = 0;    // counted so far
    std::optional<UtcTime> begun;  // when the last message of several parts began
  };
  Source& source_of(std::string_view name);
  void take_vdm(const nmea::Sentence& sentence, Source& source, std::optional<UtcTime> utc);
  void take(const nmea::AisMessage& message, std::optional<UtcTime> utc);
  void take(const nmea::AisPosition& report, std::optional<UtcTime> utc);

  TrackBook& book_;
  std::map<std::string, Source, std::less<>> sources_;
  std::optional<UtcTime> clock_;
  std::uint64_t sentences_ = 0;
};

}  // namespace skerry::server
