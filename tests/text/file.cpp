// SPDX-License-Identifier: MIT
#include "diabolo/text/file.hpp"

#include <sys/resource.h>

#include <csignal>

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

TEST_CASE("Files are written whole and read back") {
  const test::TemporaryFolder folder;
  FilesToWrite files;
  files.add(folder / "a.csv", std::string_view("a\0b", 3));
  files.add(folder / "b.csv", "");
  CHECK(!std::filesystem::exists(folder / "a.csv"));
  files.commit();
  CHECK(read_file(folder / "a.csv") == std::string("a\0b", 3));
  CHECK(read_file(folder / "b.csv").empty());
  CHECK(folder.entries() == 2);
}

TEST_CASE("Without commit nothing is left, and what was there stays") {
  const test::TemporaryFolder folder;
  {
    FilesToWrite files;
    files.add(folder / "a.csv", "old");
    files.commit();
  }
  {
    FilesToWrite files;
    files.add(folder / "a.csv", "new");
    files.add(folder / "b.csv", "new");
  }
  CHECK(read_file(folder / "a.csv") == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("What a link leads to is written, and the link stays") {
  const test::TemporaryFolder folder;
  const std::filesystem::path link = folder / "link", second = folder / "second", loop = folder / "loop";
  std::filesystem::create_symlink("file", link);  // there is no such file yet
  std::filesystem::create_symlink(link, second);
  std::filesystem::create_symlink("loop", loop);
  for (const auto& [path, text] : {std::pair{link, "one"}, {second, "two"}}) {
    FilesToWrite files;
    files.add(path, text);
    files.commit();
    CHECK(std::filesystem::is_symlink(path));
    CHECK(read_file(folder / "file") == text);
  }
  CHECK(complaint([&] { FilesToWrite().add(loop, "x"); }) ==
        loop.string() + ": a symbolic link that leads to itself; expected a file");
  CHECK(folder.entries() == 4);
}

TEST_CASE("What cannot be read or written is named") {
  const test::TemporaryFolder folder;
  const std::string missing = (folder / "missing.csv").string(), here = (folder / "").string();
  CHECK(complaint([&] { read_file(missing); }) == missing + ": there is no such file");
  CHECK(complaint([&] { read_file(here); }) == here + ": a directory; expected a file");
  CHECK(complaint([&] { read_file("/dev/zero"); }) == "/dev/zero: a device or a pipe; expected a file");
  CHECK(complaint([&] { FilesToWrite().add(here, "x"); }) == here + ": a directory; expected a file");
  CHECK(complaint([&] { FilesToWrite().add("/dev/null", "x"); }) ==
        "/dev/null: a device or a pipe; expected a file");
  const std::string nowhere = (folder / "nowhere/a.csv").string();
  CHECK(complaint([&] { FilesToWrite().add(nowhere, "x"); }) ==
        nowhere + ": the file cannot be written there: No such file or directory");
  const std::string endless = (folder / std::string(300, 'a')).string();
  CHECK(complaint([&] { read_file(endless); }) ==
        endless + ": the file cannot be reached: File name too long");
  CHECK(folder.entries() == 0);
}

TEST_CASE("A disk that fills up is noticed and leaves nothing behind") {
  const test::TemporaryFolder folder;
  rlimit usual{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &usual) == 0);
  const rlimit tight{1000, usual.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &tight) == 0);
  const std::string path = (folder / "a.csv").string();
  const std::string said = complaint([&] { FilesToWrite().add(path, std::string(100'000, 'x')); });
  REQUIRE(setrlimit(RLIMIT_FSIZE, &usual) == 0);
  CHECK(said == path + ": the file cannot be written (is the disk full?)");
  CHECK(folder.entries() == 0);
}
