// Messages and exit codes of skerryd and skerry when they are started wrongly.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/scenes/ten_errors.hpp"
#include "tests/system/running_server.hpp"

namespace skerry::system_test {
namespace {

using testing::AllOfArray;
using testing::HasSubstr;

// The message holds all of these.
testing::Matcher<std::string> says(const std::vector<std::string>& parts) {
  std::vector<testing::Matcher<std::string>> all;
  for (const std::string& part : parts) all.push_back(HasSubstr(part));
  return AllOfArray(all);
}

// skerryd must end by itself with exit code 2, one line of message and nothing on standard output.
void expect_refused(std::vector<std::string> arguments, const std::vector<std::string>& parts) {
  arguments.insert(arguments.begin(), skerryd_program());
  const Ending ending = run(std::move(arguments));
  EXPECT_EQ(ending.code, 2) << ending.err;
  EXPECT_EQ(ending.out, "");
  EXPECT_THAT(ending.err, says(parts));
}

struct BadFile {
  const char* what;
  std::string text;
  std::vector<std::string> message;  // besides the file's name
};

// A scenario whose third own-ship line, 6, is the one given.
std::string with_ship_line(const std::string& line) {
  return "name: Bad\nown_ships:\n  - name: Tern\n    position: {lat: 60, lon: 5}\n"
         "    speed_kn: 5\n" +
         line + "\n";
}

TEST(BadFiles, AWrongScenarioIsNamedByFileLineColumnKeyValueAndRange) {
  const std::vector<BadFile> cases = {
      {"latitude",
       "name: Bad\nown_ships:\n  - name: Tern\n    position: {lat: 95, lon: 5}\n",
       {":4:21:", "own_ships[0].position.lat", "95", "-90 to 90 deg"}},
      {"course",
       with_ship_line("    course_deg: 361"),
       {":6:17:", "own_ships[0].course_deg", "361", "0 to 360"}},
      {"rpm",
       with_ship_line("    radars: [{rpm: 75}]"),
       {":6:20:", "own_ships[0].radars[0].rpm", "75", "10 to 60 turns/min"}},
      {"spokes",
       with_ship_line("    radars: [{spokes: 100}]"),
       {":6:23:", "own_ships[0].radars[0].spokes", "100", "256 to 8192"}},
      {"bits",
       with_ship_line("    radars: [{bits: 6}]"),
       {":6:21:", "own_ships[0].radars[0].bits", "6", "4, 8"}},
      {"range scale",
       with_ship_line("    radars: [{range_nm: 5}]"),
       {":6:25:", "own_ships[0].radars[0].range_nm", "5", "0.125, 0.25", "96 NM"}},
      {"a word for a number",
       with_ship_line("    length_m: long"),
       {":6:15:", "own_ships[0].length_m", "long", "number"}},
      {"unknown key",
       with_ship_line("    lenght_m: 90"),
       {":6:5:", "own_ships[0].lenght_m", "unknown key", "length_m"}},
      {"missing key",
       "name: Bad\nown_ships:\n  - position: {lat: 60, lon: 5}\n",
       {":3:", "own_ships[0]", "name"}},
      {"the same key twice", with_ship_line("    speed_kn: 6"), {":6:5:", "speed_kn"}},
      {"two ships of one name",
       with_ship_line("  - name: Tern\n    position: {lat: 60, lon: 5}"),
       {":6:11:", "own_ships[1].name", "Tern"}},
      {"no YAML", "name: [Bad\n", {":1:1:", "YAML"}},
      {"nothing", "", {":1:1:", "nothing"}},
      {"a list", "- 1\n", {":1:1:"}},
  };
  const TempFolder folder;
  for (const BadFile& bad : cases) {
    SCOPED_TRACE(bad.what);
    std::vector<std::string> message = bad.message;
    message.push_back(folder.path("bad.yaml") + ":");
    expect_refused({"--scenario", folder.write("bad.yaml", bad.text)}, message);
  }
}

TEST(BadFiles, AllThatIsWrongWithAScenarioIsSaidAtOnceInTheOrderOfTheText) {
  const TempFolder folder;
  const std::string file = folder.write("bad.yaml", scenes::kTenErrors);
  const Ending ending = run({skerryd_program(), "--scenario", file});
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(ending.out, "");
  std::istringstream lines(ending.err);
  std::string line;
  for (const char* const found : scenes::kTenErrorsFound) {
    ASSERT_TRUE(std::getline(lines, line)) << found;
    EXPECT_THAT(line, testing::StartsWith("skerryd: " + file + found));
  }
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, "skerryd: " + file + ": 10 errors");
  EXPECT_FALSE(std::getline(lines, line)) << line;
  EXPECT_EQ(run({skerryd_program(), "--scenario", file}).err, ending.err) << "the order is stable";
}

TEST(BadFiles, AWrongConfigurationIsNamedTheSameWay) {
  const std::vector<BadFile> cases = {
      {"port", "tcp_port: 70000\n", {":1:11:", "tcp_port", "70000", "0 to 65535"}},
      {"unknown key", "tcp_prt: 7000\n", {":1:1:", "tcp_prt", "unknown key", "tcp_port"}},
      {"destination",
       "udp:\n  - {address: 127.0.0.1, port: 0}\n",
       {":2:32:", "udp[0].port", "0", "1 to 65535"}},
      {"no address", "cat240:\n  - {port: 8600}\n", {":2:", "cat240[0]", "address"}},
      {"workers", "workers: 65\n", {":1:10:", "workers", "65", "0 to 64"}},
  };
  const TempFolder folder;
  for (const BadFile& bad : cases) {
    SCOPED_TRACE(bad.what);
    std::vector<std::string> message = bad.message;
    message.push_back(folder.path("bad.yaml") + ":");
    expect_refused({"--config", folder.write("bad.yaml", bad.text)}, message);
  }
}

TEST(BadFiles, AllThatIsWrongWithAConfigurationIsSaidAtOnce) {
  const TempFolder folder;
  const std::string file =
      folder.write("bad.yaml",
                   "tcp_prt: 7000\nworkers: 65\noutputs:\n  - {kind: native, compressed: true}\n"
                   "  - {kind: navico_4g, radar_b: 1}\n  - {kind: navico_4f}\n");
  expect_refused({"--config", file},
                 {file + ":1:1: tcp_prt: unknown key", file + ":2:10: workers: 65",
                  file + ":4:5: outputs[0]: native: 'compressed' is not a key of this kind",
                  file + ":5:5: outputs[1]: navico_4g: ", "add dual_range: true",
                  file + ":6:12: outputs[2].kind: expected one of", file + ": 5 errors"});
}

TEST(BadFiles, AFileThatIsNotThereIsNamed) {
  const TempFolder folder;
  const std::string missing = folder.path("missing.yaml");
  expect_refused({"--scenario", missing}, {missing, "No such file"});
  expect_refused({"--config", missing}, {missing, "No such file"});
  expect_refused({"--scenario", folder.path("")}, {folder.path("")});
}

TEST(BadFiles, WithoutAChartTheMessageNamesThePackage) {
  const TempFolder folder;
  for (const std::string& chart : {folder.path("missing.nc"), folder.path("")}) {
    expect_refused({"--chart", chart}, {chart, "apt-get install gmt-gshhg-full"});
  }
  const std::string garbage = folder.write("garbage.nc", std::string(1000, 'x'));
  expect_refused({"--chart", garbage}, {garbage, "netCDF"});
}

TEST(BadFiles, AnUnknownOrWrongOptionIsNamed) {
  expect_refused({"--bogus"}, {"--bogus", "--help"});
  expect_refused({"--workers", "65"}, {"--workers", "65", "0 to 64"});
  expect_refused({"--tcp-port", "70000"}, {"--tcp-port", "70000"});
  expect_refused({"--udp", "127.0.0.1"}, {"127.0.0.1", "no port", "ADDRESS:PORT"});
  expect_refused(
      {"--no-udp", "--tcp-port", "0", "--http-port", "0", "--cat240", "9@127.0.0.1:8600"},
      {"radar 9", "127.0.0.1", "8600", "no such radar"});
}

// A port of loopback that is taken, and refuses connections unless it listens.
class TakenPort {
 public:
  explicit TakenPort(bool listens) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(socket_, any, size) != 0 || ::getsockname(socket_, any, &size) != 0 ||
        (listens && ::listen(socket_, 1) != 0)) {
      throw std::runtime_error("cannot take a port");
    }
    port_ = std::to_string(ntohs(address.sin_port));
  }
  ~TakenPort() { ::close(socket_); }
  TakenPort(const TakenPort&) = delete;
  TakenPort& operator=(const TakenPort&) = delete;
  const std::string& port() const { return port_; }

 private:
  int socket_;
  std::string port_;
};

