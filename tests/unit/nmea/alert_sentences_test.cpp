// Alerts and alarms as sentences: as others write them, there and back, cut and split.
#include "protocol/nmea/alert_sentences.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

constexpr Duration kNoonAndABit = 12h + 43min + 4s + 500ms;
const std::string kLong =
    "A TARGET THAT IS DANGEROUS*,$ COMES NEARER FROM THE STARBOARD BOW AND BEYOND";

Alert an_alert() {
  return {.time_of_change = kNoonAndABit,
          .category = AlertCategory::a,
          .priority = AlertPriority::warning,
          .state = AlertState::unacknowledged,
          .key = {"", 190, 2},
          .revision = 3,
          .escalation = 1,
          .title = "CPA/TCPA",
          .description = "Target 12 inside of CPA and TCPA limits"};
}

TEST(Alf, ATitleAndADescriptionAreTwoSentences) {
  const auto lines = encode_alert(an_alert(), 7);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(body(lines[0]), "$RAALF,2,1,7,124304.50,A,W,V,,190,2,3,1,CPA/TCPA");
  EXPECT_EQ(body(lines[1]), "$RAALF,2,2,7,,,,,,190,2,3,1,Target 12 inside of CPA and TCPA limits");
  const Alf first = decoded(lines[0], decode_alf);
  EXPECT_EQ(first.total, 2u);
  EXPECT_EQ(first.number, 1u);
  EXPECT_EQ(first.sequence, 7u);
  EXPECT_EQ(first.time_of_change, kNoonAndABit);
  EXPECT_EQ(first.category, AlertCategory::a);
  EXPECT_EQ(first.priority, AlertPriority::warning);
  EXPECT_EQ(first.state, AlertState::unacknowledged);
  EXPECT_EQ(first.key, an_alert().key);
  EXPECT_EQ(first.revision, 3u);
  EXPECT_EQ(first.escalation, 1u);
  EXPECT_EQ(first.text, "CPA/TCPA");
  const Alf second = decoded(lines[1], decode_alf);
  EXPECT_EQ(second.number, 2u);
  EXPECT_FALSE(second.time_of_change || second.category || second.priority || second.state);
  EXPECT_EQ(second.key, first.key);
  EXPECT_EQ(second.text, an_alert().description);
}

