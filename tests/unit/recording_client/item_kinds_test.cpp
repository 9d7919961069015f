// Every row of the table of recorded items: written, read, named, cut and joined.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "clients/recording/recording_edit.hpp"
#include "clients/recording/recording_info.hpp"
#include "protocol/recording/topics.hpp"
#include "tests/unit/recording_client/recording_maker.hpp"

namespace skerry::client {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using recording::EditRule;
using recording::Kind;
using recording::KindRow;
using recording::Scope;
using recording::Topic;
using std::chrono::seconds;

// Gives every field a value that `seed` tells apart; radars and views are 0.
void fill(Message& message, int seed) {
  const auto& at = *message.GetReflection();
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *message.GetDescriptor()->field(i);
    const bool is_list = field.is_repeated();
    const bool is_number_of = field.name().starts_with("radar") || field.name() == "view";
    const auto number = static_cast<std::uint32_t>(is_number_of ? 0 : seed);
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_MESSAGE:
        fill(is_list ? *at.AddMessage(&message, &field) : *at.MutableMessage(&message, &field),
             seed);
        break;
      case FieldDescriptor::CPPTYPE_UINT32:
        is_list ? at.AddUInt32(&message, &field, number) : at.SetUInt32(&message, &field, number);
        break;
      case FieldDescriptor::CPPTYPE_DOUBLE:
        is_list ? at.AddDouble(&message, &field, seed) : at.SetDouble(&message, &field, seed);
        break;
      case FieldDescriptor::CPPTYPE_UINT64:
        if (!is_list) at.SetUInt64(&message, &field, static_cast<std::uint64_t>(seed));
        break;
      case FieldDescriptor::CPPTYPE_STRING:
        if (!is_list) at.SetString(&message, &field, "text " + std::to_string(seed));
        break;
      default:
        break;
    }
  }
}

// Collects the fields `radar` and `radars` of a message and of its lists.
void collect_radars(const Message& message, std::multiset<std::uint32_t>& radars) {
  const auto& at = *message.GetReflection();
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *message.GetDescriptor()->field(i);
    if (field.name() == "radar") radars.insert(at.GetUInt32(message, &field));
    for (int k = 0; field.is_repeated() && k < at.FieldSize(message, &field); ++k) {
      if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
        collect_radars(at.GetRepeatedMessage(message, &field, k), radars);
      } else if (field.name() == "radars") {
        radars.insert(at.GetRepeatedUInt32(message, &field, k));
      }
    }
  }
}

class ItemKind : public testing::TestWithParam<KindRow> {
 protected:
  ~ItemKind() override {
    for (const char* name : {"a", "b", "made"}) std::filesystem::remove(path(name));
  }
  static std::string path(const std::string& name) { return test_path("kind_" + name); }

  std::unique_ptr<Message> message(int seed) const {
    if (row_.kind == Kind::input) {  // of one exercise
      auto input = std::make_unique<recording::Input>();
      input->mutable_order()->set_tick(static_cast<std::uint64_t>(seed));
      return input;
    }
    std::unique_ptr<Message> message(row_.message().New());
    fill(*message, seed);
    return message;
  }
  // Items of the kind at 1, 3 and 7 s, and a spoke of radar 0 at 0 s.
  recording::RecordingReader recorded(const std::string& name) const {
    RecordingMaker maker(path(name), kBegin);
    maker.add_hello({{0, name}});
    maker.add_spokes(0, 1);
    if (row_.kind != Kind::event) maker.add_mark(seconds(4), "a part with nothing is refused");
    for (const int second : {1, 3, 7}) {
      maker.add({row_.kind}, seconds(second), *message(second));
    }
    maker.finish();
    return opened(path(name));
  }
  // Without the spoke and the Hello that are in every file.
  std::vector<TimedBytes> items(const recording::RecordingReader& reader) const {
    std::vector<TimedBytes> items = items_of(reader, row_.kind);
    std::erase_if(items, [&](const TimedBytes& item) {
      return item.time == kBegin && row_.edit != EditRule::once;
    });
    return items;
  }
  template <typename Edit>
  recording::RecordingReader made(const Edit& edit) const {
    RecordingOutput output(path("made"), true);
    recording::RecordingWriter writer(output.sink(), {});
    const auto done = edit(writer);
    EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().to_string());
    writer.finish();
    output.commit();
    return opened(path("made"));
  }

  const KindRow row_ = GetParam();
};

