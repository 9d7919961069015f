#include "server/net/http/web_answer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

constexpr std::array<WebFile, 3> kConsoleFiles = {{
    {"/index.html", "text/html; charset=utf-8", "<p>console</p>"},
    {"/js/ppi.js", "text/javascript; charset=utf-8", "draw();"},
    {"/conning.html", "text/html; charset=utf-8", "<p>wheel</p>"},
}};

// A directory with a console in it and a secret beside it.
class WebRoot : public testing::Test {
 protected:
  WebRoot() {
    std::string pattern = (fs::temp_directory_path() / "web_root_XXXXXX").string();
    base_ = ::mkdtemp(pattern.data());
    fs::create_directories(base_ / "www" / "sub");
    write(base_ / "secret.txt", "secret");
    write(base_ / "www" / "index.html", "own console");
    write(base_ / "www" / "sub" / "a.js", "a();");
    fs::create_directory(base_ / "www-other");
    write(base_ / "www-other" / "b.txt", "other");
    fs::create_symlink(base_ / "secret.txt", base_ / "www" / "link.txt");
    fs::create_symlink(base_ / "www-other", base_ / "www" / "linked");
  }
  ~WebRoot() override { fs::remove_all(base_); }
  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

  fs::path base_;
};

TEST(WebFiles, TheBuiltInConsoleIsServedByExactPath) {
  const WebFiles files(kConsoleFiles, "");
  EXPECT_EQ(files.get("/").body, "<p>console</p>");
  EXPECT_EQ(files.get("/index.html?x=1").body, "<p>console</p>");
  EXPECT_EQ(files.get("/js/ppi.js").mime, "text/javascript; charset=utf-8");
  EXPECT_EQ(files.get("/js/ppi.js").body, "draw();");
  EXPECT_EQ(files.get("/js").status, 404u);
  EXPECT_EQ(files.get("/other").status, 404u);
}

TEST(WebFiles, APageIsServedByItsNameToo) {
  const WebFiles files(kConsoleFiles, "");
  for (const char* target : {"/conning", "/conning.html", "/conning?radar=1", "/%63onning"}) {
    const WebAnswer answer = files.get(target);
    EXPECT_EQ(answer.status, 200u) << target;
    EXPECT_EQ(answer.body, "<p>wheel</p>");
    EXPECT_EQ(answer.mime, "text/html; charset=utf-8");
  }
  const WebAnswer folder = files.get("/conning/?radar=1&x=/#top");
  EXPECT_EQ(folder.status, 302u);
  EXPECT_EQ(folder.location, "../conning?radar=1&x=/");
  EXPECT_EQ(files.get("/conning/").location, "../conning");
  EXPECT_EQ(files.get("/index").body, "<p>console</p>");
  for (const char* target : {"/js/ppi", "/conning.html/x", "/conning/x", "/con/", "/con"}) {
    EXPECT_EQ(files.get(target).status, 404u) << target;
  }
}

TEST(WebFiles, PathsThatAreNotCleanAreRefused) {
  for (const char* target : {"",
                             "index.html",
                             "*",
                             "http://localhost/",
                             "/../secret",
                             "/./index.html",
                             "/a/../b",
                             "/%2e%2e/secret.txt",
                             "/%2E%2E%2Fsecret.txt",
                             "/..%2fsecret.txt",
                             "//etc/passwd",
                             "/a//b",
                             "/a\\..\\b",
                             "/%5c..%5cb",
                             "/%00",
                             "/index.html%00.png",
                             "/%",
                             "/%2",
                             "/%zz",
                             "/%-1",
                             "/a\nb"}) {
    EXPECT_EQ(clean_path(target), "") << target;
  }
  EXPECT_EQ(clean_path("/a%20b/c.js?d=/../e"), "/a b/c.js");
  EXPECT_EQ(clean_path("/..."), "/...");
}

TEST_F(WebRoot, FilesInTheDirectoryAreServed) {
  const WebFiles files(kConsoleFiles, (base_ / "www").string());
  EXPECT_EQ(files.get("/").body, "own console");
  EXPECT_EQ(files.get("/sub/a.js").body, "a();");
  EXPECT_EQ(files.get("/sub/a.js").mime, "text/javascript; charset=utf-8");
  EXPECT_EQ(files.get("/js/ppi.js").status, 404u) << "not from the built-in console";
  EXPECT_EQ(files.get("/sub").status, 404u);
}

TEST_F(WebRoot, NothingOutsideTheDirectoryIsServed) {
  const WebFiles files({}, (base_ / "www").string());
  for (const char* target : {"/../secret.txt", "/%2e%2e/secret.txt", "/sub/../../secret.txt",
                             "/link.txt", "/linked/b.txt", "/../www-other/b.txt"}) {
    const WebAnswer answer = files.get(target);
    EXPECT_NE(answer.status, 200u) << target;
    EXPECT_EQ(answer.body.find("secret\n"), std::string::npos);
  }
}

TEST_F(WebRoot, ADirectoryThatIsNotThereIsAnErrorAtTheStart) {
  EXPECT_THROW(WebFiles({}, (base_ / "missing").string()), std::runtime_error);
  EXPECT_THROW(WebFiles({}, (base_ / "secret.txt").string()), std::runtime_error);
}

}  // namespace
}  // namespace skerry::server
