// Fields of messages on the command line: their help, the words they take, and what a text makes of
// them.  All of it comes from the schema.
#pragma once

#include <string>
#include <vector>

#include "protocol/wire/schema.hpp"

namespace skerry::client {

// Its label, its help, the allowed values and its note: "Rain clutter control, 0 to 100".
std::string help_of(const wire::FieldDescriptor& field);

// "on" and "off" of a switch, the words of a choice; empty for numbers and texts.
std::vector<std::string> words_of(const wire::FieldDescriptor& field);

// Its option's name; with its unit where another field of the message has the same without.
std::string distinct_name(const wire::FieldDescriptor& field);

// Of a number, or of one of words_of().
double number_of(const wire::FieldDescriptor& field, const std::string& text);

// What a message holds in a number, switch, choice or text: "12.5 deg", "on", "early", "Sirius".
std::string text_of(const wire::Message& message, const wire::FieldDescriptor& field);

}  // namespace skerry::client
