// The schema of controls, read by reflection: what a control is called, what it may hold, and where
// a message carries it.  Everything takes the schema as an argument, so that tests can bring one.
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/wire/field_rules.pb.h"

namespace skerry::wire {

using google::protobuf::Descriptor;
using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

const config::FieldRule& rule_of(const FieldDescriptor& field);
const config::Control& control_of(const FieldDescriptor& field);

// "10 to 60 turns/min", "4, 8 per cell", "at least 2 m"; empty if the rule bounds nothing.
std::string allowed_by(const config::FieldRule& rule);

// The field's name without its unit, as people say it: "swell height", or its rule's name.
std::string spoken_name(const FieldDescriptor& field);
// The name of a Set field that a command line uses: "swell-height".
std::string option_name(const FieldDescriptor& field);
// A value of an enumeration, as people write it: "short" of PULSE_SHORT.
std::string word_of(const EnumValueDescriptor& value);
// Of a number; "?" if the enumeration has none such.
std::string word_of(const google::protobuf::EnumDescriptor& type, int number);
std::string label_of(const EnumValueDescriptor& value);        // "Short"
std::string short_label_of(const EnumValueDescriptor& value);  // as the console's panel has it
// nullptr if the enumeration has no such word.
const EnumValueDescriptor* value_named(const FieldDescriptor& field, std::string_view word);

// All fields of a schema such as Controls, in their order.
std::vector<const FieldDescriptor*> fields_of(const Descriptor& schema);
// The switch that makes `control` automatic; nullptr if there is none.
const FieldDescriptor* automatic_of(const FieldDescriptor& control);

// Where a message carries a field of a schema: in its own field of that name (or, negated, of the
// opposite's name), or in one inside its field whose type is the schema.
struct FieldPlace {
  const FieldDescriptor* outer =
      nullptr;  // of the schema's type; nullptr: the field is the message's own
  const FieldDescriptor* field = nullptr;
  bool negated = false;
};
// Nothing if the message has no place for it.
std::optional<FieldPlace> place_of(const Descriptor& message, const FieldDescriptor& control);

// A number, switch (0 or 1) or choice (its number) as the message has it.  Nothing if it is absent
// or the message has no place for it.  Requires a control that is no message.
std::optional<double> value_of(const Message& message, const FieldDescriptor& control);
// No effect if the message has no place for it.
void put_value(Message& message, const FieldDescriptor& control, double value);

// "on", "PULSE_SHORT", "12.5": the value as a log tells it.
std::string value_text(const FieldDescriptor& control, double value);

// Whether a control may hold the value: false for NaN and for what its rule or enumeration lacks.
bool is_allowed(const FieldDescriptor& control, double value);

}  // namespace skerry::wire
