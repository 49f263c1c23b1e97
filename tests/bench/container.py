#!/usr/bin/env python3
"""What the README promises of the container: it is built, runs as nobody on a read-only root, and loses nothing when it is killed.

Sends meshes of a folder from another network namespace, kills the container midway, starts it again, and has every result proven by
the program in the image. Knows only the README and openapi.json. Needs root, docker and `ip`.

usage: tests/bench/container.py MESHES [-n 300] [--image unwrapd] [--built]
"""
import argparse
import json
import os
import subprocess
import sys
import time
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from itertools import cycle, islice
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MEDIA_TYPES = {".glb": "model/gltf-binary", ".obj": "model/obj", ".ply": "model/ply", ".off": "model/off", ".stl": "model/stl"}
NAMESPACE = f"unwrapd-client-{os.getpid()}"
PORT = 8080


def run(*command, **options):
    return subprocess.run(command, check=True, text=True, capture_output=True, **options).stdout.strip()


def call(base, key, path, body=None, headers=None, patience=120):
    """Asks until there is an answer that is not the want of a service."""
    end = time.monotonic() + patience
    while True:
        request = urllib.request.Request(base + path, body, {"Authorization": f"Bearer {key}", **(headers or {})})
        try:
            with urllib.request.urlopen(request, timeout=30) as answer:
                return answer.status, answer.read()
        except urllib.error.HTTPError as error:
            if error.code not in (429, 503) or time.monotonic() > end:
                return error.code, error.read()
        except OSError:
            if time.monotonic() > end:
                raise
        time.sleep(0.2)


def client(base, key, meshes, n, folder):
    """Sends n meshes, each under options of its own, and keeps the results; says when half of them have ended."""
    files = [path for path in sorted(Path(meshes).rglob("*")) if path.suffix in MEDIA_TYPES and path.stat().st_size < 2 << 20]

    def send(numbered):
        number, path = numbered
        headers = {"Content-Type": MEDIA_TYPES[path.suffix], "Idempotency-Key": f"asset-{number}"}
        status, answer = call(base, key, f"/v1/jobs?resolution={512 + number}", path.read_bytes(), headers)
        assert status in (200, 202), (path, status, answer)
        return number, path, json.loads(answer)["id"]

    def fetch(sent):
        number, path, job = sent
        while True:
            status, answer = call(base, key, f"/v1/jobs/{job}?wait=20")
            assert status == 200, (status, answer)
            state = json.loads(answer)
            if state["finished_at"]:
                break
        if state["state"] == "succeeded":
            status, result = call(base, key, f"/v1/jobs/{job}/result")
            assert status == 200
            (Path(folder) / f"{number}.glb").write_bytes(result)
        say(number=number, name=path.name, state=state["state"], error=(state.get("error") or {}).get("code"), certified=state.get("certified"))

    with ThreadPoolExecutor(8) as pool:
        jobs = list(pool.map(send, enumerate(islice(cycle(files), n))))
        say(sent=len(jobs))
        list(pool.map(fetch, jobs))


def say(**told):
    sys.stdout.write(json.dumps(told) + "\n")
    sys.stdout.flush()


class Container:
    """The image, run as the README has it."""

    def __init__(self, image):
        self.image, self.volume = image, f"unwrapd-bench-{os.getpid()}"
        self.key = run("docker", "run", "--rm", "-v", f"{self.volume}:/data", image, "keys", "create", "--owner", "me")
        started = time.monotonic()
        self.id = run("docker", "run", "-d", "--read-only", "--cap-drop", "ALL", "-v", f"{self.volume}:/data", image)
        self.ready("docker run to ready", started)

    def inspect(self, what):
        return run("docker", "inspect", "-f", "{{" + what + "}}", self.id)

    def ready(self, what, started):
        while subprocess.run(["docker", "exec", self.id, "unwrapd", "health"], capture_output=True).returncode:
            time.sleep(0.02)
        print(f"{what}: {time.monotonic() - started:.2f} s")

    def base(self):
        return f"http://{self.inspect('.NetworkSettings.IPAddress')}:{PORT}"

    def remove(self):
        subprocess.run(["docker", "rm", "-f", self.id], capture_output=True)
        subprocess.run(["docker", "volume", "rm", self.volume], capture_output=True)


def join_bridge():
    """A network namespace of its own on the bridge of the containers."""
    bridge = json.loads(run("docker", "network", "inspect", "bridge"))[0]["IPAM"]["Config"][0]["Subnet"]
    net, bits = bridge.split("/")
    address = ".".join(net.split(".")[:2] + ["255", "253"]) + "/" + bits
    link = f"un{os.getpid()}"
    run("ip", "netns", "add", NAMESPACE)
    run("ip", "link", "add", link, "type", "veth", "peer", "name", "eth0", "netns", NAMESPACE)
    run("ip", "link", "set", link, "master", "docker0", "up")
    run("ip", "-n", NAMESPACE, "address", "add", address, "dev", "eth0")
    run("ip", "-n", NAMESPACE, "link", "set", "eth0", "up")


def main(arguments):
    if not arguments.built:
        started = time.monotonic()
        run("docker", "build", "-q", "-f", "docker/Dockerfile", "-t", arguments.image, ".", cwd=ROOT)
        print(f"build: {time.monotonic() - started:.0f} s")
    print(f"image: {int(run('docker', 'image', 'inspect', '-f', '{{.Size}}', arguments.image)) / 2**20:.1f} MiB")
    folder = Path(run("mktemp", "-d"))
    container = Container(arguments.image)
    try:
        status = Path(f"/proc/{container.inspect('.State.Pid')}/status").read_text()
        print("runs as", next(line for line in status.splitlines() if line.startswith("Uid")).split()[1])
        join_bridge()
        mine = [sys.executable, __file__, "--client", container.base(), container.key, "-n", str(arguments.n), arguments.meshes, str(folder)]
        sender = subprocess.Popen(["ip", "netns", "exec", NAMESPACE, *mine], stdout=subprocess.PIPE, text=True)
        ended = []
        for line in sender.stdout:
            told = json.loads(line)
            ended += [told] if "number" in told else []
            if len(ended) == arguments.n // 2 and "number" in told:
                run("docker", "kill", "-s", "KILL", container.id)
                started = time.monotonic()
                run("docker", "start", container.id)
                container.ready(f"killed after {len(ended)} results; start to ready", started)
        assert sender.wait() == 0
        judge(container, folder, ended)
    finally:
        container.remove()
        subprocess.run(["ip", "netns", "delete", NAMESPACE], capture_output=True)


def judge(container, folder, ended):
    """Has the program in the image prove every result."""
    proven = 0
    for told in ended:
        if told["state"] != "succeeded":
            print("not unwrapped:", told["name"], told["error"])
            continue
        with open(folder / f"{told['number']}.glb", "rb") as result:
            verified = subprocess.run(["docker", "exec", "-i", container.id, "unwrapd", "verify", "-q", "-"], stdin=result)
        proven += verified.returncode == 0
        if verified.returncode:
            print("not proven:", told)
    print(f"{len(ended)} answers, {sum(told['state'] == 'succeeded' for told in ended)} results, {proven} proven")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes")
    parser.add_argument("folder", nargs="?", help=argparse.SUPPRESS)
    parser.add_argument("-n", type=int, default=300)
    parser.add_argument("--image", default="unwrapd")
    parser.add_argument("--built", action="store_true", help="the image is there")
    parser.add_argument("--client", nargs=2, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.client:
        client(*given.client, given.meshes, given.n, given.folder)
    else:
        main(given)
