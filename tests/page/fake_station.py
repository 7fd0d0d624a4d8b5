#!/usr/bin/env python3
"""A station that only pretends: serves the operator page and answers its API from a script.

    fake_station.py --page bench/serve/page [--plots FOLDER with uplot.js, uplot.css] [--port N]
                    [--keep FILE] [--loads-first] [--busy-words N]

Prints its port. The serial number decides what comes: it begins with A and has digits; one that ends
with 0 has a wrong check digit, with 7 is bad, with 9 strikes a bench fault, A16 was tested before.
With --keep it finds a running test again when it is started anew, as the real one does. With
--loads-first its plan has the same points in another order. The first N askers for words find it busy.
"""
import argparse
import http.server
import json
import math
import pathlib
import re
import secrets
import socketserver
import threading
import time
import urllib.parse

TOKENS = {"viewer-token": ("vera", "viewer"), "operator-token": ("olga", "operator"),
          "engineer-token": ("enzo", "engineer")}
ROLES = ["viewer", "operator", "engineer"]
TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".json": "application/json"}
SPEEDS_RPM, LOADS_PCT, REPEATS = [605, 1210, 1815], [0, 25, 50, 75, 100, 125, 150], 3
POINTS = [(s, l, r) for s in SPEEDS_RPM for l in LOADS_PCT for r in range(1, REPEATS + 1)]
POINTS_LOADS_FIRST = sorted(POINTS, key=lambda point: (point[1], point[0], point[2]))
ADVICE = "Stiffen, shorten or support the input shaft."


def run_json(serial, utc, verdict, reason="", error_kind="none"):
    return {"folder": f"{serial}/{utc}", "serial": serial, "started_utc": utc,
            "plan": "rv20e_acceptance", "verdict": verdict, "error_kind": error_kind if verdict else None,
            "reason": reason, "rejudged": []}


def utc_of_text(text, rest):
    """"20261121T114559Z" of a time as people write it; None if it is none."""
    digits = re.sub(r"[-: TZ]", "", text)
    if not re.fullmatch(r"\d{8}(\d\d){0,3}", digits) or len(digits) == 10:
        return None
    digits += rest[len(digits) - 14:] if len(digits) < 14 else ""
    return f"{digits[:8]}T{digits[8:]}Z"


