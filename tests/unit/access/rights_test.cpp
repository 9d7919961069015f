// Every message, field, route and Signal K path against the one table of rights.
#include "server/access/rights.hpp"

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "server/access/asked.hpp"

namespace skerry::server {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

const std::vector<Role> kAllRoles = {access::OBSERVER, access::TRAINEE, access::ASSESSOR,
                                     access::INSTRUCTOR, access::ADMIN};

const Descriptor& client_message() { return *wire::ClientMessage::descriptor(); }

std::vector<const FieldDescriptor*> kinds() {
  const auto* kind = client_message().FindOneofByName("kind");
  std::vector<const FieldDescriptor*> all;
  for (int i = 0; i < kind->field_count(); ++i) all.push_back(kind->field(i));
  return all;
}

// A value that is not the field's default.
void give(Message& message, const FieldDescriptor& field) {
  const auto* reflection = message.GetReflection();
  const bool many = field.is_repeated();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      many ? reflection->AddMessage(&message, &field)
           : reflection->MutableMessage(&message, &field);
      break;
    case FieldDescriptor::CPPTYPE_STRING:
      many ? reflection->AddString(&message, &field, "x")
           : reflection->SetString(&message, &field, "x");
      break;
    case FieldDescriptor::CPPTYPE_BOOL:
      reflection->SetBool(&message, &field, true);
      break;
    case FieldDescriptor::CPPTYPE_DOUBLE:
      reflection->SetDouble(&message, &field, 1);
      break;
    case FieldDescriptor::CPPTYPE_UINT32:
      many ? reflection->AddUInt32(&message, &field, 1)
           : reflection->SetUInt32(&message, &field, 1);
      break;
    case FieldDescriptor::CPPTYPE_UINT64:
      reflection->SetUInt64(&message, &field, 1);
      break;
    case FieldDescriptor::CPPTYPE_INT64:
      reflection->SetInt64(&message, &field, 1);
      break;
    case FieldDescriptor::CPPTYPE_INT32:
      reflection->SetInt32(&message, &field, 1);
      break;
    case FieldDescriptor::CPPTYPE_FLOAT:
      reflection->SetFloat(&message, &field, 1);
      break;
    case FieldDescriptor::CPPTYPE_ENUM:
      reflection->SetEnumValue(&message, &field, 1);
      break;
    default:
      FAIL() << "a type that this test does not know yet: " << field.full_name();
  }
}

// Whoever sends `field` of the message `kind`, and nothing else.
wire::ClientMessage message_with(const FieldDescriptor& kind, const FieldDescriptor* field) {
  wire::ClientMessage message;
  Message& inner = *message.GetReflection()->MutableMessage(&message, &kind);
  if (field != nullptr) give(inner, *field);
  return message;
}

bool may(Role role, const wire::ClientMessage& message) {
  const Who who{role, {}, {}, {}};
  for (const std::string& right : asked_by(message).rights) {
    if (why_not(who, right)) return false;
  }
  return true;
}

TEST(Rights, EveryMessageAndFieldHasARow) {
  int messages = 0, fields = 0;
  for (const FieldDescriptor* kind : kinds()) {
    ++messages;
    for (int i = -1; i < kind->message_type()->field_count(); ++i) {
      const FieldDescriptor* field = i < 0 ? nullptr : kind->message_type()->field(i);
      fields += field != nullptr;
      const Asked asked = asked_by(message_with(*kind, field));
      EXPECT_THAT(asked.rights, Not(IsEmpty())) << kind->name();
      for (const std::string& right : asked.rights) {
        EXPECT_NE(right_of(right), nullptr)
            << right << ": a new message or field needs a row in server/access/rights_table.cpp";
      }
    }
  }
  std::printf("%d messages with %d fields have their rows\n", messages, fields);
}

TEST(Rights, EveryRowIsOfSomethingThatIsThere) {
  const std::set<std::string_view> of_the_web = {
      "GET /",          "GET /controls.json", "GET /ws",       "GET /status",
      "GET /metrics",   "signalk.discover",   "signalk.read",  "signalk.stream",
      "signalk.change", "GET /setups",        "PUT /setups",   "DELETE /setups",
      "GET /login",     "POST /login",        "DELETE /login", "GET /audit"};
  std::set<std::string_view> names;
  for (const Right& right : rights()) {
    EXPECT_TRUE(names.insert(right.name).second) << right.name << " stands there twice";
    EXPECT_EQ(right.scope == Scope::open, right.roles == 0) << right.name;
    EXPECT_THAT(right.does, Not(IsEmpty()));
    if (of_the_web.count(right.name) != 0) continue;
    const auto dot = right.name.find('.');
    ASSERT_NE(dot, std::string_view::npos) << right.name;
    const auto* kind = client_message().FindFieldByName(std::string(right.name.substr(0, dot)));
    ASSERT_NE(kind, nullptr) << right.name;
    const std::string field(right.name.substr(dot + 1));
    if (field == "*" || right.name == "board_access.write") continue;
    EXPECT_NE(kind->message_type()->FindFieldByName(field), nullptr) << right.name;
  }
  for (const std::string_view name : of_the_web) EXPECT_EQ(names.count(name), 1u) << name;
}

