#include "tests/system/running_server.hpp"

#include <gtest/gtest.h>

#include <exception>

namespace skerry::system_test {

RunningServer::~RunningServer() {
  if (stopped()) return;
  try {
    const Ending ending = stop();
    if (ending.code != 0) {
      ADD_FAILURE() << "skerryd ended with exit code " << ending.code << ":\n" << ending.err;
    }
  } catch (const std::exception& error) {
    ADD_FAILURE() << "skerryd did not stop: " << error.what();
  }
}

Ending RunningServer::skerry(const std::string& command,
                             const std::vector<std::string>& arguments) const {
  std::vector<std::string> all = {skerry_program(), command, "--port", std::to_string(tcp_port())};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run(std::move(all));
}

}  // namespace skerry::system_test
