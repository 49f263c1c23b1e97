"""A service of the package, on a port of its own, and files for it."""

import json
import subprocess
import sys
import urllib.request

COMMAND = [sys.executable, "-m", "unwrapd"]


def obj(vertices, faces):
    """A mesh as OBJ."""
    lines = ["v {} {} {}".format(*vertex) for vertex in vertices]
    return "\n".join(lines + ["f {} {} {}".format(*face) for face in faces + 1]) + "\n"


class Service:
    """Runs until the end of the block."""

    def __init__(self, folder, *arguments, listen="127.0.0.1:0", command=COMMAND, environment=None):
        options = ["serve", "--listen", listen, "--data", folder, *arguments]
        command = [*command, *map(str, options)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
        self.url = self.process.stdout.readline().split()[-1]

    def call(self, method, path, body=None):
        request = urllib.request.Request(self.url + path, data=body, method=method)
        with urllib.request.urlopen(request, timeout=90) as answer:
            return json.load(answer)

    def job(self, mesh):
        """A job at its end."""
        job = self.call("POST", "/v1/jobs?filename=mesh.obj", obj(*mesh).encode())
        while job["state"] in ("queued", "running"):
            job = self.call("GET", f"/v1/jobs/{job['id']}?wait=60")
        return job

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()
