// `skerry recording verify`: the video of a recorded exercise, made again by the server's own code.
#include <memory>
#include <string>
#include <vector>

#include "clients/cli/recording/recording_command.hpp"
#include "clients/cli/recording/server_child.hpp"

namespace skerry::client {

Command make_recording_verify_command(CLI::App& recording) {
  auto* command = recording.add_subcommand(
      "verify", "make the video of a recorded exercise again from its inputs, and compare");
  struct Options {
    std::string file, video;
    std::vector<std::string> charts;
    std::string elevation;
  };
  auto options = std::make_shared<Options>();
  command->add_option("file", options->file, "recording of skerryd's own radars")->required();
  command->add_option("--video", options->video, "write the video made again to this recording");
  command->add_option("--chart", options->charts,
                      "where the exercise's charts lie now, in their order");
  command->add_option("--elevation", options->elevation, "where its heights lie now");
  command->footer(R"(Examples:
  skerry recording verify exercise.mcap
  skerry recording verify inputs.mcap --video exercise.mcap   video of an inputs-only recording

Compares spokes byte by byte, or the hashes that an inputs-only recording has of them.  Exit code:
0 identical, or nothing to compare and --video written; 1 different, or nothing to compare; 2 it
cannot be made again, or the command line is wrong.)");
  return {command, [options]() -> int {
            std::vector<std::string> arguments{"--verify", options->file};
            if (!options->video.empty()) {
              arguments.insert(arguments.end(), {"--video", options->video});
            }
            for (const std::string& chart : options->charts) {
              arguments.insert(arguments.end(), {"--chart", chart});
            }
            if (!options->elevation.empty()) {
              arguments.insert(arguments.end(), {"--elevation", options->elevation});
            }
            become_server(std::move(arguments));
          }};
}

}  // namespace skerry::client
