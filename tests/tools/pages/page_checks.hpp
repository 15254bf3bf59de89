#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace casimir::test {

/// What is wrong with the nesting of the elements, or empty. Not by a regular expression: the paths
/// of a picture are longer than the stack of one.
inline std::string nesting_problem(const std::string& page) {
  static const std::set<std::string> kEmpty{"meta", "br", "hr", "img", "input", "link"};
  std::vector<std::string> open;
  for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const std::size_t end = page.find('>', at);
    if (end == std::string::npos) return "< without >";
    const bool closes = page[at + 1] == '/';
    const std::size_t begin = at + (closes ? 2 : 1);
    if (std::isalpha(static_cast<unsigned char>(page[begin])) == 0) continue;
    const std::string name =
        page.substr(begin, std::min(page.find_first_of(" \t\n/>", begin), end) - begin);
    if (kEmpty.contains(name) || page[end - 1] == '/') continue;
    if (!closes) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is open";
}

/// A page that needs nothing but itself: no address to load from, no script but its own, which
/// makes no code of text, no identifier twice.
inline void expect_self_contained(const std::string& page) {
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(nesting_problem(page), "");
  const std::regex kLoads(R"((src|href|action|data)\s*=\s*["']?\s*(https?:|//|file:))");
  EXPECT_FALSE(std::regex_search(page, kLoads));
  for (const char* bad : {"<script src", "<iframe", "<img", "@import", "url(http", "onload=",
                          "eval(", "new Function", "innerHTML", "document.write", "onclick="})
    EXPECT_EQ(page.find(bad), std::string::npos) << bad;
  const std::regex kId(R"(\sid\s*=\s*["']([^"']*)["'])");
  std::set<std::string> ids;
  for (std::sregex_iterator it(page.begin(), page.end(), kId), end; it != end; ++it)
    EXPECT_TRUE(ids.insert((*it)[1]).second) << (*it)[1];
  // Every reference inside the page leads somewhere.
  const std::regex kReference(R"(href\s*=\s*["']#([^"']*)["'])");
  for (std::sregex_iterator it(page.begin(), page.end(), kReference), end; it != end; ++it)
    EXPECT_TRUE(ids.contains((*it)[1])) << (*it)[1];
}

}  // namespace casimir::test
