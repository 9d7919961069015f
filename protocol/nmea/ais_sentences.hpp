// VDM and VDO: AIS messages in sentences, several where one does not hold them.
// Source: IEC 61162-1:2010 8.3.93, 8.3.94; nmea/README.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/nmea/ais_messages.hpp"
#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// Characters of payload in one sentence, so that it has at most kMaxSentence.
inline constexpr std::size_t kAisPayload = 60;

// `own`: VDO, which has no channel, else VDM.  `identifier` 0 .. 9 joins the sentences of one
// message; `channel` is 'A' or 'B'.
std::vector<std::string> encode_ais(const AisMessage& message, bool own, unsigned identifier,
                                    char channel);

struct HeardAis {
  AisMessage message = {};
  bool own = false;
};

// Puts messages together again.  Holds at most one unfinished message per identifier, and of each
// at most kMostParts sentences.
class AisAssembler {
 public:
  static constexpr unsigned kMostParts = 9;

  // What feed() says of a sentence whose message has not begun.
  static constexpr const char* kNoBeginning = "an AIS message without its beginning";

  // nullopt while the message continues.  Error: also if its beginning is missing.
  Result<std::optional<HeardAis>, WireError> feed(const Sentence& sentence);

  // Messages that began and whose end never came; another took their place.
  std::uint64_t given_up() const { return given_up_; }
  // Messages that have begun.
  std::size_t pending() const;

 private:
  struct Begun {
    unsigned total = 0, next = 0;  // next 0: nothing has begun
    std::string payload;
  };
  std::array<Begun, 10> begun_;
  std::uint64_t given_up_ = 0;
};

}  // namespace skerry::nmea
