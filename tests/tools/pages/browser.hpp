#pragma once

#include <regex>
#include <string>
#include <vector>

#include "tests/tools/program.hpp"

namespace casimir::test {

/// How a page is looked at.
struct View {
  int width = 1200, height = 900;
  bool dark = false;
};

/// What a browser says of a page.
struct Seen {
  nlohmann::ordered_json found;      ///< by the script below
  std::vector<std::string> console;  ///< everything that was written there
};

/// Whether there is a browser, which tools/test installs: the tests that need one fail otherwise.
inline bool has_browser() { return std::string(CASIMIR_BROWSER).find('/') != std::string::npos; }

/// Measures a page that has been loaded, and writes what it finds into it. Stands only in copies.
inline constexpr const char* kProbe = R"js(
addEventListener('load', () => {
  const luminance = colour => {
    const c = colour.match(/[\d.]+/g).slice(0, 3).map(x => x / 255)
      .map(x => x <= 0.03928 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  };
  const paper = luminance(getComputedStyle(document.body).backgroundColor);
  const contrast = colour => {
    const [a, b] = [luminance(colour), paper].sort((x, y) => y - x);
    return (a + 0.05) / (b + 0.05);
  };
  const least = list => list.length ? Math.min(...list) : null;
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const curve = svg => all('path', svg).filter(p => p.getAttribute('stroke')?.includes('--plot-') &&
    !/grid|guide|ink|paper/.test(p.getAttribute('stroke')));
  const found = {
    width: document.documentElement.scrollWidth,
    inner: innerWidth,
    requests: performance.getEntriesByType('resource').map(e => e.name).filter(n => !n.startsWith('blob:')),
    scripts: document.scripts.length,
    math: all('math').filter(m => m.getBoundingClientRect().width > 0).length,
    untypeset: all('math').filter(m => m.textContent.includes('\\')).map(m => m.textContent),
    plots: Object.fromEntries(all('figure').map(f => [f.id, {
      points: curve(f).reduce((n, p) => n + (p.getAttribute('d').match(/[ML]/gi) || []).length, 0) +
        all('use', f).length,
      width: f.querySelector('svg').getBoundingClientRect().width,
      contrast: least([...curve(f).map(p => contrast(getComputedStyle(p).stroke)),
        ...all('use[color]', f).map(p => contrast(getComputedStyle(p).color))]),
      words: least(all('text', f).map(t => contrast(getComputedStyle(t).fill)))}])),
    broken: all('a[href^="#"]').map(a => a.getAttribute('href').slice(1))
      .filter(id => !document.getElementById(id)),
    links: all('a[href]').map(a => a.getAttribute('href')),
    contrast: least(all('p, li, td, th, dt, dd, h1, h2, h3, figcaption')
      .map(e => contrast(getComputedStyle(e).color)))
  };
  const result = document.createElement('pre');
  result.id = 'probe';
  result.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(found))));
  document.body.append(result);
});
)js";

inline std::string from_base64(const std::string& text) {
  std::string result;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) continue;
    bits = bits << 6 | static_cast<unsigned>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    result += static_cast<char>(bits >> count & 0xFF);
  }
  return result;
}

/// Loads a copy of the page in a browser without a window; the network leads nowhere.
inline Seen look(const std::string& page, const View& view = {}) {
  const Folder folder;
  std::string copy = page;
  copy.insert(copy.rfind("</body>"), std::string("<script>") + kProbe + "</script>");
  folder.write("page.html", copy);
  std::vector<std::string> words{
      CASIMIR_BROWSER,
      "--headless",
      "--no-sandbox",
      "--disable-gpu",
      "--user-data-dir=" + folder / "profile",
      "--enable-logging=stderr",
      "--host-resolver-rules=MAP * ~NOTFOUND",
      "--window-size=" + std::to_string(view.width) + "," + std::to_string(view.height),
      "--blink-settings=preferredColorScheme=" + std::string(view.dark ? "0" : "1"),
      "--virtual-time-budget=4000",
      "--dump-dom",
      "file://" + folder / "page.html"};
  std::string command;
  for (const std::string& word : words) command += "'" + word + "' ";
  command += "> '" + folder / "dom" + "' 2> '" + folder / "log" + "'";
  Seen seen;
  if (std::system(command.c_str()) != 0) return seen;
  const std::string dom = file_text(folder.path() / "dom");
  const std::string mark = "<pre id=\"probe\">";
  if (const std::size_t at = dom.find(mark); at != std::string::npos) {
    const std::size_t begin = at + mark.size();
    seen.found =
        nlohmann::ordered_json::parse(from_base64(dom.substr(begin, dom.find('<', begin) - begin)));
  }
  std::istringstream log(file_text(folder.path() / "log"));
  for (std::string line; std::getline(log, line);)
    if (line.find("CONSOLE") != std::string::npos) seen.console.push_back(line);
  return seen;
}

}  // namespace casimir::test
