"""Pages of `casimir report` as a browser sees them: what they integrate is what `integrate` says."""

import base64
import hashlib
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from browser import Browser, program

CASIMIR = os.environ["CASIMIR_PROGRAM"]

FUNCTIONS = """
[phase_space]
variables = ["a", "b", "c", "d"]
[parameters]
k = {}
[equations]
a = "cos(b) - a + exp(-c^2)/2 - k*a*abs(b)/5"
b = "sin(a)*cosh(d/4) - b/2 + atan2(a, 2 + b^2) + sin(3*t)"
c = "tanh(a*b) + log(2 + d^2) - c + sqrt(1 + a^2)/3"
d = "asin(c/(2 + c^2)) + acos(a/(2 + a^2)) - d + tan(b/8) + (3 + a^2)^(1/3) - sinh(a)/9"
[[scene]]
name = "default"
parameters = { k = "1" }
initial = { a = "1/2", b = "-1/3", c = "0", d = "1" }
duration = "10"
"""

# One step over it would miss it.
BUMP = """title = "A bump"
[phase_space]
variables = ["x", "y"]
[equations]
x = "exp(-10^4*(x-1)^2) + 1/10"
y = "0"
[[scene]]
name = "default"
initial = { x = "0", y = "1" }
duration = "30"
"""
BLOWS_UP = """
[phase_space]
variables = ["x"]
[parameters]
k = {}
[equations]
x = "k*x^2"
[[scene]]
name = "default"
parameters = { k = "1" }
initial = { x = "1" }
duration = "1/2"
"""

EVIL = r"""
title = "</script><script>console.log('title')</script>"
hamiltonian = "p^2/2 - cos(q)"
[phase_space]
variables = ["q", "p"]
canonical = true
domain = ["3 > p"]
[integrals]
F = "p^2/2 - cos(q)"
[[invariant_relation]]
name = "<img src=x onerror=console.log(1)>"
expression = "p^2/2 - cos(q)"
on = ["p^2/2 - cos(q)"]
[[scene]]
name = "<b>${alert(1)}</b>"
initial = { q = "1", p = "0" }
duration = "3"
"""


def casimir(*arguments, status=0, folder=None):
    done = subprocess.run([CASIMIR, *arguments], capture_output=True, text=True, cwd=folder)
    assert done.returncode == status, done.stderr
    return done.stdout


class LivePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.keep.name)
        cls.kovalevskaya = cls.report("kovalevskaya")

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    @classmethod
    def report(cls, case, *more, status=0):
        page = cls.folder / (pathlib.Path(case).stem + ".html")
        casimir("report", case, "--budget", "0", "--quiet", "--output", str(page), *more, status=status)
        return page

    def case(self, name, text):
        path = self.folder / (name + ".toml")
        path.write_text(text)
        return str(path)

    def end_of(self, browser):
        browser.until("!!document.querySelector('#live-state tr[data-value]')")
        return [float(x) for x in browser.value(
            "[...document.querySelectorAll('#live-state tr[data-value]')].map(row => row.dataset.value)")]

    def type_in(self, browser, name, text):
        browser.value(f"""(() => {{
          document.querySelector('#live-state').remove();
          const input = document.querySelector('input[data-name="{name}"]');
          input.value = '{text}';
          input.dispatchEvent(new Event('change'));
        }})()""")

    def expect_as_integrated(self, browser, *arguments):
        state = json.loads(casimir("integrate", *arguments, "--json"))["state"]
        wanted = [float(x) for x in state.values()]
        size = max(map(abs, wanted))
        for one, other in zip(self.end_of(browser), wanted, strict=True):
            self.assertLessEqual(abs(one - other), 1e-12 * size)

    def expect_quiet(self, browser):
        self.assertEqual(browser.said, [])
        self.assertEqual([r for r in browser.requests[1:] if not r.startswith(("blob:", "data:"))], [])

    def test_its_motion_is_drawn_before_the_page_is_read_to_its_end(self):
        with Browser(slower=4) as browser:
            browser.open(self.kovalevskaya)
            self.assertTrue(browser.value(
                "performance.getEntriesByName('casimir-picture')[0].startTime"
                " < performance.getEntriesByType('navigation')[0].domInteractive"))
            own = "figure:not(#live-motion figure)"
            self.assertGreater(browser.value(f"document.querySelectorAll('{own} svg[data-axes]').length"), 3)
            self.assertEqual(browser.value(f"document.querySelectorAll('{own}:not(.told) > svg[data-axes]').length"), 0)

    def test_its_end_state_is_that_of_the_command_line_and_sliders_are_live(self):
        self.assertLess(self.kovalevskaya.stat().st_size, 400_000)
        with Browser() as browser:
            browser.open(self.kovalevskaya)
            self.expect_as_integrated(browser, "kovalevskaya")
            self.assertRegex(browser.value("document.getElementById('live-words').textContent"),
                             r"^t = 100 in \d+ steps\. 1[1-5] digits")
            self.type_in(browser, "r", "3/2")
            self.assertTrue(browser.value("document.querySelector('input[data-name=r]').classList.contains('wrong')"))
            browser.value("document.body.append(Object.assign(document.createElement('p'), {id: 'live-state'}))")
            self.type_in(browser, "r", "1.5")
            self.expect_as_integrated(browser, "kovalevskaya", "--param", "r=3/2")
            self.type_in(browser, "M1", "0.25")
            self.expect_as_integrated(browser, "kovalevskaya", "--param", "r=3/2", "--initial", "M1=1/4")
            self.assertEqual(browser.value("document.getElementById('live-command').textContent"),
                             "casimir integrate kovalevskaya --param r=1.5 --initial M1=0.25")
            self.expect_quiet(browser)

    def test_it_cuts_orbits_and_a_click_begins_one(self):
        with Browser(390, 800) as browser:
            browser.open(self.kovalevskaya)
            self.end_of(browser)
            browser.value("document.getElementById('section-canvas').scrollIntoView()")
            crossings = browser.until("document.getElementById('section-canvas').dataset.crossings")
            self.assertGreaterEqual(int(crossings), 20 * 200)
            browser.value("""(() => {
              const canvas = document.getElementById('section-canvas'), box = canvas.getBoundingClientRect();
              canvas.dispatchEvent(new MouseEvent('click',
                {clientX: box.left + 0.4 * box.width, clientY: box.top + 0.45 * box.height}));
            })()""")
            words = browser.until("/^1000 crossings/.test(document.getElementById('section-words').textContent)"
                                  " && document.getElementById('section-words').textContent")
            start = dict(re.findall(r"(\w+) = (\S+?)[.,]?(?:\s|$)", words))
            at = {name: float(value.replace("−", "-")) for name, value in start.items()}
            self.assertAlmostEqual(sum(at[g] ** 2 for g in ("g1", "g2", "g3")), 1, places=3)
            self.assertAlmostEqual((at["M1"] ** 2 + at["M2"] ** 2) / 2 + at["M3"] ** 2 - at["g1"], 0.13611, places=3)
            self.assertLessEqual(browser.value("document.documentElement.scrollWidth"), 390)
            self.expect_quiet(browser)

    def test_every_function_has_its_series(self):
        case = self.case("functions", FUNCTIONS.replace("[phase_space]", "[phase_space]\ntime = \"t\""))
        with Browser() as browser:
            browser.open(self.report(case))
            self.expect_as_integrated(browser, case)
            self.type_in(browser, "k", "-0.5")
            self.expect_as_integrated(browser, case, "--param", "k=-1/2")
            self.expect_quiet(browser)

    def test_it_says_where_it_cannot_go_on(self):
        case = self.case("blows-up", BLOWS_UP)
        with Browser() as browser:
            browser.open(self.report(case))
            self.assertAlmostEqual(self.end_of(browser)[0], 2, places=12)
            self.type_in(browser, "k", "4")
            self.end_of(browser)
            words = browser.value("document.getElementById('live-words').textContent")
            self.assertRegex(words, r"^Stopped at t = 0\.2(5|49\d*), before the end")
            self.assertNotIn("believed", words)
            self.expect_quiet(browser)

    def test_it_sees_what_its_own_steps_pass_over(self):
        case = self.case("bump", BUMP)
        with Browser() as browser:
            browser.open(self.report(case))
            self.end_of(browser)
            words = browser.value("document.getElementById('live-words').textContent")
            self.assertRegex(words, r" steps\. [0-2] digits of the largest state stay the same")
            self.expect_quiet(browser)

    def test_it_works_under_a_strict_policy(self):
        text = self.kovalevskaya.read_text()
        script = re.search(r"<script>(.*?)</script>", text, re.S).group(1)
        digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
        policy = (f"default-src 'none'; style-src 'unsafe-inline'; img-src data:; worker-src blob:; "
                  f"script-src 'sha256-{digest}' 'wasm-unsafe-eval'")
        page = self.folder / "strict.html"
        page.write_text(text.replace("<head>", f'<head><meta http-equiv="Content-Security-Policy" content="{policy}">', 1))
        with Browser() as browser:
            browser.open(page)
            self.expect_as_integrated(browser, "kovalevskaya")
            self.expect_quiet(browser)

    def test_what_a_stranger_writes_is_text(self):
        page = self.report(self.case("evil", EVIL), "--scene", "<b>${alert(1)}</b>")
        with Browser() as browser:
            browser.open(page)
            self.end_of(browser)
            self.assertEqual(browser.value("document.querySelectorAll('img, b').length"), 0)
            self.assertEqual(browser.value("document.scripts.length"), 2)
            self.assertIn("<b>${alert(1)}</b>", browser.value("document.getElementById('live').textContent"))
            self.type_in(browser, "p", "4")
            self.end_of(browser)
            self.assertIn("Outside of what the case assumes: 3 > p",
                          browser.value("document.getElementById('live-words').textContent"))
            self.expect_quiet(browser)

    def test_pictures_tell_values_and_zoom(self):
        with Browser() as browser:
            browser.open(self.kovalevskaya)
            found = browser.value("""(() => {
              const figure = document.querySelector('#figure-drift'), svg = figure.querySelector('svg');
              svg.scrollIntoView({block: 'center'});
              const box = svg.getBoundingClientRect();
              const send = (kind, x, y) => svg.dispatchEvent(new PointerEvent(kind, {bubbles: true, pointerId: 1,
                button: 0, pointerType: 'mouse', clientX: box.left + x * box.width, clientY: box.top + y * box.height}));
              svg.setPointerCapture = () => {};
              const tips = [];
              for (let y = 0.05; y < 0.8; y += 0.05) {
                send('pointermove', 0.5, y);
                if (!figure.querySelector('.tip').hidden) tips.push(figure.querySelector('.tip').textContent);
              }
              send('pointerdown', 0.3, 0.2);
              send('pointermove', 0.6, 0.6);
              send('pointerup', 0.6, 0.6);
              const zoomed = !figure.querySelector('.back').hidden && svg.querySelectorAll('text').length;
              figure.querySelector('.back').click();
              return {tips, zoomed, whole: figure.querySelector('.back').hidden};
            })()""")
            self.assertTrue(found["tips"])
            for tip in found["tips"]:
                self.assertRegex(tip, r"^(taylor|dop853|gauss8): [\d.]+, [\d.]+e-\d+$")
            self.assertGreater(found["zoomed"], 5)
            self.assertTrue(found["whole"])
            self.expect_quiet(browser)

    def test_a_section_of_many_points_is_small(self):
        picture = self.folder / "section.svg"
        casimir("section", "kovalevskaya", "--orbits", "20", "--points", "1000", "--quiet", "--output", str(picture))
        self.assertLess(picture.stat().st_size, 250_000)
        with Browser() as browser:
            browser.open(picture)
            self.assertGreater(browser.value("document.querySelectorAll('path[stroke-linecap=round]').length"), 5)
            self.expect_quiet(browser)

    def test_without_a_script_all_else_is_there(self):
        with Browser(390, 800) as browser:
            browser.ask("Emulation.setScriptExecutionDisabled", value=True)
            browser.open(self.kovalevskaya)
            self.assertGreaterEqual(browser.value("document.querySelectorAll('figure svg').length"), 5)
            self.assertEqual(browser.value("document.querySelectorAll('#live').length"), 0)
            self.assertLessEqual(browser.value("document.documentElement.scrollWidth"), 390)


if __name__ == "__main__":
    assert program(), "chromium-headless-shell is not installed; tools/test does that"
    unittest.main()
