// mDNS announcements as a browser of services finds them: with a D-Bus and an Avahi of the
// test's own, confined to the loopback interface.
#include <avahi-client/client.h>
#include <avahi-client/lookup.h>
#include <avahi-common/simple-watch.h>
#include <avahi-common/strlst.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/net/signalk/mdns_advertiser.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

// A program whose standard error goes to a file; ended with the object.
class Program {
 public:
  Program(std::vector<std::string> words, const fs::path& log) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    const int file = open(log.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Program() {
    kill(pid_, SIGTERM);
    if (!ended_) waitpid(pid_, nullptr, 0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  bool ended() {
    ended_ = ended_ || waitpid(pid_, nullptr, WNOHANG) == pid_;
    return ended_;
  }

 private:
  pid_t pid_ = -1;
  bool ended_ = false;
};

bool says(const fs::path& log, const std::string& words) {
  std::ifstream file(log);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.find(words) != std::string::npos;
}

// One for all tests: libdbus reads the address of the bus only once in a process.
class Mdns : public testing::Test {
 protected:
  static void SetUpTestSuite() { missing_ = start(); }
  static void TearDownTestSuite() {
    avahi_.reset();
    bus_.reset();
    unsetenv("DBUS_SYSTEM_BUS_ADDRESS");
    if (!folder_.empty()) fs::remove_all(folder_);
  }
  void SetUp() override {
    if (!missing_.empty()) GTEST_SKIP() << missing_;
  }

 private:
  // The program that is missing here; empty if all came up.
  static std::string start() {
    if (geteuid() != 0) return "an Avahi of one's own needs root";
    std::string name = (fs::temp_directory_path() / "skerry_mdns_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) return "no temporary folder";
    folder_ = name;
    const std::string address = "unix:path=" + (folder_ / "bus").string();
    std::ofstream(folder_ / "bus.conf")
        << "<busconfig><type>system</type><listen>" << address << "</listen>"
        << R"(<policy context="default"><allow user="*"/><allow own="*"/>)"
        << R"(<allow send_destination="*"/><allow receive_sender="*"/></policy></busconfig>)";
    std::ofstream(folder_ / "avahi.conf") << "[server]\nhost-name=skerrytest\nuse-ipv6=no\n"
                                             "allow-interfaces=lo\nenable-dbus=yes\n";
    setenv("DBUS_SYSTEM_BUS_ADDRESS", address.c_str(), 1);
    bus_.emplace(std::vector<std::string>{"dbus-daemon", "--nofork", "--print-address",
                                          "--config-file=" + (folder_ / "bus.conf").string()},
                 folder_ / "bus.log");
    if (!comes_up(*bus_, "bus.log", "unix:path=")) return "no dbus-daemon comes up here";
    avahi_.emplace(
        std::vector<std::string>{"avahi-daemon", "--no-chroot", "--no-drop-root", "--no-rlimits",
                                 "-f", (folder_ / "avahi.conf").string()},
        folder_ / "avahi.log");
    if (comes_up(*avahi_, "avahi.log", "Server startup complete")) return {};
    return "no Avahi of the test's own comes up here, perhaps beside the system's";
  }
  static bool comes_up(Program& program, const char* log, const char* words) {
    return wait_until([&] { return says(folder_ / log, words) || program.ended(); }) &&
           says(folder_ / log, words);
  }

  static inline std::string missing_;
  static inline fs::path folder_;
  static inline std::optional<Program> bus_, avahi_;
};

// Looks for services of one type.
class Browser {
 public:
  explicit Browser(const char* type) : poll_(avahi_simple_poll_new()) {
    int error = 0;
    client_ = avahi_client_new(
        avahi_simple_poll_get(poll_), AvahiClientFlags(0),
        [](AvahiClient*, AvahiClientState, void*) {}, nullptr, &error);
    if (client_ == nullptr) throw std::runtime_error("the browser does not find Avahi");
    avahi_service_browser_new(client_, AVAHI_IF_UNSPEC, AVAHI_PROTO_UNSPEC, type, nullptr,
                              AvahiLookupFlags(0), on_browse, this);
  }
  ~Browser() {
    avahi_client_free(client_);
    avahi_simple_poll_free(poll_);
  }
  // Goes on until `done`; false after 30 s.
  bool run(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!done() && std::chrono::steady_clock::now() < end) avahi_simple_poll_iterate(poll_, 100);
    return done();
  }

  std::set<std::string> names;
  std::map<std::string, std::uint16_t> ports;  // by name
  std::map<std::string, std::set<std::string>> texts;

 private:
  static void on_browse(AvahiServiceBrowser* browser, AvahiIfIndex interface,
                        AvahiProtocol protocol, AvahiBrowserEvent event, const char* name,
                        const char* type, const char* domain, AvahiLookupResultFlags, void* self) {
    auto& mine = *static_cast<Browser*>(self);
    if (event == AVAHI_BROWSER_REMOVE) mine.names.erase(name);
    if (event != AVAHI_BROWSER_NEW) return;
    mine.names.insert(name);
    avahi_service_resolver_new(avahi_service_browser_get_client(browser), interface, protocol, name,
                               type, domain, AVAHI_PROTO_UNSPEC, AvahiLookupFlags(0), on_resolve,
                               self);
  }
  static void on_resolve(AvahiServiceResolver* resolver, AvahiIfIndex, AvahiProtocol,
                         AvahiResolverEvent event, const char* name, const char*, const char*,
                         const char*, const AvahiAddress*, std::uint16_t port,
                         AvahiStringList* texts, AvahiLookupResultFlags, void* self) {
    auto& mine = *static_cast<Browser*>(self);
    if (event == AVAHI_RESOLVER_FOUND) {
      mine.ports[name] = port;
      for (; texts != nullptr; texts = avahi_string_list_get_next(texts)) {
        mine.texts[name].emplace(reinterpret_cast<const char*>(avahi_string_list_get_text(texts)),
                                 avahi_string_list_get_size(texts));
      }
    }
    avahi_service_resolver_free(resolver);
  }

  AvahiSimplePoll* poll_;
  AvahiClient* client_ = nullptr;
};

std::vector<MdnsService> services(std::uint16_t port) {
  return {{.type = "_signalk-http._tcp", .port = port, .texts = {"txtvers=1", "swname=skerryd"}},
          {.type = "_mayara-http._tcp", .port = port}};
}

TEST_F(Mdns, ServicesAreFoundUntilTheServerEnds) {
  for (const char* type : {"_signalk-http._tcp", "_mayara-http._tcp"}) {
    Browser browser(type);
    {
      const MdnsAdvertiser advertiser("Skerry on test", "0.0.0.0", services(7480));
      EXPECT_TRUE(browser.run([&] { return browser.ports.contains("Skerry on test"); })) << type;
      EXPECT_EQ(browser.ports["Skerry on test"], 7480);
    }
    EXPECT_TRUE(browser.run([&] { return browser.names.empty(); })) << type;
    if (browser.texts.contains("Skerry on test")) {
      EXPECT_TRUE(browser.texts["Skerry on test"].contains("swname=skerryd"));
    }
  }
}

TEST_F(Mdns, ANameThatAnotherServerHasGetsANumber) {
  Browser browser("_signalk-http._tcp");
  const MdnsAdvertiser first("Skerry on test", "0.0.0.0", services(7480));
  ASSERT_TRUE(browser.run([&] { return browser.ports.contains("Skerry on test"); }));
  const MdnsAdvertiser second("Skerry on test", "0.0.0.0", services(7481));
  EXPECT_TRUE(browser.run([&] { return browser.ports.size() == 2; }));
  EXPECT_EQ(browser.ports["Skerry on test"], 7480);
}

TEST(MdnsWithoutAvahi, LeavesNoThreadBehind) {
  const auto threads = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
  };
  const auto before = threads();
  setenv("DBUS_SYSTEM_BUS_ADDRESS", "unix:path=/nowhere/bus", 1);
  { const MdnsAdvertiser advertiser("Skerry on test", "0.0.0.0", services(7480)); }
  unsetenv("DBUS_SYSTEM_BUS_ADDRESS");
  EXPECT_EQ(threads(), before);
}

}  // namespace
}  // namespace skerry::server
