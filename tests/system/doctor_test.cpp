// skerry doctor on hosts that are set up wrongly: network namespaces made for the test, a server on
// one side of a cable, a display's host on the other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/system/running_server.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr char kIp[] = "/usr/sbin/ip";

bool ip(const Words& words) {
  Words all = {kIp};
  all.insert(all.end(), words.begin(), words.end());
  return run(all).code == 0;
}

// A host with the network it was given, as long as this lives.
class Host {
 public:
  explicit Host(const std::string& name) : name_(name + std::to_string(::getpid())) {
    made_ = ip({"netns", "add", name_}) && in({"link", "set", "lo", "up"});
  }
  ~Host() {
    if (made_) ip({"netns", "del", name_});
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  bool made() const { return made_; }
  const std::string& name() const { return name_; }
  // `ip` there.
  bool in(Words words) const {
    words.insert(words.begin(), {"-n", name_});
    return ip(words);
  }
  Words command(const Words& words) const {
    Words all = {kIp, "netns", "exec", name_};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }

 private:
  std::string name_;
  bool made_ = false;
};

struct Said {
  int code = -1;
  std::string faults, hints, all;
};

class DoctorOnAHost : public testing::Test {
 protected:
  void SetUp() override {
    if (::access(kIp, X_OK) != 0) GTEST_SKIP() << "no ip: apt-get install iproute2";
    if (!ship_.made() || !display_.made()) {
      GTEST_SKIP() << "network namespaces need root: " << run({kIp, "netns", "add", "none"}).err;
    }
    ASSERT_TRUE(ship_.in({"link", "add", "radar0", "type", "veth", "peer", "name", "eth0", "netns",
                          display_.name()}));
    ASSERT_TRUE(ship_.in({"link", "set", "radar0", "up"}));
    ASSERT_TRUE(display_.in({"link", "set", "eth0", "up"}));
    ASSERT_TRUE(display_.in({"addr", "add", "192.0.2.8/24", "dev", "eth0"}));
  }
  void give_address(const std::string& address) {
    ASSERT_TRUE(ship_.in({"addr", "add", address, "dev", "radar0"}));
  }
  void give_route() { ASSERT_TRUE(ship_.in({"route", "add", "224.0.0.0/4", "dev", "radar0"})); }
  // Until it listens.
  std::unique_ptr<ChildProcess> start(const Words& arguments) {
    Words words = {skerryd_program(), "--print-ports", "--no-udp", "--no-cat240"};
    words.insert(words.end(), {"--scenario", folder_.write("small.yaml", small_scenario())});
    words.insert(words.end(), arguments.begin(), arguments.end());
    auto server = std::make_unique<ChildProcess>(ship_.command(words));
    EXPECT_THAT(server->read_line().value_or("nothing"), HasSubstr("tcp"));
    return server;
  }
  Said doctor(const Words& arguments) { return doctor_at(ship_, arguments); }
  static Said doctor_at(const Host& host, const Words& arguments) {
    Words words = {skerry_program(), "doctor", "--json"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Ending ending = run(host.command(words));
    Said said;
    said.code = ending.code;
    said.all = ending.out + ending.err;
    for (const auto& one : nlohmann::json::parse(ending.out)) {
      std::string& to = one.at("grade") == "FAULT" ? said.faults : said.hints;
      if (one.at("grade") == "ok") continue;
      to += one.at("about").get<std::string>() + ": " + one.at("text").get<std::string>() + " -> " +
            one.at("advice").get<std::string>() + "\n";
    }
    return said;
  }

  Host ship_{"ship"}, display_{"display"};
  TempFolder folder_;
};

TEST_F(DoctorOnAHost, FindsNothingWrongWhereNothingIs) {
  give_address("192.0.2.7/24");
  give_route();
  const auto server = start({"--insecure", "--bind", "0.0.0.0", "--output",
                             "navico_halo:interface_address=192.0.2.7,obeys=true"});
  const Said said = doctor({"--display", "192.0.2.8", "--listen", "2"});
  EXPECT_EQ(said.code, 0) << said.all;
  EXPECT_THAT(said.all, HasSubstr("a radar at 192.0.2.7:"));
  // From the display's side as well, where no server is.
  ASSERT_TRUE(display_.in({"route", "add", "224.0.0.0/4", "dev", "eth0"}));
  const Said there = doctor_at(display_, {"--host", "192.0.2.7", "--listen", "2"});
  EXPECT_EQ(there.code, 0) << there.all;
  EXPECT_THAT(there.all, HasSubstr("a radar at 192.0.2.7:"));
}

TEST_F(DoctorOnAHost, FindsThatThereIsNoMulticastRoute) {
  give_address("192.0.2.7/24");
  const Said said = doctor({"navico_4g:interface_address=192.0.2.7", "--listen", "0"});
  EXPECT_EQ(said.code, 1);
  EXPECT_THAT(said.faults, HasSubstr("there is no route for multicast"));
  EXPECT_THAT(said.faults, HasSubstr("ip route add 224.0.0.0/4 dev radar0"));
  // What it advises mends it.
  give_route();
  EXPECT_EQ(doctor({"navico_4g:interface_address=192.0.2.7", "--listen", "0"}).faults, "");
}

TEST_F(DoctorOnAHost, FindsTheWrongInterface) {
  give_address("192.0.2.7/24");
  const Said said = doctor({"navico_halo:interface_address=192.0.2.77", "--listen", "0.1"});
  EXPECT_EQ(said.code, 1);
  EXPECT_THAT(said.faults, HasSubstr("192.0.2.77 is none of this host's"));
  EXPECT_THAT(said.faults, HasSubstr("192.0.2.7 (radar0)"));
  ASSERT_TRUE(ship_.in({"link", "set", "radar0", "down"}));
  EXPECT_THAT(doctor({"navico_halo:interface_address=192.0.2.7", "--listen", "0.1"}).faults,
              HasSubstr("switched off"));
}

TEST_F(DoctorOnAHost, FindsATakenPort) {
  ChildProcess other(
      ship_.command({"/usr/bin/python3", "-c",
                     "import socket, time\n"
                     "s = socket.create_server(('', 7480)); u = socket.socket(socket.AF_INET, "
                     "socket.SOCK_DGRAM)\n"
                     "u.bind(('', 6878)); print('ready', flush=True); time.sleep(60)"}));
  ASSERT_EQ(other.read_line(), "ready");
  give_address("192.0.2.7/24");
  give_route();
  const Said said = doctor({"navico_halo:interface_address=192.0.2.7", "--listen", "0.1"});
  EXPECT_EQ(said.code, 1);
  EXPECT_THAT(said.faults, HasSubstr("port 7480: taken by python3 ("));
  EXPECT_THAT(said.faults, HasSubstr("has UDP port 6878 for itself alone"));
  EXPECT_THAT(said.hints, HasSubstr("refused"));
}

TEST_F(DoctorOnAHost, FindsTwoRadarsOfOneAddress) {
  give_address("192.0.2.7/24");
  give_route();
  const auto server = start({"--insecure", "--bind", "0.0.0.0", "--output",
                             "navico_4g:interface_address=192.0.2.7,obeys=true"});
  const auto second = start({"--tcp-port", "0", "--http-port", "0", "--output",
                             "navico_3g:interface_address=192.0.2.7,obeys=true"});
  const Said said = doctor({});
  EXPECT_EQ(said.code, 1);
  EXPECT_THAT(said.faults, HasSubstr("two radars send to 236.6.7.9:6679"));
  EXPECT_THAT(said.faults, HasSubstr("of one address"));
}

TEST_F(DoctorOnAHost, FindsThatGarminDisplaysLookElsewhere) {
  give_address("192.0.2.7/24");
  give_route();
  const auto server = start({"--insecure", "--bind", "0.0.0.0", "--output",
                             "garmin_xhd:interface_address=192.0.2.7,obeys=true"});
  const Said said = doctor({"--display", "192.0.2.8", "--listen", "2"});
  EXPECT_EQ(said.code, 1);
  EXPECT_THAT(said.faults, HasSubstr("192.0.2.7 is not in 172.16.0.0/12"));
  EXPECT_THAT(said.faults, HasSubstr("172.16.2.1/12"));
}

TEST_F(DoctorOnAHost, FindsThatADisplayElsewhereHearsNothingOfLoopback) {
  give_address("192.0.2.7/24");
  give_route();
  const auto server = start({"--output", "navico_halo"});
  const Said said = doctor({"--display", "192.0.2.8", "--listen", "2"});
  EXPECT_EQ(said.code, 1);
  EXPECT_THAT(said.faults, HasSubstr("sends on loopback (127.0.0.1)"));
  EXPECT_THAT(said.faults, HasSubstr("the server listens on 127.0.0.1 alone"));
}

TEST(Doctor, SaysWhatIsWrongWithTheCommandLine) {
  for (const Words& wrong : {Words{"navico_9g"}, Words{"navico_4g:interface_address=here"},
                             Words{"--display", "there"}, Words{"--listen", "-1"}}) {
    Words words = {skerry_program(), "doctor"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    const Ending ending = run(words);
    EXPECT_EQ(ending.code, 2) << wrong.front();
    EXPECT_THAT(ending.err, HasSubstr(wrong.back().substr(wrong.back().find('=') + 1)));
  }
}

}  // namespace
}  // namespace skerry::system_test
