"""The command line of unwrapd."""
import json
import subprocess
from pathlib import Path

# Exit statuses with a file: done, or not certified.
WRITTEN = (0, 4)
# Seconds after which a run counts as endless, and its status. Most take less than one.
PATIENCE = 60
ENDLESS = -1


class Program:
    def __init__(self, path):
        self.path = str(path)

    def run(self, *arguments):
        command = [self.path, *map(str, arguments)]
        try:
            return subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(command, ENDLESS, "", f"no end after {PATIENCE} s")

    def written(self, command, path, out, *options):
        """The report and the exit status; no report if there is no file."""
        report = Path(out).with_suffix(".json")
        done = self.run(command, path, "-o", out, "--report", report, "--force", *options)
        if done.returncode not in WRITTEN:
            print(f"  refused: {Path(path).name} {' '.join(map(str, options))}: {done.stderr.strip().splitlines()[-1:]}")
            return None, done.returncode
        return json.loads(report.read_text()), done.returncode

    def verified(self, path, *options):
        """The judgment and the exit status."""
        done = self.run("verify", path, "--json", *options)
        return (json.loads(done.stdout) if done.stdout.startswith("{") else None), done.returncode