TEST(Rights, WhatHasNoRowIsRefusedToEverybody) {
  for (const char* name : {"", "set", "set.new_thing", "new_message", "GET /new", "signalk"}) {
    for (const Role role : kAllRoles) {
      EXPECT_THAT(why_not({role, {}, {}, {}}, name).value_or(""), HasSubstr("no rule")) << name;
    }
  }
}

// Written down once more, so that a slip in the table is seen.
TEST(Rights, OfEachRoleAreAsTheyAreMeant) {
  std::map<Role, std::set<std::string>> refused;
  for (const FieldDescriptor* kind : kinds()) {
    for (int i = 0; i < kind->message_type()->field_count(); ++i) {
      const FieldDescriptor* field = kind->message_type()->field(i);
      const wire::ClientMessage message = message_with(*kind, field);
      for (const Role role : kAllRoles) {
        if (!may(role, message)) refused[role].insert(kind->name() + "." + field->name());
      }
    }
  }
  EXPECT_THAT(refused[access::ADMIN], IsEmpty());
  EXPECT_THAT(refused[access::INSTRUCTOR], IsEmpty());
  std::set<std::string> of_trainee;
  for (const std::string& each : refused[access::TRAINEE]) {
    const std::string kind = each.substr(0, each.find('.'));
    of_trainee.insert(kind == "set" || kind == "subscribe" ? each : kind);
  }
  EXPECT_THAT(of_trainee,
              UnorderedElementsAre("subscribe.exercise_hz", "set.world", "set.exercise", "set.lock",
                                   "set.unlock", "set.instructor", "record", "playback",
                                   "class_order", "board_fifo", "board_ring"));
  for (const Role looker : {access::OBSERVER, access::ASSESSOR}) {
    for (const FieldDescriptor* kind : kinds()) {
      const std::string name = kind->name();
      const bool changes = name == "set" || name == "target_order" || name == "record" ||
                           name == "playback" || name == "class_order" || name == "board_fifo" ||
                           name == "board_ring";
      for (int i = 0; i < kind->message_type()->field_count(); ++i) {
        const std::string each = name + "." + kind->message_type()->field(i)->name();
        EXPECT_TRUE(!changes || refused[looker].count(each) == 1u) << each;
      }
    }
    EXPECT_EQ(refused[looker].count("subscribe.new_view"), 1u);
    EXPECT_EQ(refused[looker].count("subscribe.radar"), 0u);
  }
  EXPECT_EQ(refused[access::OBSERVER].count("subscribe.exercise_hz"), 1u);
  EXPECT_EQ(refused[access::ASSESSOR].count("subscribe.exercise_hz"), 0u);
  EXPECT_EQ(refused[access::OBSERVER].count("board_stream.kind"), 1u);
}

TEST(Rights, WhoeverIsOfAShipStaysAboard) {
  const Who trainee{access::TRAINEE, "Frida", "bridge 1", {}};
  EXPECT_FALSE(why_not(trainee, "set.con", "Frida"));
  EXPECT_THAT(*why_not(trainee, "set.con", "Ymer"), HasSubstr("of the ship Frida alone"));
  EXPECT_THAT(*why_not(trainee, "set.con", ""), HasSubstr("Frida")) << "no such radar";
  EXPECT_FALSE(why_not(trainee, "get_status"));
  const Who instructor{access::INSTRUCTOR, "Frida", "mate", {}};
  EXPECT_THAT(*why_not(instructor, "set.world", "Frida"), HasSubstr("of all ships"));
  EXPECT_THAT(*why_not(instructor, "record"), HasSubstr("of all ships"));
  const Who nobody{std::nullopt, {}, {}, "get a token"};
  EXPECT_THAT(*why_not(nobody, "subscribe", "Frida"), HasSubstr("get a token"));
  EXPECT_THAT(*why_not({access::OBSERVER, {}, "wall", {}}, "set.con"),
              HasSubstr("the token wall is of the role observer"))
      << "pages show the field for it when a refusal says 'token'";
  EXPECT_FALSE(why_not(nobody, "GET /")) << "the pages in which she gives her token";
  EXPECT_FALSE(why_not(nobody, "sign_in"));
}

TEST(Rights, BoardsAreWrittenByThoseWhoLeadAlone) {
  wire::ClientMessage message;
  message.mutable_board_access()->add_operations()->set_address(4);
  EXPECT_TRUE(may(access::OBSERVER, message));
  message.mutable_board_access()->add_operations()->set_write(1);
  EXPECT_FALSE(may(access::TRAINEE, message));
  EXPECT_TRUE(may(access::INSTRUCTOR, message));
}

TEST(Rights, ThePageIsTheTable) {
  std::ifstream in(SKERRY_SOURCE_DIR "/server/access/RIGHTS.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(page, rights_page()) << "`skerry token rights > server/access/RIGHTS.md` makes it anew";
}

}  // namespace
}  // namespace skerry::server