TEST(Alf, WithoutADescriptionItIsOneSentence) {
  Alert alert = an_alert();
  alert.description.clear();
  alert.key = {"SKE", 10'001, {}};
  const auto lines = encode_alert(alert, 0, "BN");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(body(lines[0]), "$BNALF,1,1,0,124304.50,A,W,V,SKE,10001,,3,1,CPA/TCPA");
}

TEST(Alf, EveryLetterComesBack) {
  for (const char category : {'A', 'B', 'C'})
    for (const char priority : {'E', 'A', 'W', 'C'})
      for (const char state : {'A', 'S', 'N', 'O', 'U', 'V'}) {
        Alert alert = an_alert();
        alert.category = static_cast<AlertCategory>(category);
        alert.priority = static_cast<AlertPriority>(priority);
        alert.state = static_cast<AlertState>(state);
        const Alf alf = decoded(encode_alert(alert, 0)[0], decode_alf);
        EXPECT_EQ(alf.category, alert.category);
        EXPECT_EQ(alf.priority, alert.priority);
        EXPECT_EQ(alf.state, alert.state);
      }
}

TEST(Alf, LongTextsAreCutAndLongNumbersAreNot) {
  Alert alert = an_alert();
  alert.key = {"LONGER", kMostAlertIdentifier, kMostAlertInstance};
  alert.revision = 99;
  alert.escalation = 9;
  alert.title = alert.description = kLong;
  const auto lines = encode_alert(alert, 123);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(body(lines[0]),
            "$RAALF,2,1,3,124304.50,A,W,V,LON,9999999,999999,99,9,A TARGET THAT IS");
  EXPECT_EQ(lines[1].size(), kMaxSentence);
  const Alf second = decoded(lines[1], decode_alf);
  EXPECT_EQ(second.text, "A TARGET THAT IS DANGEROUS    COMES ");
  EXPECT_EQ(second.key, (AlertKey{"LON", kMostAlertIdentifier, kMostAlertInstance}));
}

TEST(Alf, CountersAreKeptInTheirRangeAndAnIdentifierOutOfItIsNoAlert) {
  Alf alf{.key = {"", 5, 1'000'000}, .revision = 0, .escalation = 10};
  const Alf low = decoded(encode(alf), decode_alf);
  EXPECT_EQ(low.revision, 1u);
  EXPECT_EQ(low.escalation, 9u);
  EXPECT_FALSE(low.key.instance);
  alf.revision = 100;
  EXPECT_EQ(decoded(encode(alf), decode_alf).revision, 99u);
  alf.key.identifier = kMostAlertIdentifier + 1;
  EXPECT_FALSE(decode_alf(parse_sentence(encode(alf)).value()));
}

TEST(Alf, IsReadAsOthersWriteIt) {
  // Sequence, text and numbers as in a manual of Avikus, and as go-nmea has them.
  const Alf first = decoded(
      with_checksum("TCALF,2,1,0,123456,A,W,V,AVK,777035,1,0,0,Collision Danger"), decode_alf);
  EXPECT_EQ(first.key, (AlertKey{"AVK", 777'035, 1}));
  EXPECT_EQ(first.revision, 0u);
  EXPECT_EQ(first.time_of_change, 12h + 34min + 56s);
  const Alf other =
      decoded(with_checksum("VDALF,1,1,1,220516,B,A,S,SAL,001,1,2,0,My alarm"), decode_alf);
  EXPECT_EQ(other.key.identifier, 1u);
  EXPECT_EQ(other.state, AlertState::silenced);
}

TEST(Alf, WhatIsNotOfItsKindIsRefused) {
  for (const char* bad :
       {"RAALF,3,1,0,,A,W,V,,190,,1,0,X", "RAALF,1,2,0,,A,W,V,,190,,1,0,X",
        "RAALF,1,0,0,,A,W,V,,190,,1,0,X", "RAALF,1,1,10,,A,W,V,,190,,1,0,X",
        "RAALF,1,1,0,246060,A,W,V,,190,,1,0,X", "RAALF,1,1,0,,D,W,V,,190,,1,0,X",
        "RAALF,1,1,0,,A,X,V,,190,,1,0,X", "RAALF,1,1,0,,A,W,X,,190,,1,0,X",
        "RAALF,1,1,0,,A,W,V,LONG,190,,1,0,X", "RAALF,1,1,0,,A,W,V,,,,1,0,X",
        "RAALF,1,1,0,,A,W,V,,10000000,,1,0,X", "RAALF,1,1,0,,A,W,V,,190,1000000,1,0,X",
        "RAALF,1,1,0,,A,W,V,,190,,100,0,X", "RAALF,1,1,0,,A,W,V,,190,,1,10,X", "RAALF,1,1,0"}) {
    EXPECT_TRUE(is_refused(bad, decode_alf)) << bad;
  }
}

TEST(Alc, NoAlertsAreASentenceOfNone) {
  const auto lines = encode_alc({}, 0);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(body(lines[0]), "$RAALC,01,01,00,0");
  EXPECT_TRUE(decoded(lines[0], decode_alc).entries.empty());
}

TEST(Alc, NoEntryIsSplit) {
  const AlertEntry shortest{{"", 190, {}}, 1}, longest{{"SKE", 9'999'999, 999'999}, 99};
  EXPECT_EQ(encode_alc(std::vector(7, shortest), 0).size(), 1u);
  EXPECT_EQ(encode_alc(std::vector(8, shortest), 0).size(), 2u);
  EXPECT_EQ(encode_alc(std::vector(2, longest), 0).size(), 1u);
  const auto lines = encode_alc(std::vector{longest, shortest, longest, longest, shortest}, 142);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(body(lines[0]),
            "$RAALC,02,01,42,3,SKE,9999999,999999,99,,190,,1,SKE,9999999,999999,99");
  EXPECT_EQ(body(lines[1]), "$RAALC,02,02,42,2,SKE,9999999,999999,99,,190,,1");
  std::vector<AlertEntry> back;
  for (const std::string& line : lines) {
    const Alc alc = decoded(line, decode_alc);
    EXPECT_EQ(alc.total, 2u);
    EXPECT_EQ(alc.sequence, 42u);
    back.insert(back.end(), alc.entries.begin(), alc.entries.end());
  }
  EXPECT_THAT(back, ElementsAre(longest, shortest, longest, longest, shortest));
}

TEST(Alc, WhatIsBeyondNinetyNineSentencesIsLeftOut) {
  const AlertEntry longest{{"SKE", 9'999'999, 999'999}, 99};
  const auto lines = encode_alc(std::vector(300, longest), 0);
  ASSERT_EQ(lines.size(), 99u);
  for (const std::string& line : lines) EXPECT_EQ(decoded(line, decode_alc).entries.size(), 2u);
  EXPECT_TRUE(body(lines.back()).starts_with("$RAALC,99,99,00,2,"));
}

TEST(Alc, ACountThatIsNotThereIsRefused) {
  EXPECT_FALSE(is_refused("TCALC,01,01,00,2,AVK,777035,1,0,AVK,777036,1,0", decode_alc));
  EXPECT_TRUE(is_refused("TCALC,01,01,00,3,AVK,777035,1,0,AVK,777036,1,0", decode_alc));
  EXPECT_TRUE(is_refused("TCALC,01,01,00,4000000000", decode_alc));
  EXPECT_TRUE(is_refused("TCALC,01,02,00,0", decode_alc));
  EXPECT_TRUE(is_refused("TCALC,01,01,100,0", decode_alc));
}

TEST(Acn, IsAsOthersWriteIt) {
  // The checksum is that of Avikus's own example.
  const Acn acn = decoded("$TCACN,123456,AVK,777035,1,A,C*32", decode_acn);
  EXPECT_EQ(acn.time_of_day, 12h + 34min + 56s);
  EXPECT_EQ(acn.key, (AlertKey{"AVK", 777'035, 1}));
  EXPECT_EQ(acn.command, AlertCommand::acknowledge);
  EXPECT_EQ(body(encode(acn, "TC")), "$TCACN,123456.00,AVK,777035,1,A,C");
}

TEST(Acn, EveryCommandComesBackAndWithoutItsFlagItIsNone) {
  for (const auto command : {AlertCommand::acknowledge, AlertCommand::request,
                             AlertCommand::transfer, AlertCommand::silence}) {
    EXPECT_EQ(decoded(encode(Acn{.key = {"", 0, {}}, .command = command}), decode_acn).command,
              command);
    EXPECT_EQ(decoded(encode(Arc{.key = {"", 0, {}}, .refused = command}), decode_arc).refused,
              command);
  }
  for (const char* bad :
       {"RAACN,,,190,,A,", "RAACN,,,190,,A,R", "RAACN,,,190,,X,C", "RAACN,,,190,,,C",
        "RAACN,,,,,A,C", "RAACN,,,190", "RAACN,noon,,190,,A,C"}) {
    EXPECT_TRUE(is_refused(bad, decode_acn)) << bad;
  }
}

TEST(Arc, IsAsOthersWriteIt) {
  const Arc arc = decoded("$TCARC,123456,AVK,777035,1,A*41", decode_arc);
  EXPECT_EQ(arc.key, (AlertKey{"AVK", 777'035, 1}));
  EXPECT_EQ(body(encode(arc, "TC")), "$TCARC,123456.00,AVK,777035,1,A");
  EXPECT_TRUE(is_refused("RAARC,,,190,,", decode_arc));
}

TEST(Alr, IsAsWritten) {
  const std::string line = encode(Alr{kNoonAndABit, 7, true, false, kLong});
  EXPECT_EQ(line.size(), kMaxSentence);
  EXPECT_TRUE(body(line).starts_with("$RAALR,124304.50,007,A,V,A TARGET THAT IS DANGEROUS   "));
  const Alr alr = decoded(line, decode_alr);
  EXPECT_EQ(alr.time_of_change, kNoonAndABit);
  EXPECT_EQ(alr.number, 7u);
  EXPECT_TRUE(alr.is_exceeded);
  EXPECT_FALSE(alr.is_acknowledged);
  EXPECT_EQ(body(encode(Ack{7})), "$RAACK,007");
  EXPECT_EQ(decoded(encode(Ack{999}), decode_ack).number, 999u);
  EXPECT_FALSE(decode_ack(parse_sentence(encode(Ack{1000})).value()));
  EXPECT_TRUE(is_refused("RAALR,,1000,A,A,", decode_alr));
  EXPECT_TRUE(is_refused("RAALR,,1,X,A,", decode_alr));
}

TEST(Hbt, IsAsWritten) {
  EXPECT_EQ(body(encode(Hbt{60.0, true, 29})), "$RAHBT,60.0,A,9");
  EXPECT_EQ(body(encode(Hbt{1000.0, false, 0})), "$RAHBT,,V,0");
  const Hbt hbt = decoded(encode(Hbt{999.0, false, 3}), decode_hbt);
  EXPECT_EQ(hbt.interval_s, 999.0);
  EXPECT_FALSE(hbt.is_well);
  EXPECT_EQ(hbt.sequence, 3u);
  EXPECT_TRUE(is_refused("RAHBT,0.5,A,0", decode_hbt));
  EXPECT_TRUE(is_refused("RAHBT,60,A,10", decode_hbt));
}

}  // namespace
}  // namespace skerry::nmea
