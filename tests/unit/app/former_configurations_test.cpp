// Configurations of former versions are read by this one (tests/golden/configurations).
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "server/app/config.pb.h"
#include "server/app/options/options.hpp"
#include "server/config/yaml_message.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> former_files() {
  std::vector<std::string> files;
  for (const auto& file : fs::directory_iterator(SKERRY_SOURCE_DIR "/tests/golden/configurations"))
    if (file.path().extension() == ".yaml") files.push_back(file.path().string());
  return files;
}

// "outputs.sac": the keys that a message has, itself or further in.
void note_keys(const google::protobuf::Message& message, const std::string& prefix,
               std::set<std::string>& keys) {
  std::vector<const google::protobuf::FieldDescriptor*> given;
  const auto& reflection = *message.GetReflection();
  reflection.ListFields(message, &given);
  for (const auto* field : given) {
    keys.insert(prefix + field->name());
    if (field->cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE) continue;
    if (!field->is_repeated()) {
      note_keys(reflection.GetMessage(message, field), prefix + field->name() + ".", keys);
      continue;
    }
    for (int i = 0; i < reflection.FieldSize(message, field); ++i) {
      note_keys(reflection.GetRepeatedMessage(message, field, i), prefix + field->name() + ".",
                keys);
    }
  }
}

TEST(FormerConfigurations, AreRead) {
  EXPECT_FALSE(former_files().empty());
  for (const std::string& file : former_files()) {
    const char* const arguments[] = {"skerryd", "--config", file.c_str()};
    try {
      EXPECT_TRUE(read_options(3, arguments)) << file;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

// Of version 0.1.0; a key that goes away is missed by the test above.
TEST(FormerConfigurations, HaveMostKeysThatThereAre) {
  std::set<std::string> keys;
  for (const std::string& file : former_files()) {
    app::ServerConfig config;
    load_yaml(read_yaml_file(file), file, config);
    note_keys(config, "", keys);
  }
  EXPECT_GE(keys.size(), 100u);
  for (const char* key :
       {"outputs.says_simulated", "inputs.simulated", "signalk.further_ships.port",
        "recorder.fsync", "playback.current_timestamps", "users"}) {
    EXPECT_TRUE(keys.count(key)) << key;
  }
}

}  // namespace
}  // namespace skerry::server
