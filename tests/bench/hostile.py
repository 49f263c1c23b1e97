"""What an honest client waits for beside 1,100 connections that are idle, stop within a header, or stall an upload.

usage: tests/bench/hostile.py [--program PROGRAM] [--hostile N] [--files N] [--rounds N] [--fresh] [--elsewhere]

The service may open so many files. A hostile connection that is closed comes again. The honest client
was there before and keeps its connection; with --fresh it makes one for each request. With --elsewhere,
the others come from 127.0.0.2, of which 100 are let in.
"""
import argparse
import http.client
import resource
import socket
import subprocess
import tempfile
import threading
import time

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# {}\n"
SAID = [
    b"",
    b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nX-Half: ",
    b"POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/obj\r\nContent-Length: 100000\r\n\r\nv 0 0 0\n",
]
PAUSE = 0.1
# For the crowd to come, in seconds.
MOST_WAIT = 10


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default="target/release/unwrapd")
    parser.add_argument("--hostile", type=int, default=1100)
    parser.add_argument("--files", type=int, default=1024)
    parser.add_argument("--rounds", type=int, default=200)
    parser.add_argument("--fresh", action="store_true")
    parser.add_argument("--elsewhere", action="store_true")
    return parser.parse_args()


class Crowd:
    """Connections that are there to take places."""

    def __init__(self, port, size, source):
        self.port, self.size, self.source = port, size, source
        self.sockets, self.closed, self.is_over = [], 0, False
        self.thread = threading.Thread(target=self.stay)

    def one(self, kind):
        made = socket.create_connection(("127.0.0.1", self.port), timeout=1, source_address=(self.source, 0))
        made.sendall(SAID[kind % len(SAID)])
        made.setblocking(False)
        return made

    def is_open(self, one):
        try:
            while one.recv(4096):
                pass
        except BlockingIOError:
            return True
        except OSError:
            pass
        one.close()
        self.closed += 1
        return False

    def stay(self):
        made = 0
        while not self.is_over:
            self.sockets = [one for one in self.sockets if self.is_open(one)]
            missing = min(self.size - len(self.sockets), 100)
            for _ in range(missing):
                try:
                    self.sockets.append(self.one(made))
                except OSError:
                    # No room even to wait for a place.
                    break
                made += 1
            time.sleep(PAUSE)

    def __enter__(self):
        self.thread.start()
        end = time.monotonic() + MOST_WAIT
        while len(self.sockets) < self.size and time.monotonic() < end:
            time.sleep(PAUSE)
        return self

    def __exit__(self, *_):
        self.is_over = True
        self.thread.join()
        for one in self.sockets:
            one.close()


def served(given, data):
    """The service, and its port."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (given.files, given.files))
    more = ["--max-address-connections", "100"] if given.elsewhere else []
    command = [given.program, "serve", "--listen", "127.0.0.1:0", "--data", data, *more]
    service = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, preexec_fn=limit)
    return service, int(service.stdout.readline().rsplit(":", 1)[1])


def honest(kept, given):
    """Milliseconds of each request, by what was asked."""
    times = {"readyz": [], "list": [], "POST": []}
    asked = [("readyz", "GET", "/readyz"), ("list", "GET", "/v1/jobs?limit=5"), ("POST", "POST", "/v1/jobs")]
    for index in range(given.rounds):
        for name, method, path in asked:
            if given.fresh:
                kept.close()
            body = TRIANGLE.format(f"{index} {time.time()}") if method == "POST" else None
            began = time.perf_counter()
            kept.request(method, path, body, {"Content-Type": "model/obj"} if body else {})
            answer = kept.getresponse()
            answer.read()
            times[name].append(1e3 * (time.perf_counter() - began))
            assert answer.status in (200, 202), (name, answer.status)
            time.sleep(PAUSE)
    return times


def main():
    given = arguments()
    most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    with tempfile.TemporaryDirectory() as data:
        service, port = served(given, data)
        try:
            # It was there before the others came.
            kept = http.client.HTTPConnection("127.0.0.1", port)
            kept.connect()
            with Crowd(port, given.hostile, "127.0.0.2" if given.elsewhere else "127.0.0.1") as crowd:
                times = honest(kept, given)
        finally:
            service.terminate()
            service.wait()
    for name, waited in times.items():
        waited.sort()
        p50, p95, p99 = (waited[int(share * (len(waited) - 1))] for share in (0.5, 0.95, 0.99))
        print(f"{name:7} p50 {p50:6.1f}  p95 {p95:6.1f}  p99 {p99:6.1f}  worst {waited[-1]:6.1f} ms")
    print(f"{crowd.closed} hostile connections closed")


if __name__ == "__main__":
    main()
