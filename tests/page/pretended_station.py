"""What the fake station pretends: units, runs, limits and what they measure.

A serial number begins with A and has digits; one that ends with 0 has a wrong check digit, with 7 is bad,
with 9 strikes a bench fault, A16 was tested before.
"""
import json
import math
import re
import threading
import time

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
