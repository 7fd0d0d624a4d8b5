#!/usr/bin/env python3
"""A station that only pretends: serves the operator page and answers its API from a script.

    fake_station.py --page bench/serve/page [--plots FOLDER with uplot.js, uplot.css] [--port N]
                    [--keep FILE] [--loads-first] [--busy-words N]

Prints its port. The serial number decides what comes, as pretended_station.py tells.
With --keep it finds a running test again when it is started anew, as the real one does. With
--loads-first its plan has the same points in another order. The first N askers for words find it busy.
"""
import argparse
import http.server
import json
import pathlib
import re
import secrets
import socketserver
import time
import urllib.parse

from pretended_station import POINTS, POINTS_LOADS_FIRST, Station, spectrum, strip

TOKENS = {"viewer-token": ("vera", "viewer"), "operator-token": ("olga", "operator"),
          "engineer-token": ("enzo", "engineer")}
ROLES = ["viewer", "operator", "engineer"]
TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".json": "application/json"}


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