TEST(BadFiles, APortInUseIsNamedWithTheOptionThatChangesIt) {
  const TakenPort taken(true);
  expect_refused({"--tcp-port", taken.port(), "--http-port", "0", "--no-udp", "--no-cat240"},
                 {"127.0.0.1", taken.port(), "in use", "--tcp-port"});
  expect_refused({"--http-port", taken.port(), "--tcp-port", "0", "--no-udp", "--no-cat240"},
                 {"127.0.0.1", taken.port(), "in use", "--http-port"});
}

TEST(BadFiles, WithoutAServerTheClientSaysWhereItLookedAndWhatToDo) {
  const TakenPort nobody(false);
  for (const char* command : {"status", "snapshot", "dump", "set"}) {
    SCOPED_TRACE(command);
    std::vector<std::string> arguments = {skerry_program(), command, "--port", nobody.port()};
    if (command == std::string("set")) arguments.insert(arguments.end(), {"--gain", "50"});
    const Ending ending = run(std::move(arguments));
    EXPECT_EQ(ending.code, 1);
    EXPECT_EQ(ending.out, "");
    EXPECT_THAT(ending.err, says({"127.0.0.1:" + nobody.port(), "refused", "skerryd"}));
  }
}

}  // namespace
}  // namespace skerry::system_test
