// Reads every source file of the project and holds it against the include law.
#include "tests/architecture/include_law.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

namespace skerry::architecture {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::filesystem::path kRoot = SKERRY_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(IncludeLaw, IsKeptByEveryFile) {
  std::vector<Breach> breaches;
  for (const std::string& file : source_files(kRoot)) {
    const auto found = breaches_of(file, text_of(kRoot / file));
    breaches.insert(breaches.end(), found.begin(), found.end());
  }
  EXPECT_TRUE(breaches.empty()) << listed(breaches);
}

// A test of an empty folder would pass.
TEST(IncludeLaw, ReadsTheWholeTree) {
  const auto files = source_files(kRoot);
  EXPECT_THAT(files, Contains("protocol/quantity/bearing.hpp"));
  EXPECT_THAT(files, Contains("protocol/wire/radar.proto"));
  EXPECT_THAT(files, Contains("echo/spoke_renderer.hpp"));
  EXPECT_THAT(files, Contains("server/app/version.hpp.in"));
  EXPECT_THAT(files, Contains("clients/web/src/main.js"));
  EXPECT_THAT(files, Contains("tests/architecture/include_law_test.cpp"));
}

TEST(IncludeLaw, HasNoRowForAFolderThatIsGone) {
  const auto files = source_files(kRoot);
  for (const std::string& room : rooms()) {
    EXPECT_TRUE(std::any_of(files.begin(), files.end(), [&](const std::string& file) {
      return file.starts_with(room + "/");
    })) << room;
  }
}

struct Case {
  std::string name, path, text;
  std::size_t line = 0;   // of the breach
  std::string says = {};  // part of what is said of it
};

std::string name_of(const testing::TestParamInfo<Case>& info) { return info.param.name; }

std::string header(const std::string& code) { return "// What it is.\n#pragma once\n" + code; }

class Breaking : public testing::TestWithParam<Case> {};

TEST_P(Breaking, IsFoundWithItsLineAndItsRule) {
  const auto found = breaches_of(GetParam().path, GetParam().text);
  ASSERT_THAT(found, SizeIs(1)) << listed(found);
  EXPECT_EQ(found[0].file, GetParam().path);
  EXPECT_EQ(found[0].line, GetParam().line);
  EXPECT_THAT(found[0].text, HasSubstr(GetParam().says));
  EXPECT_THAT(listed(found),
              HasSubstr(GetParam().path + ":" + std::to_string(GetParam().line) + ": "));
}

INSTANTIATE_TEST_SUITE_P(
    IncludeLaw, Breaking,
    testing::Values(
        Case{"ProtocolUsesEcho", "protocol/wire/made_up.cpp",
             "#include <span>\n#include \"echo/kernel/hash.hpp\"\n", 2,
             "includes echo/kernel/hash.hpp; protocol/wire may include"},
        Case{"WireUsesAsterix", "protocol/wire/made_up.cpp",
             "#include \"protocol/asterix/cat240.hpp\"\n", 1, "protocol/wire may include"},
        Case{"AsterixUsesMoreOfWireThanItMay", "protocol/asterix/made_up.cpp",
             "#include \"protocol/wire/frame.hpp\"\n", 1, "protocol/wire/byte_order.hpp"},
        Case{"KernelUsesVideo", "echo/kernel/made_up.hpp",
             header("#include \"protocol/video/spoke.hpp\"\n"), 3, "echo/kernel may include"},
        Case{"SceneUsesReturns", "echo/scene/made_up.hpp",
             header("#include \"echo/radar/beam.hpp\"\n"), 3, "echo/scene may include"},
        Case{"ReceiverUsesTheDoor", "echo/receiver/made_up.cpp",
             "#include \"echo/spoke_renderer.hpp\"\n", 1, "echo/receiver may include"},
        Case{"EchoUsesServer", "echo/made_up.cpp", "#include \"server/core/latest.hpp\"\n", 1,
             "echo may include"},
        Case{"NetUsesRadar", "server/net/made_up.cpp", "#include \"server/radar/radar_unit.hpp\"\n",
             1, "server/net may include"},
        Case{"NetUsesEcho", "server/net/made_up.cpp", "  #  include \"echo/spoke_renderer.hpp\"\n",
             1, "server/net may include"},
        Case{"ConfigUsesWorld", "server/config/made_up.cpp",
             "#include \"server/world/world.hpp\"\n", 1, "server/config may include"},
        Case{"ClientUsesEcho", "clients/common/made_up.cpp",
             "#include \"echo/kernel/exact_math.hpp\"\n", 1, "clients/common may include"},
        Case{"ClientUsesServer", "clients/cli/made_up.cpp",
             "#include \"server/net/common/encoders.hpp\"\n", 1, "clients/cli may include"},
        Case{"InnerFolderHasALawOfItsOwn", "server/net/outputs/made_up.cpp",
             "#include \"server/net/http/web_answer.hpp\"\n", 1, "server/net/outputs may include"},
        Case{"CodeUsesTests", "server/app/made_up.cpp", "#include \"tests/scenes/scenes.hpp\"\n", 1,
             "server/app may include"},
        Case{"AngledIncludesCountToo", "clients/cli/made_up.cpp",
             "#include <server/net/common/encoders.hpp>\n", 1, "clients/cli may include"},
        Case{"ProtoImportsHigher", "protocol/wire/made_up.proto",
             "syntax = \"proto3\";\nimport \"server/app/config.proto\";\n", 2,
             "protocol/wire may include"},
        Case{"ANewFolder", "server/orchestra/made_up.cpp", "int orchestra;\n", 1,
             "server/orchestra has no row in the layer table"},
        Case{"RelativePath", "server/net/made_up.cpp", "#include \"encoders.hpp\"\n", 1,
             "from the repository's root"},
        Case{"AsioElsewhere", "server/net/made_up.cpp", "#include <boost/asio/post.hpp>\n", 1,
             "only server/net/common/asio.hpp and clients/common/asio.hpp may"},
        Case{"GeographicLibElsewhere", "server/radar/made_up.cpp",
             "#include <GeographicLib/Geodesic.hpp>\n", 1, "only echo/chart/ and server/world/"},
        Case{"NetcdfElsewhere", "server/app/made_up.cpp", "#include <netcdf.h>\n", 1,
             "only echo/chart/ may"},
        Case{"GoogleTestInCode", "echo/scene/made_up.cpp", "#include <gtest/gtest.h>\n", 1,
             "only tests may"},
        Case{"LibraryInTheVocabulary", "protocol/quantity/made_up.hpp",
             header("#include <fmt/format.h>\n"), 3, "the standard library alone"},
        Case{"Views", "server/core/made_up.cpp",
             "#include <ranges>\nauto even = numbers | std::views::filter(is_even);\n", 2,
             "uses views::"},
        Case{"SourceLocation", "clients/cli/made_up.cpp", "void log(std::source_location at);\n", 1,
             "uses source_location"},
        Case{"ClockInTheEcho", "echo/scene/made_up.cpp",
             "const auto now = std::chrono::steady_clock::now();\n", 1, "time is passed in"},
        Case{"NoPragmaOnce", "server/core/made_up.hpp", "#ifndef A\n#define A\n#endif\n", 1,
             "no #pragma once"},
        Case{"NoPragmaOnceInATestHeader", "tests/unit/core/made_up.hpp", "int a;\n", 1,
             "no #pragma once"},
        Case{"TooLong", "server/net/made_up.cpp", std::string(401, '\n'), 401, "401 lines"},
        Case{"TooLongATest", "tests/unit/net/made_up_test.cpp", std::string(601, '\n'), 601,
             "601 lines"}),
    name_of);

class Keeping : public testing::TestWithParam<Case> {};

TEST_P(Keeping, IsLeftAlone) {
  const auto found = breaches_of(GetParam().path, GetParam().text);
  EXPECT_THAT(found, IsEmpty()) << listed(found);
}

INSTANTIATE_TEST_SUITE_P(
    IncludeLaw, Keeping,
    testing::Values(
        Case{"OwnRoom", "server/net/common/made_up.cpp",
             "#include \"server/net/common/encoders.hpp\"\n"},
        Case{"LowerRoom", "server/radar/made_up.cpp", "#include \"echo/spoke_renderer.hpp\"\n"},
        Case{"AppUsesTheWholeServer", "server/app/made_up.cpp",
             "#include \"server/net/net_server.hpp\"\n#include \"server/radar/radar_unit.hpp\"\n"},
        Case{"AsioInItsPlace", "server/net/common/asio.hpp",
             header("#include <boost/asio/post.hpp>\n")},
        Case{"CommentsAreNoCode", "echo/scene/made_up.cpp",
             "// Not std::views::filter, which clang 14 cannot parse.\n"},
        Case{"ClockInTheServer", "server/radar/made_up.cpp",
             "const auto now = std::chrono::steady_clock::now();\n"},
        Case{"TestsIncludeAnything", "tests/unit/net/made_up_test.cpp",
             "#include <boost/asio.hpp>\n#include \"echo/kernel/hash.hpp\"\n"},
        Case{"JustShortEnough", "server/net/made_up.cpp", std::string(400, '\n')},
        Case{"ProtoImportsLower", "server/app/made_up.proto",
             "import \"protocol/wire/field_rules.proto\";\n"
             "import \"google/protobuf/descriptor.proto\";\n"}),
    name_of);

}  // namespace
}  // namespace skerry::architecture
