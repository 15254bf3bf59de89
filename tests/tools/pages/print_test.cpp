// Pictures for print: their size, their ink, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// Of two numbers that stand after `before` in the text of a file.
std::pair<double, double> size_after(const std::string& text, const std::string& pattern) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(pattern))) return {0, 0};
  return {std::stod(found[1]), std::stod(found[2])};
}

Outcome draw(const Folder& folder, std::vector<std::string> options) {
  options.insert(options.begin(), {"integrate", "euler"});
  return run_in(folder, options);
}

TEST(Print, FiguresHaveTheWidthThatIsAskedFor) {
  const Folder folder;
  for (const char* name : {"f.pdf", "f.svg", "f.png"})
    ASSERT_EQ(draw(folder, {"--plot", name, "--width", "86mm", "--quiet"}).status, 0) << name;
  // In a PDF lengths are points, 72 of an inch; SVG has 96 pixels of an inch; PNG 300.
  const std::string pdf = file_text(folder.path() / "f.pdf");
  EXPECT_TRUE(pdf.starts_with("%PDF"));
  EXPECT_NEAR(size_after(pdf, R"(MediaBox \[ *0 0 ([0-9.]+) ([0-9.]+))").first, 86 / 25.4 * 72, 1);
  const auto svg = size_after(file_text(folder.path() / "f.svg"),
                              "<svg[^>]*width=\"([0-9.]+)\"[^>]*height=\"([0-9.]+)\"");
  EXPECT_NEAR(svg.first, 86 / 25.4 * 96, 1);
  EXPECT_GT(svg.second, svg.first / 2);
  const std::string png = file_text(folder.path() / "f.png");
  ASSERT_GT(png.size(), 24U);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(png[i]); };
  EXPECT_NEAR(256. * byte(18) + byte(19), 86 / 25.4 * 300, 1);
}

/// Whether red, green and blue of every colour in the picture are the same.
bool is_grey(const std::string& svg) {
  const std::regex colour(R"(rgb\( *(\d+), *(\d+), *(\d+)\))");
  for (std::sregex_iterator at(svg.begin(), svg.end(), colour), end; at != end; ++at)
    if ((*at)[1] != (*at)[2] || (*at)[2] != (*at)[3]) return false;
  return true;
}

TEST(Print, MonochromeFiguresHaveNoColour) {
  const Folder folder;
  ASSERT_EQ(draw(folder, {"--plot", "c.svg", "--quiet"}).status, 0);
  ASSERT_EQ(draw(folder, {"--plot", "m.svg", "--monochrome", "--quiet"}).status, 0);
  EXPECT_FALSE(is_grey(file_text(folder.path() / "c.svg")));
  EXPECT_TRUE(is_grey(file_text(folder.path() / "m.svg")));
}

TEST(Print, AStyleIsReadFromAFile) {
  const Folder folder;
  folder.write("paper.toml",
               "width = \"12cm\"\nheight = \"60mm\"\nfont = \"Times\"\nsize = 9\ntitle = false\n");
  ASSERT_EQ(draw(folder, {"--plot", "p.svg", "--style", "paper.toml", "--quiet"}).status, 0);
  const std::string svg = file_text(folder.path() / "p.svg");
  const auto size = size_after(svg, "<svg[^>]*width=\"([0-9.]+)\"[^>]*height=\"([0-9.]+)\"");
  EXPECT_NEAR(size.first, 120 / 25.4 * 96, 1);
  EXPECT_NEAR(size.second, 60 / 25.4 * 96, 1);
  EXPECT_NE(svg.find("Times"), std::string::npos);
  EXPECT_EQ(svg.find("scene default"), std::string::npos);
}

TEST(Print, AxesHavePowersOfTenAndMicroseconds) {
  const Folder folder;
  ASSERT_EQ(run_in(folder, {"bench", "euler", "--method", "taylor,dop853", "--tolerances",
                            "1e-4,1e-9", "--repeat", "1", "--plot", "b.svg", "--quiet"})
                .status,
            0);
  const std::string svg = file_text(folder.path() / "b.svg");
  EXPECT_EQ(svg.find("1e-"), std::string::npos);
  EXPECT_NE(svg.find(">10</tspan>"), std::string::npos);
}

TEST(Print, RefusesWhatItCannotRead) {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& options, const char* words) {
    const Outcome outcome = draw(folder, options);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  };
  refused({"--width", "86mm"}, "name one that ends in .svg, .png, .pdf or .tex");
  refused({"--plot", "p.svg", "--width", "86"}, "such as 86mm");
  refused({"--plot", "p.svg", "--width", "nanmm"}, "expected 20mm to 2m");
  refused({"--plot", "p.svg", "--width", "1mm"}, "expected 20mm to 2m");
  refused({"--plot", "p.svg", "--style", "none.toml"}, "none.toml");
  folder.write("s.toml", "width = \"86mm\"\nmonochrom = true\n");
  refused({"--plot", "p.svg", "--style", "s.toml"},
          "s.toml:2: unknown key 'monochrom'; did you mean 'monochrome'?");
  // A font is a name, not a way out of gnuplot's quotation marks.
  folder.write("s.toml", "font = \"x'; system('touch out'); '\"\n");
  refused({"--plot", "p.svg", "--style", "s.toml"}, "s.toml:1: font");
  folder.write("s.toml", "height = \"86mm\"\n");
  refused({"--plot", "p.svg", "--style", "s.toml"}, "a height needs a width");
  EXPECT_EQ(folder.files(), 1U);
}

}  // namespace
}  // namespace casimir::test
