// nmea_day: a day of five ships as their instruments tell it, sentence by sentence beside the
// truth; programs written by others then read the day (compare.py).  Fails where a field is further
// from the truth than half a unit of its last digit, or a sentence comes out of its turn.
#include <fmt/format.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <random>

#include "tests/system/nmea_day/day_log.hpp"
#include "tests/system/nmea_day/voyages.hpp"

namespace skerry::system_test {
namespace {

constexpr int kScenes = 12;  // in the shortest day
constexpr double kLongestScene_s = 600.0;

// The whole of it, as fast as it goes.
void sail(const Voyage& voyage, double minutes, const std::string& folder) {
  const auto begin = std::chrono::steady_clock::now();
  const double scene_s = std::min(kLongestScene_s, 60.0 * minutes / kScenes);
  server::World world(voyage.scenario);
  std::mt19937 random(11);
  DayLog log(folder, voyage.name, world);
  const Duration length = seconds_as_duration(60.0 * minutes);
  const Duration scene_length = seconds_as_duration(scene_s);
  // Midnight is a tick.
  const UtcTime start =
      UtcTime(voyage.midnight) - length / 2 / server::World::kTick * server::World::kTick;
  int scene = 0;
  for (Duration now{}; now <= length; now += server::World::kTick) {
    if (now >= scene * scene_length) voyage.scene(world, scene++, random);
    log.write(world, start + now);
    world.step();
  }
  log.close();
  const auto size = [&](const char* kind) {
    return static_cast<double>(std::filesystem::file_size(folder + "/" + voyage.name + kind)) / 1e6;
  };
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  fmt::print(
      "{}: {} lines, {:.1f} MB in {:.1f} s; compressed {:.1f} MB of log, {:.1f} MB of truth\n",
      voyage.name, log.lines(), static_cast<double>(log.bytes()) / 1e6, took.count(),
      size(".nmea.gz"), size(".truth.gz"));
  std::fflush(stdout);
}

int run(double minutes, const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::string names;
  for (const Voyage& voyage : voyages()) {
    sail(voyage, minutes, folder);
    names += " " + voyage.name;
  }
  const std::string command =
      fmt::format("/usr/bin/python3 -B '{}/tests/system/nmea_day/compare.py' '{}'{}",
                  SKERRY_SOURCE_DIR, folder, names);
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace
}  // namespace skerry::system_test

int main(int argc, char** argv) {
  CLI::App app{"A day of five ships as their instruments tell it, compared with the truth."};
  double minutes = 1440.0;
  std::string folder = "nmea_day";
  app.add_option("--minutes", minutes, "Of the exercise; midnight is in the middle")
      ->check(CLI::Range(2.0, 10000.0))
      ->capture_default_str();
  app.add_option("--folder", folder, "Where the logs go")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return skerry::system_test::run(minutes, folder);
  } catch (const std::exception& error) {
    fmt::print(stderr, "nmea_day: {}\n", error.what());
    return 1;
  }
}