class Station:
    def __init__(self, keep, run_s, points):
        self.lock = threading.RLock()
        self.keep = keep
        self.run_s = run_s
        self.points = points
        self.number = 0  # of changes
        self.serial, self.phase, self.verdict, self.begun_s, self.stopped = "", "idle", None, 0.0, False
        self.runs = [run_json(f"A{10 + i}", f"202611{20 + i:02}T0{i + 1}1500Z", *told) for i, told in
                     enumerate([("PASS",), ("FAIL", "input_shaft: misalignment"), ("PASS",),
                                ("INVALID", "channel 3 clipped"), ("PASS",),
                                ("ERROR", "torque sensor silent", "device_lost")])]
        self.runs.append(run_json("A16", "20261126T071500Z", "PASS"))
        self.runs.append(run_json("A21", "20261126T081500Z", None, "not finished: cut short"))
        self.versions = [{"limits_version": "1", "plan": "rv20e_acceptance", "status": "activated", "in_force": True,
                          "limits": self.limits(0.25),
                          "steps": [{"step": step, "utc": "20261101T080000Z", "by": "enzo"}
                                    for step in ("proposed", "approved", "activated")]},
                         {"limits_version": "spoilt", "status": "damaged", "in_force": False,
                          "fault": "runs/limits/spoilt.json cannot be read: rvbench check tells why"},
                         {"limits_version": "gone", "status": "missing", "in_force": True,
                          "fault": "runs/limits/gone.json is missing"}]
        if keep and keep.exists():
            self.__dict__.update(json.loads(keep.read_text()))

    @staticmethod
    def limits(most):
        why = "50 good units: median + 3.4 robust sigma"
        return [{"measure": "acceleration_rms", "unit": "m/s²", "max": most, "why": why},
                {"measure": "kurtosis", "unit": "1", "max": 3.6, "why": why},
                {"measure": "kurtosis", "unit": "1", "max": 3.4, "speed_rpm": 1815, "load_pct": 150, "why": why},
                {"measure": "acceleration_rms", "unit": "m/s²", "component": "input_shaft", "max": 0.01, "why": why},
                {"measure": "efficiency", "unit": "1", "min": 0.72, "why": why}]

    @staticmethod
    def effect():
        return {"runs": 7, "left_out": 1,
                "changes": [{"folder": "A14/20261124T051500Z", "was": "PASS", "would_be": "FAIL",
                             "reason": "acceleration_rms 0.22 m/s², above 0.21"}]}

    def changed(self):
        self.number += 1
        if self.keep:
            kept = ("serial", "phase", "verdict", "begun_s", "stopped", "runs", "versions")
            self.keep.write_text(json.dumps({name: getattr(self, name) for name in kept}))

    def share(self):
        return (time.time() - self.begun_s) / self.run_s

    def tick(self):
        with self.lock:
            if self.phase == "running" and (self.stopped or self.share() >= 1):
                self.conclude()

    def conclude(self):
        word, code, findings, reason, why = "PASS", 0, [], "", "none"
        if self.stopped:
            word, code, reason = "ABORTED", 50, "stopped by the operator"
        elif self.serial.endswith("7"):
            word, code, reason = "FAIL", 10, "envelope at order 1 above its limit <b>0.25</b> m/s²"
            findings = [{"component": "input_shaft", "mechanism": "misalignment", "advice": ADVICE},
                        {"component": "sun_gear", "mechanism": "profile_error", "advice": "Replace the sun gear."}]
        elif self.serial.endswith("9"):
            word, code, why = "ERROR", 30, "device_lost"
            reason = "inverter: read speed: no reply within 100 ms; check its cable"
        utc = self.begun_utc()
        self.runs.append(run_json(self.serial, utc, word, reason, why))
        run = f"{self.serial}/{utc}"
        self.verdict = {"word": word, "exit_code": code, "code": why, "reason": reason, "findings": findings,
                        "run": run, "report": f"/api/runs/{run}/report"}
        self.phase = "ended"
        self.changed()

    def begun_utc(self):
        return time.strftime("%Y%m%dT%H%M%SZ", time.gmtime(self.begun_s))

    def all_runs(self):
        """Also the one that is running."""
        with self.lock:
            at_work = [run_json(self.serial, self.begun_utc(), None, "not finished: still at work")]
            return self.runs + (at_work if self.phase == "running" else [])

    def history(self, query):
        """(status, answer), as rvbench history narrows."""
        span = {"from": ("", "000000"), "to": ("~", "235959")}
        for name, (none, rest) in span.items():
            span[name] = utc_of_text(query[name], rest) if name in query else none
            if span[name] is None:
                return 400, {"error": "field", "field": name}
        return 200, {"runs": [r for r in self.all_runs() if query.get("serial", r["serial"]) == r["serial"]
                              and query.get("verdict", r["verdict"]) == r["verdict"]
                              and span["from"] <= r["started_utc"] <= span["to"]]}

    def trend(self, query):
        """(status, answer): too few values for a trend."""
        if query.get("indicator") == "none":
            return 422, {"error": "refused", "exit_code": 2, "reason": "trend: no indicator none\n"}
        judged = [r for r in self.runs if r["verdict"]]
        values = [{"serial": r["serial"], "started_utc": r["started_utc"], "verdict": r["verdict"],
                   "point": "1815 rpm, 100 %", "value": 0.17 + 0.03 * math.sin(2.1 * i) + (0.12 if r["verdict"] == "FAIL" else 0)}
                  for i, r in enumerate(judged)]
        why_not = f"{len(values)} runs, 10 are needed"
        return 200, {"indicator": query.get("indicator"), "unit": "m/s²", "values": values,
                     "trend": {"told": False, "why_not": why_not}, "sentence": f"no trend can be told: {why_not}"}

    def cells(self):
        done = len(POINTS) if self.phase == "ended" else int(self.share() * len(POINTS)) if self.phase == "running" else 0
        for i, (speed, load, repeat) in enumerate(self.points):
            status = "done" if i < done else "measuring" if i == done and self.phase == "running" else "open"
            if status == "done" and self.serial.endswith("7") and i % 11 == 5:
                status = "failed"
            yield {"speed_rpm": speed, "load_pct": load, "repeat": repeat, "status": status}

    def state(self, role):
        with self.lock:
            known = [r for r in self.runs if r["serial"] == self.serial] if self.phase == "duplicate" else []
            share = self.share() if self.phase == "running" else 0
            actions = {"idle": "scan", "ready": "start", "duplicate": "decide_retest", "running": "wait",
                       "ended": "read_verdict"}
            action = actions[self.phase]
            if role == "viewer" and action in ("scan", "start", "decide_retest"):
                action = "not_allowed"
            at = self.points[min(len(POINTS) - 1, int(share * len(POINTS)))]
            return {"station": {"name": "Line 2 end of line", "qualified": True, "reasons": []},
                    "phase": self.phase, "serial": self.serial,
                    "known_runs": [{"run": r["folder"], "started_utc": r["started_utc"], "verdict": r["verdict"]} for r in known],
                    "plan": "rv20e_acceptance", "rig": "sim",
                    "progress": {"phase": "measure" if self.phase == "running" else "",
                                 "text": f"{at[0]} rpm, {at[1]} %, repeat {at[2]}" if self.phase == "running" else "",
                                 "done": share, "left_s": (1 - share) * 1900 if share > 0.02 else None},
                    "matrix": {"speeds_rpm": SPEEDS_RPM, "loads_pct": LOADS_PCT, "repeats": REPEATS,
                               "cells": list(self.cells())},
                    "verdict": self.verdict, "next_action": action}

    # Each returns (status, answer).
    def scan(self, body):
        text = str(body.get("text", "")).strip()
        if self.phase == "running":
            return 409, {"error": "running"}
        if not re.fullmatch(r"A\d+", text):
            return 422, {"error": "serial_rule", "text": text}
        if text.endswith("0"):
            return 422, {"error": "check_digit", "text": text}
        self.serial, self.verdict, self.stopped = text, None, False
        self.phase = "duplicate" if any(r["serial"] == text for r in self.runs) else "ready"
        self.changed()
        return 200, {}

    def start(self, body):
        if self.phase == "running":
            return 409, {"error": "running"}
        if self.phase == "duplicate" and not body.get("retest"):
            return 409, {"error": "duplicate"}
        if self.phase not in ("ready", "duplicate"):
            return 409, {"error": "no_unit"}
        if body.get("serial") != self.serial:
            return 409, {"error": "other_unit"}
        self.phase, self.begun_s = "running", time.time()
        self.changed()
        return 202, {}

    def stop(self, _):
        self.stopped = True
        return (202, {}) if self.phase == "running" else (409, {"error": "not_running"})

    def clear(self, _):
        self.serial, self.phase, self.verdict = "", "idle", None
        self.changed()
        return 200, {}

    def rejudge(self, body):
        run = next((r for r in self.runs if r["folder"] == body.get("run")), None)
        if not run:
            return 422, {"error": "refused", "exit_code": 2, "reason": f"rejudge: no run {body.get('run')}"}
        then = {"verdict": run["verdict"], "reason": run["reason"]}
        again = {"verdict": "FAIL", "reason": "", "limits_version": body.get("limits") or None,
                 "judged_utc": "20261126T090000Z"}
        run["rejudged"].append(again)
        self.changed()
        return 200, {"runs": [{"folder": run["folder"], "as_judged": then, "rejudged": again}]}

    def propose(self, _, by):
        self.versions.append({"limits_version": str(len(self.versions) + 1), "plan": "rv20e_acceptance",
                              "status": "draft", "limits": self.limits(0.21),
                              "steps": [{"step": "proposed", "utc": "20261126T090000Z", "by": by}]})
        self.changed()
        return 200, self.versions[-1]

    def step(self, body, before, after, by):
        wanted = body.get("version")
        version = next((v for v in self.versions if v["limits_version"] == wanted), None)
        if not version or version["status"] != before:
            return 422, {"error": "refused", "exit_code": 2, "reason": f"limits: version {wanted} is not {before}"}
        version["status"] = after
        if after == "activated":
            for other in self.versions:
                other["in_force"] = other is version
        version["steps"].append({"step": after, "utc": "20261126T090500Z", "by": by})
        self.changed()
        return 200, version


