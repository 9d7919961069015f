// FieldOptions: options of the command line that set fields of a configuration message.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <utility>

namespace skerry::server {

// Options of one group of the help.  Each sets a field of a message, which must outlive the
// parsing, if it is given; so what is not in the message was not said.
class FieldOptions {
 public:
  explicit FieldOptions(CLI::App& cli, std::string group = "Options")
      : cli_(cli), group_(std::move(group)) {}

  // The value is read as a Number, which may be narrower than the field.
  template <class Number, class Message, class Field>
  CLI::Option* number(const std::string& name, Message& message, void (Message::*set)(Field),
                      const std::string& help) {
    const auto put = [&message, set](const Number& value) { (message.*set)(value); };
    return cli_.add_option_function<Number>(name, put, help)->group(group_);
  }
  // An empty text says nothing.
  template <class Message>
  CLI::Option* text(const std::string& name, Message& message, std::string* (Message::*field)(),
                    const std::string& help) {
    const auto put = [&message, field](const std::string& text) {
      if (!text.empty()) *(message.*field)() = text;
    };
    return cli_.add_option_function<std::string>(name, put, help)->group(group_);
  }
  template <class Message>
  CLI::Option* flag(const std::string& name, Message& message, void (Message::*set)(bool),
                    const std::string& help) {
    const auto put = [&message, set](std::int64_t said) { (message.*set)(said > 0); };
    return cli_.add_flag_function(name, put, help)->group(group_);
  }

 private:
  CLI::App& cli_;
  std::string group_;
};

}  // namespace skerry::server