TEST_P(ItemKind, HasItsPlaceAndANameThatIsFoundAgain) {
  EXPECT_EQ(&recording::kind_rows()[static_cast<std::size_t>(row_.kind)],
            &recording::row_of(row_.kind));
  EXPECT_EQ(recording::row_of(row_.kind).kind, row_.kind);
  const Topic topic{row_.kind, row_.scope == Scope::recording ? 0u : 17u,
                    row_.scope == Scope::view ? 65'535u : 0u};
  const std::string name = recording::name_of({topic});
  EXPECT_EQ(recording::channel_named(name), recording::ChannelKind{topic});
  EXPECT_FALSE(recording::channel_named("radar/x/" + name));
  EXPECT_FALSE(recording::channel_named(name + "/"));
  EXPECT_EQ(recording::schema_name({topic}), row_.message().GetDescriptor()->full_name());
}

TEST_P(ItemKind, IsInTheDocument) {
  std::ifstream file(SKERRY_SOURCE_DIR "/protocol/RECORDING.md");
  std::stringstream text;
  text << file.rdbuf();
  std::string topic(row_.topic);
  if (row_.scope == Scope::view) topic = "radar/N/view/V/" + topic;
  if (row_.scope == Scope::radar) topic = "radar/N/" + topic;
  EXPECT_NE(text.str().find("| `" + topic + "` | " + row_.message().GetDescriptor()->full_name()),
            std::string::npos);
}

TEST_P(ItemKind, ComesBackAndIsInTheInfo) {
  const auto reader = recorded("a");
  std::size_t found = 0;
  for (const TimedBytes& item : items(reader)) {
    if (item.time == kBegin) continue;
    const int second = static_cast<int>((item.time - kBegin) / seconds(1));
    EXPECT_EQ(std::string(item.bytes.begin(), item.bytes.end()),
              message(second)->SerializeAsString());
    ++found;
  }
  EXPECT_EQ(found, 3u);
  const std::string title(row_.title);
  EXPECT_NE(info_text(reader, {}).find(" " + title), std::string::npos);
  bool told = false;
  const auto info = nlohmann::json::parse(info_json(reader, {}));
  for (const auto& each : info.at("items")) {
    told = told || each.at("kind") == title;
  }
  EXPECT_TRUE(told);
}

TEST_P(ItemKind, IsCutByItsRule) {
  const auto source = recorded("a");
  const UtcTime from = kBegin + seconds(2);
  const auto got = made([&](recording::RecordingWriter& writer) {
    return cut_recording(source, from, kBegin + seconds(5), writer);
  });
  const std::vector<TimedBytes> kept = items(got);
  if (row_.edit == EditRule::copied) {
    ASSERT_EQ(kept.size(), 1u);
  } else if (row_.edit == EditRule::once) {
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_EQ(kept[0].time, from);
    return;
  } else {  // one from before, at the part's begin
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_EQ(kept[0].time, from);
    EXPECT_EQ(kept[0].bytes, items(source)[0].bytes);
  }
  EXPECT_EQ(kept.back(), items(source)[1]);
}

TEST_P(ItemKind, IsJoinedByItsRule) {
  std::vector<recording::RecordingReader> sources;
  sources.push_back(recorded("a"));
  sources.push_back(recorded("b"));
  const auto got =
      made([&](recording::RecordingWriter& writer) { return join_recordings(sources, writer); });
  const std::vector<TimedBytes> kept = items(got);
  if (row_.edit == EditRule::once) {
    EXPECT_EQ(kept.size(), 1u);
    return;
  }
  if (row_.edit == EditRule::cumulated) {
    EXPECT_EQ(kept, items(sources[0]));
    return;
  }
  // The radar of the second source is 1 now, wherever it is named.
  ASSERT_EQ(kept.size(), 6u);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::uint32_t number = i % 2;
    std::unique_ptr<Message> message(row_.message().New());
    ASSERT_TRUE(
        message->ParseFromArray(kept[i].bytes.data(), static_cast<int>(kept[i].bytes.size())));
    std::multiset<std::uint32_t> radars;
    collect_radars(*message, radars);
    EXPECT_EQ(radars.count(number), radars.size());
    if (row_.scope == Scope::recording) continue;
    EXPECT_EQ(kept[i].topic.radar, number);
    EXPECT_FALSE(radars.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ItemKind, testing::ValuesIn(recording::kind_rows()),
                         [](const auto& of) { return std::string(of.param.topic); });

}  // namespace
}  // namespace skerry::client
