"""A headless Chromium at the size of a small panel, driven by the keyboard alone."""
import contextlib
import re
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

WIDTH, HEIGHT = 1024, 768


class Browser:
    def __init__(self, shots=None):
        options = Options()
        options.binary_location = "/usr/bin/chromium"
        for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu",
                         "--lang=en", "--force-prefers-reduced-motion", "--no-first-run",
                         "--disable-extensions", "--disable-component-update", "--disable-background-networking"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": WIDTH, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": False})
        self.shots = shots

    def close(self):
        self.driver.quit()

    def open(self, url):
        self.driver.get(url)

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def type(self, *keys):
        """Types to whatever has the focus, as a person or a scanner does."""
        ActionChains(self.driver).send_keys(*keys).perform()

    def text(self, selector):
        return self.script("return document.querySelector(arguments[0])?.innerText ?? ''", selector)

    def focused(self):
        return self.script("return document.activeElement.id || document.activeElement.name || "
                           "document.activeElement.innerText")

    def wait(self, what, condition, within_s=10.0):
        end_s = time.monotonic() + within_s
        while time.monotonic() < end_s:
            with contextlib.suppress(Exception):
                if condition():
                    return
            time.sleep(0.04)
        self.shoot("failed")
        raise AssertionError(f"{what}: not within {within_s} s; state {self.text('#state_word')!r}, "
                             f"focus {self.focused()!r}")

    def wait_word(self, word, within_s=10.0):
        self.wait(f"the big word {word!r}", lambda: self.text("#state_word") == word, within_s)

    def tab_to(self, name, most=40):
        """Presses Tab until the element of that id, name or text has the focus."""
        for tabs in range(most + 1):
            if self.focused() == name:
                return
            if tabs < most:
                self.type(Keys.TAB)
        raise AssertionError(f"Tab does not reach {name!r} from {self.focused()!r}")

    def is_disabled(self, button):
        return self.script("return document.getElementById(arguments[0]).disabled", button)

    def wait_enabled(self, button):
        self.wait(f"{button} to be pressed", lambda: not self.is_disabled(button))

    def overflows(self):
        """Elements that are cut off or reach beyond the window, by id or text."""
        return self.script("""
          const out = [];
          for (const e of document.querySelectorAll("body *")) {
            if (e.closest(".unseen, .shapes, .skip, .scroll, #answer, datalist, option, svg, .u-wrap")) continue;
            const box = e.getBoundingClientRect();
            if (!box.width || getComputedStyle(e).visibility === "hidden") continue;
            const beyond = box.right > innerWidth + 1 || box.bottom > innerHeight + 1 || box.left < -1 || box.top < -1;
            const cut = e.children.length === 0 && e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflow !== "visible";
            const inside = e.closest(".card") && !e.matches(".card") ? e.closest(".card").getBoundingClientRect() : null;
            const clipped = inside && (box.bottom > inside.bottom + 1 || box.right > inside.right + 1);
            if (beyond || cut || clipped) out.push((e.id || e.className || e.tagName) + ": " + e.textContent.slice(0, 40));
          }
          return out;""")

    def scrolls(self):
        return self.script("const d = document.scrollingElement;"
                           "return d.scrollHeight > innerHeight || d.scrollWidth > innerWidth")

    def complaints(self, expected=()):
        """What the browser's console holds against the page, lost connections apart.

        expected: refusals that the test brings about, as ("/api/session", 401)
        """
        refusals = [re.compile(rf"http://[^/]+{re.escape(path)} - .*\bstatus of {status}\b") for path, status in expected]
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] == "SEVERE" and "net::ERR" not in entry["message"]
                and not any(refusal.match(entry["message"]) for refusal in refusals)]

    def shoot(self, name):
        if self.shots:
            self.shots.mkdir(parents=True, exist_ok=True)
            self.driver.save_screenshot(str(self.shots / f"{name}.png"))

    def new_tab_url(self):
        """The address of the newest tab; closes it and comes back."""
        first = self.driver.window_handles[0]
        self.driver.switch_to.window(self.driver.window_handles[-1])
        url, title = self.driver.current_url, self.driver.title
        self.driver.close()
        self.driver.switch_to.window(first)
        return url, title


__all__ = ["Browser", "By", "Keys", "WIDTH", "HEIGHT"]
