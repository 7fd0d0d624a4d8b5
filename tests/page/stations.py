"""Stations for the page to talk to: the fake one, and the real program."""
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request

HERE = pathlib.Path(__file__).parent


class FakeStation:
    """Keeps its port and what it knows when it is killed and started anew."""

    def __init__(self, options, with_plots, run_s, *others):
        self.folder = tempfile.TemporaryDirectory()
        self.command = [sys.executable, str(HERE / "fake_station.py"), "--page", str(options.page),
                        "--keep", str(pathlib.Path(self.folder.name) / "kept.json"), "--run-s", str(run_s), *others]
        if with_plots and options.plots and (options.plots / "uplot.js").exists():
            self.command += ["--plots", str(options.plots)]
        self.port = 0
        self.start()
        self.url = f"http://127.0.0.1:{self.port}/"

    def start(self):
        self.process = subprocess.Popen([*self.command, "--port", str(self.port)], stdout=subprocess.PIPE, text=True)
        self.port = int(self.process.stdout.readline())

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def hang(self):
        self.process.send_signal(signal.SIGSTOP)

    def go_on(self):
        self.process.send_signal(signal.SIGCONT)

    def close(self):
        self.kill()
        self.folder.cleanup()


class OtherPage:
    """Somebody else at a station, who has logged in."""

    def __init__(self, url, token):
        self.url, self.csrf = url, ""
        self.opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
        self.csrf = self.act("login", token=token)["csrf"]

    def act(self, path, **body):
        headers = {"Content-Type": "application/json", "X-CSRF-Token": self.csrf}
        asked = urllib.request.Request(f"{self.url}api/{path}", json.dumps(body).encode(), headers)
        with self.opener.open(asked, timeout=10) as answer:
            return json.load(answer)


class RealStation:
    """rvbench serve with plan quick on the simulated bench; killed and started anew, it keeps its port."""

    def __init__(self, options):
        self.program = options.program
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        made = self.ask("serve", "--make-token", "enzo", "--role", "engineer")
        self.token, entry = token_and_entry(made)
        (self.path / "station.json").write_text(json.dumps(
            {"station": "Line 2", "plan": "quick", "rig": "sim", "serial": {"masks": ["A##"]}, "users": [entry]}))
        self.port = 0
        self.start()
        self.url = f"http://127.0.0.1:{self.port}/"

    def ask(self, *words):
        return subprocess.run([self.program, *words], capture_output=True, text=True, check=True).stdout

    def start(self):
        log = self.path / "stderr.txt"
        log.unlink(missing_ok=True)  # a run of the one before may still write there
        with log.open("w") as stderr:
            self.process = subprocess.Popen([self.program, "serve", "--station", self.path / "station.json",
                                             "--port", str(self.port)], stderr=stderr)
        end_s = time.monotonic() + 30
        while time.monotonic() < end_s:
            has_ended = self.process.poll() is not None
            told = re.search(r" at http://127\.0\.0\.1:(\d+)/\n", log.read_text(errors="replace"))
            if told:
                self.port = int(told[1])
                return
            if has_ended:
                break
            time.sleep(0.05)
        self.kill()
        said = log.read_text(errors="replace")
        raise AssertionError(f"rvbench serve does not answer, exit code {self.process.returncode}: {said}")

    def kill(self):
        self.process.kill()
        self.process.wait()

    def propose_strict_limits(self):
        limits = [{"measure": "acceleration_peak", "unit": "g", "max": 0.0001, "why": "a test"}]
        file = self.path / "strict.json"
        file.write_text(json.dumps({"limits_version": "strict", "plan": "quick", "limits": limits}))
        self.ask("limits", "propose", "--from", file, "--by", "enzo", "--out", self.path / "runs")

    def close(self):
        self.process.terminate()
        self.process.wait()
        self.folder.cleanup()


def token_and_entry(text):
    """The token is a word of its own on a line, the entry of the station file a JSON object."""
    entry = json.loads(text[text.index("{"):text.rindex("}") + 1])
    outside = text[:text.index("{")] + text[text.rindex("}") + 1:]
    token = next(word for word in outside.split() if word.startswith(entry["name"] + "."))
    return token, entry