def strip(t_s, share):
    speed_rpm, load_pct, _ = POINTS[min(len(POINTS) - 1, int(share * len(POINTS)))]
    wave = math.sin(7 * t_s)
    return {"t_s": t_s, "torque_Nm": 1.67 * load_pct + 2.2 * wave + 4, "speed_rpm": speed_rpm + 3 * wave,
            "temperature_C": 24 + 14 * share, "vibration_g": 0.06 + speed_rpm / 40000 + 0.008 * wave}


def spectrum(share):
    speed_rpm = POINTS[min(len(POINTS) - 1, int(share * len(POINTS)))][0]
    levels_dB = [-78 + 5 * math.sin(i * 12.9898) * math.sin(i * 78.233) for i in range(512)]
    for order, level_dB in ((1, -24), (2, -31), (8.93, -38), (12.9, -45)):
        levels_dB[min(511, round(order * speed_rpm / 60 / 2))] = level_dB
    return {"channel": "A1 +X", "step_Hz": 2.0, "levels_dB": levels_dB}


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    station, page, plots, sessions, busy_words = None, None, None, {}, 0

    def log_message(self, *_):
        pass

    def answer(self, status, body, kind="application/json", headers=()):
        data = body if isinstance(body, bytes) else json.dumps(body).encode()
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(data)))
        self.send_header("Content-Security-Policy", "default-src 'self'")
        self.send_header("X-Content-Type-Options", "nosniff")
        for name, value in headers:
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(data)

    def session(self):
        found = re.search(r"rvbench_session=(\w+)", self.headers.get("Cookie", ""))
        return self.sessions.get(found[1]) if found else None

    def do_GET(self):
        url = urllib.parse.urlparse(self.path)
        if not url.path.startswith("/api/"):
            return self.send_page(url.path)
        session = self.session()
        if not session:
            return self.answer(401, {"error": "login"})
        query = {key: values[0] for key, values in urllib.parse.parse_qs(url.query).items()}
        if url.path == "/api/session":
            return self.answer(200, session)
        if url.path == "/api/events":
            return self.send_events(session["role"])
        if url.path == "/api/history":
            return self.answer(*self.station.history(query))
        if url.path == "/api/trend":
            return self.answer(*self.station.trend(query))
        if url.path == "/api/limits":
            known = {"effect": self.station.effect()} if "version" in query else {"versions": self.station.versions}
            return self.answer(200, known)
        if url.path.endswith("/report"):
            name = urllib.parse.unquote(url.path.split("/")[3])
            return self.answer(200, f"<!doctype html><title>Report of {name}</title><h1>{name}</h1>".encode(), "text/html")
        self.answer(404, {"error": "not_found"})

    def do_POST(self):
        body = json.loads(self.rfile.read(int(self.headers.get("Content-Length", 0))) or b"{}")
        if self.path == "/api/login":
            return self.log_in(body)
        session = self.session()
        if not session:
            return self.answer(401, {"error": "login"})
        if self.headers.get("X-CSRF-Token") != session["csrf"]:
            return self.answer(403, {"error": "csrf"})
        station = self.station
        calls = {"scan": ("operator", station.scan), "start": ("operator", station.start),
                 "stop": ("operator", station.stop), "clear": ("operator", station.clear),
                 "logout": ("viewer", self.log_out), "rejudge": ("engineer", station.rejudge),
                 "limits/propose": ("engineer", lambda b: station.propose(b, session["name"])),
                 "limits/approve": ("engineer", lambda b: station.step(b, "draft", "approved", session["name"])),
                 "limits/activate": ("engineer", lambda b: station.step(b, "approved", "activated", session["name"]))}
        least, call = calls.get(self.path[5:], ("viewer", lambda _: (404, {"error": "not_found"})))
        if ROLES.index(session["role"]) < ROLES.index(least):
            return self.answer(403, {"error": "role"})
        with station.lock:
            status, answer = call(body)
        self.answer(status, answer)

    def log_in(self, body):
        if body.get("token") not in TOKENS:
            return self.answer(401, {"error": "bad_token"})
        name, role = TOKENS[body["token"]]
        cookie = secrets.token_hex(16)
        self.sessions[cookie] = {"name": name, "role": role, "csrf": secrets.token_hex(16)}
        self.answer(200, self.sessions[cookie],
                    headers=[("Set-Cookie", f"rvbench_session={cookie}; Path=/; HttpOnly; SameSite=Strict")])

    def log_out(self, _):
        self.sessions.pop(re.search(r"rvbench_session=(\w+)", self.headers["Cookie"])[1])
        return 200, {}

    def send_busy(self):
        self.send_response(503)
        self.send_header("Content-Length", "0")
        self.send_header("Connection", "close")
        self.end_headers()

    def send_page(self, path):
        if path.startswith("/words/") and Handler.busy_words > 0:
            Handler.busy_words -= 1
            return self.send_busy()
        name = "index.html" if path == "/" else path[1:]
        root = self.plots if name.startswith("uplot.") else self.page
        file = (root / name).resolve() if root else None
        if not file or root.resolve() not in file.parents or not file.is_file():
            return self.answer(404, {"error": "not_found"})
        self.answer(200, file.read_bytes(), TYPES.get(file.suffix, "text/plain"))

    def send_events(self, role):
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        station = self.station

        def send(name, data):
            self.wfile.write(f"event: {name}\ndata: {json.dumps(data)}\n\n".encode())

        try:
            send("snapshot", {"state": station.state(role), "strips": []})
            told, round_ = None, 0
            while True:
                station.tick()
                now = station.state(role)
                if now != told:
                    send("state", now)
                    told = now
                if station.phase == "running":
                    share = station.share()
                    send("strip", strip(time.time() - station.begun_s, share))
                    if round_ % 4 == 0:
                        send("spectrum", spectrum(share))
                if round_ % 2 == 0:
                    send("heartbeat", {"time_utc": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())})
                round_ += 1
                time.sleep(0.2)
        except OSError:
            pass


class Server(socketserver.ThreadingMixIn, http.server.HTTPServer):
    daemon_threads = True
    allow_reuse_address = True

    def handle_error(self, *_):
        """A browser that hangs up in mid-answer is nothing to tell of."""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--page", type=pathlib.Path, required=True)
    parser.add_argument("--plots", type=pathlib.Path)
    parser.add_argument("--port", type=int, default=0)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--run-s", type=float, default=4)
    parser.add_argument("--loads-first", action="store_true")
    parser.add_argument("--busy-words", type=int, default=0)
    options = parser.parse_args()
    Handler.page, Handler.plots = options.page, options.plots
    Handler.busy_words = options.busy_words
    Handler.station = Station(options.keep, options.run_s, POINTS_LOADS_FIRST if options.loads_first else POINTS)
    server = Server(("127.0.0.1", options.port), Handler)
    print(server.server_address[1], flush=True)
    server.serve_forever()


if __name__ == "__main__":
    main()
