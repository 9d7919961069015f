#include "server/access/token_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/config/config_error.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kDigest(64, 'a');
const UtcTime kEnds{std::chrono::seconds(1'800'000'000)};

std::string error_of(const std::string& text) {
  try {
    TokenFile::parse(text, "tokens.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(TokenFile, ReadsWhatItWrites) {
  TokenFile file;
  file.add({"bridge \"1\" \\ \u00c5", access::TRAINEE, "Sj\u00f8: #1", kDigest, kEnds});
  file.add({"wall", access::OBSERVER, "", digest_of("x"), std::nullopt});
  file.add({"relay", access::OBSERVER, "", "", std::nullopt, std::string(64, 'b')});
  const TokenFile read = TokenFile::parse(file.text(), "tokens.yaml");
  EXPECT_EQ(read.tokens()[0].name, "bridge \"1\" \\ \u00c5");
  EXPECT_EQ(read.tokens()[0].role, access::TRAINEE);
  EXPECT_EQ(read.tokens()[0].ship, "Sj\u00f8: #1");
  EXPECT_EQ(read.tokens()[0].sha256, kDigest);
  EXPECT_EQ(read.tokens()[0].ends, kEnds);
  EXPECT_EQ(read.tokens()[1].ends, std::nullopt);
  EXPECT_EQ(read.tokens()[1].certificate, "");
  ASSERT_EQ(read.tokens().size(), 3u);
  EXPECT_EQ(read.tokens()[2].sha256, "");
  EXPECT_EQ(read.tokens()[2].certificate, std::string(64, 'b'));
  EXPECT_TRUE(TokenFile::parse(TokenFile().text(), "").tokens().empty());
}

TEST(TokenFile, AsManyAsThereMayBeAreRead) {
  TokenFile file;
  for (std::size_t i = 0; i < TokenFile::kMost; ++i) {
    file.add({"bridge " + std::to_string(i), access::TRAINEE, "Frida", kDigest, kEnds});
  }
  EXPECT_THROW(file.add({"one more", access::TRAINEE, "", kDigest, {}}), std::invalid_argument);
  EXPECT_EQ(TokenFile::parse(file.text(), "").tokens().size(), TokenFile::kMost);
}

TEST(TokenFile, ErrorsNameTheLineAndWhatIsExpected) {
  EXPECT_THAT(error_of("tokens:\n  - name: a\n    sha256: xyz\n"), HasSubstr("tokens.yaml:3:13"));
  EXPECT_THAT(error_of("tokens:\n  - name: a\n    sha256: xyz\n"), HasSubstr("64 hexadecimal"));
  EXPECT_THAT(error_of("tokens:\n  - sha256: " + kDigest + "\n"), HasSubstr("name"));
  EXPECT_THAT(error_of("tokens:\n  - name: a\n    role: king\n    sha256: " + kDigest + "\n"),
              HasSubstr("instructor"));
  EXPECT_THAT(error_of("tokens:\n  - name: a\n    ends: soon\n    sha256: " + kDigest + "\n"),
              HasSubstr("UTC as 2027"));
  const std::string one = "  - name: a\n    sha256: " + kDigest + "\n";
  EXPECT_THAT(error_of("tokens:\n" + one + one), HasSubstr("earlier token"));
  EXPECT_THAT(error_of("token: []\n"), HasSubstr("tokens"));
  const std::string certificate = "    certificate: " + kDigest + "\n";
  EXPECT_EQ(error_of("tokens:\n  - name: a\n" + certificate), "");
  EXPECT_THAT(error_of("tokens:\n  - name: a\n"), HasSubstr("tokens.yaml:2:"));
  EXPECT_THAT(error_of("tokens:\n  - name: a\n"), HasSubstr("one of sha256"));
  const std::string both = error_of("tokens:\n" + one + certificate);
  EXPECT_THAT(both, HasSubstr("tokens.yaml:4:"));
  EXPECT_THAT(both, HasSubstr("tokens[0].certificate: expected: one of sha256"));
  const std::string wrong = error_of("tokens:\n  - name: a\n    certificate: AB:CD\n");
  EXPECT_THAT(wrong, HasSubstr("tokens.yaml:3:18: tokens[0].certificate: is no SHA-256"));
  EXPECT_THAT(error_of("tokens:\n  - name: a\n" + certificate + "  - name: b\n" + certificate),
              HasSubstr("tokens.yaml:5:18: tokens[1].certificate: is that of an earlier entry"));
}

TEST(TokenFile, FindsATokenByItsTextWhileItHolds) {
  TokenFile file;
  file.add({"a", access::OBSERVER, "", digest_of("skerry_A"), kEnds});
  EXPECT_EQ(file.find("skerry_A", kEnds - Duration(1)).state, TokenState::good);
  EXPECT_EQ(file.find("skerry_A", kEnds).state, TokenState::ended);
  EXPECT_EQ(file.find("skerry_B", kEnds - Duration(1)).state, TokenState::unknown);
  EXPECT_EQ(file.find("", kEnds - Duration(1)).state, TokenState::unknown);
  EXPECT_EQ(file.find(digest_of("skerry_A"), kEnds - Duration(1)).state, TokenState::unknown)
      << "what stands in the file opens nothing";
}

TEST(TokenFile, FindsACertificateByItsDigestAndByNothingElse) {
  TokenFile file;
  file.add({"relay", access::OBSERVER, "", "", kEnds, kDigest});
  file.add({"a", access::OBSERVER, "", digest_of("skerry_A"), {}});
  const UtcTime before = kEnds - Duration(1);
  const auto found = file.find_certificate(kDigest, before);
  ASSERT_EQ(found.state, TokenState::good);
  EXPECT_EQ(found.token->name, "relay");
  EXPECT_EQ(file.find_certificate(kDigest, kEnds).state, TokenState::ended);
  EXPECT_EQ(file.find_certificate("", before).state, TokenState::unknown);
  EXPECT_EQ(file.find_certificate(digest_of("skerry_A"), before).state, TokenState::unknown)
      << "a token's digest is no certificate's";
  for (const std::string& text : {kDigest, std::string("relay"), std::string()}) {
    EXPECT_EQ(file.find(text, before).state, TokenState::unknown) << text;
  }
}

TEST(TokenFile, AnEntryIsOfOneTokenOrOneCertificateOfNobodyElse) {
  TokenFile file;
  file.add({"relay", access::OBSERVER, "", "", {}, kDigest});
  EXPECT_THROW(file.add({"b", access::OBSERVER, "", "", {}, kDigest}), std::invalid_argument);
  EXPECT_THROW(file.add({"c", access::OBSERVER, "", "", {}, ""}), std::invalid_argument);
  EXPECT_THROW(file.add({"d", access::OBSERVER, "", kDigest, {}, std::string(64, 'b')}),
               std::invalid_argument);
  EXPECT_TRUE(file.remove("relay"));
  file.add({"b", access::OBSERVER, "", "", {}, kDigest});
}

TEST(TokenFile, RefusesNamesThatAreTakenOrNoNames) {
  TokenFile file;
  file.add({"a", access::OBSERVER, "", kDigest, {}});
  for (const std::string& name : {std::string("a"), std::string(), std::string(65, 'x'),
                                  std::string("line\nbreak"), std::string("\xff")}) {
    EXPECT_THROW(file.add({name, access::OBSERVER, "", kDigest, {}}), std::invalid_argument)
        << name;
  }
  EXPECT_FALSE(file.remove("b"));
  EXPECT_TRUE(file.remove("a"));
}

TEST(Token, HasTwoHundredAndFiftySixBitsAndIsNeverTheSame) {
  std::set<std::string> made;
  for (int i = 0; i < 1000; ++i) made.insert(make_token());
  EXPECT_EQ(made.size(), 1000u);
  for (const std::string& token : made) {
    ASSERT_EQ(token.size(), std::string("skerry_").size() + 43);
    ASSERT_EQ(
        token.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"),
        std::string::npos);
  }
}

TEST(ChangeTokens, OfManyAtOnceAreAllThereAndTheFileIsItsOwnersAlone) {
  std::string pattern = testing::TempDir() + "skerry-tokens-XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  const std::filesystem::path file = folder / "tokens.yaml";
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&file, i] {
      change_tokens(file, [i](TokenFile& tokens) {
        tokens.add({"t" + std::to_string(i), access::OBSERVER, "", kDigest, {}});
      });
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(TokenFile::read(file).tokens().size(), 8u);
  struct stat found {};
  ASSERT_EQ(::stat(file.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777, 0600u);
  EXPECT_THROW(change_tokens(file, [](TokenFile&) { throw std::invalid_argument("no"); }),
               std::invalid_argument);
  EXPECT_EQ(TokenFile::read(file).tokens().size(), 8u);
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace skerry::server
