// The manual that is installed, and the documentation of the C++ interface.
#include <gtest/gtest.h>

#include <regex>

#include "tests/install/shell.hpp"

namespace casimir::test {
namespace {

TEST(Manual, EveryPageIsCleanAndNamesEveryOption) {
  const Installed installed;
  const std::string commands = shell(installed, "prefix/bin/casimir complete ''\n").out;
  std::istringstream lines(commands);
  std::size_t pages = 0;
  for (std::string line; std::getline(lines, line); ++pages) {
    const std::string name = line.substr(0, line.find('\t'));
    const std::string page = "prefix/share/man/man1/casimir-" + name + ".1";
    const Outcome checked = shell(
        installed, "mandoc -T lint -W warning " + page + "\nman --warnings -E UTF-8 -l -Tutf8 -Z " +
                       page + " >/dev/null\nMANWIDTH=500 man -l " + page + " | col -b >page\n");
    EXPECT_EQ(checked.status, 0) << page;
    EXPECT_EQ(checked.out + checked.err, "") << page;
    const std::string shown = file_text(installed / "page");
    const std::string help = shell(installed, "prefix/bin/casimir " + name + " --help\n").out;
    static const std::regex kOption(R"(\n  (?:-\w,)?(--[\w-]+))");
    for (std::sregex_iterator it(help.begin(), help.end(), kOption), end; it != end; ++it)
      EXPECT_TRUE(shows(shown, (*it)[1].str())) << page << ' ' << (*it)[1].str();
  }
  EXPECT_GE(pages, 15U);
  const Outcome main = shell(installed, "man -M prefix/share/man casimir | col -b\n");
  EXPECT_EQ(main.status, 0) << main.err;
  for (const char* part : {"EXIT STATUS", "CASIMIR_CASES", "casimir-verify(1)"})
    EXPECT_TRUE(shows(main.out, part)) << main.out;
}

TEST(Manual, OfCaseFilesIsCleanAndNamesEveryKey) {
  const Installed installed;
  const std::string page = "prefix/share/man/man5/casimir-case.5";
  const Outcome checked = shell(
      installed, "mandoc -T lint -W warning " + page + "\nman --warnings -E UTF-8 -l -Tutf8 -Z " +
                     page + " >/dev/null\nMANWIDTH=500 man -l " + page + " | col -b >page\n");
  EXPECT_EQ(checked.status, 0);
  EXPECT_EQ(checked.out + checked.err, "");
  const std::string shown = file_text(installed / "page");
  // The keys that the reader allows, as its source has them.
  const std::string reader = file_text(CASIMIR_SOURCE_DIR "/symbolic/case/case_tables.cpp") +
                             file_text(CASIMIR_SOURCE_DIR "/symbolic/case/toml_keys.cpp");
  static const std::regex kList(R"((?:allow\([^;{]*|keys = )\{([^}]*)\})");
  static const std::regex kKey("\"([a-zA-Z_]+)\"");
  std::size_t keys = 0;
  for (std::sregex_iterator list(reader.begin(), reader.end(), kList), end; list != end; ++list) {
    const std::string names = (*list)[1].str();
    for (std::sregex_iterator it(names.begin(), names.end(), kKey); it != end; ++it, ++keys)
      EXPECT_TRUE(shows(shown, (*it)[1].str())) << (*it)[1].str();
  }
  EXPECT_GE(keys, 60U);
}

/// Types and functions need a comment, and every comment has to be one that Doxygen understands.
/// Members of structs may be said by their names.
TEST(Documentation, EveryTypeAndFunctionOfTheInterfaceIsDocumented) {
  const Folder folder;
  const Outcome outcome =
      shell(folder, "(cat '" CASIMIR_BUILD_DIR
                    "/tools/packaging/Doxyfile.doc'; echo OUTPUT_DIRECTORY=\"$PWD/doc\"; "
                    "echo WARN_LOGFILE=\"$PWD/warnings\"; "
                    "echo EXTRACT_ALL=NO) >Doxyfile\n"
                    "cd '" CASIMIR_SOURCE_DIR "'\ndoxygen \"$HOME/Doxyfile\"\n");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream warnings(file_text(folder / "warnings"));
  for (std::string line; std::getline(warnings, line);)
    EXPECT_TRUE(shows(line, " (variable) of struct ")) << line;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "doc/html/structcasimir_1_1Proof.html"));
  EXPECT_TRUE(shows(file_text(folder / "doc/html/index.html"), "find_package"));
}

}  // namespace
}  // namespace casimir::test
