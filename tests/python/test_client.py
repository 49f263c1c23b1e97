"""The client, against the service of the package, and against servers that fail."""

import http.server
import json
import pickle
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
import unwrapd
from service import Service, obj
from unwrapd._job import _inside

PYRAMID = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 .7\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"


@pytest.fixture(scope="module")
def service(tmp_path_factory):
    with Service(tmp_path_factory.mktemp("data")) as service:
        yield service


@pytest.fixture
def client(service):
    return unwrapd.Client(service.url, patience=20)


@pytest.fixture
def mesh(tmp_path):
    path = tmp_path / "pyramid.obj"
    path.write_text(PYRAMID)
    return path


def test_a_file_comes_back(client, mesh):
    output = mesh.with_name("out.glb")
    job = client.unwrap(mesh, format="glb", padding=8, resolution=512).save(output)
    assert job.certified and job.record["options"]["padding"] == 8
    assert unwrapd.verify_file(output, padding=8, resolution=512)["certified"]
    here = unwrapd.unwrap_file(mesh, output, padding=8, resolution=512)
    assert job.read() == output.read_bytes()
    assert job.report.keys() == here.keys()
    assert job.report["groups"] == here["groups"]
    with pytest.raises(unwrapd.InvalidOptions, match="format"):
        job.save(mesh.with_name("out.obj"))
    job.remove()
    with pytest.raises(unwrapd.ServiceError) as gone:
        job.read()
    assert (gone.value.code, gone.value.status) == ("job_not_found", 404)


def test_files_beside_it(client, mesh):
    mesh.write_text("mtllib pyramid.mtl\nusemtl red\n" + PYRAMID)
    mesh.with_name("pyramid.mtl").write_text("newmtl red\nKd 1 0 0\n")
    output = mesh.parent / "out/it.gltf"
    client.unwrap(mesh, format="gltf").save(output)
    document = json.loads(output.read_text())
    assert document["materials"][0]["name"] == "red"
    assert all((output.parent / buffer["uri"]).exists() for buffer in document["buffers"])
    assert unwrapd.verify_file(output)["certified"]


def test_other_kinds(client, mesh):
    output = mesh.with_name("out.obj")
    client.unwrap(mesh, format="obj").save(output)
    assert client.verify(output) == unwrapd.verify_file(output)
    measured, here = client.measure(output), unwrapd.measure_file(output)
    assert measured.keys() == here.keys()
    assert client.repack(output, padding=6, format="obj").save(mesh.with_name("again.obj")).id


@pytest.mark.parametrize(
    "text, options",
    [
        ("v 0 0 nan\n" + PYRAMID, {}),
        ("v 0 0 0\n", {}),
        ("f 1 2 9\n" + PYRAMID, {}),
        (PYRAMID, {"padding": -1}),
        (PYRAMID, {"resolution": 3}),
        (PYRAMID, {"energy": "(s1 - 2)^2"}),
    ],
)
def test_exceptions_are_those_of_this_process(client, mesh, text, options):
    mesh.write_text(text)
    with pytest.raises(unwrapd.Error) as here:
        unwrapd.unwrap_file(mesh, mesh.with_name("out.glb"), **options)
    with pytest.raises(type(here.value)) as there:
        client.unwrap(mesh, **options)
    assert there.value.code == here.value.code
    assert there.value.exit_code == here.value.exit_code


def test_wrong_names(client, mesh):
    with pytest.raises(TypeError, match="padding"):
        client.unwrap(mesh, paddin=3)
    with pytest.raises(FileNotFoundError):
        client.unwrap(mesh.with_name("none.obj"))
    with pytest.raises(unwrapd.InvalidOptions):
        unwrapd.Client("ftp://somewhere")


def test_progress(client, mesh, sheet):
    mesh.write_text(obj(*sheet(150)))
    seen = []
    client.unwrap(mesh, progress=seen.append)
    fractions = [progress.fraction for progress in seen]
    assert fractions and fractions == sorted(fractions)
    assert {progress.state for progress in seen} <= {"queued", "running"}


def test_a_bar(client, mesh, capsys):
    client.unwrap(mesh, progress=True, padding=7)
    list(client.map([mesh], progress=True, padding=7))
    assert "1/1" in capsys.readouterr().err


def test_false_ends_with_the_present_map(client, mesh, sheet):
    mesh.write_text(obj(*sheet(220)))
    job = client.unwrap(mesh, progress=lambda progress: progress.stage != "map")
    assert "ended_early" in {warning["code"] for warning in job.warnings}


def test_an_exception_cancels(client, service, mesh, sheet):
    mesh.write_text(obj(*sheet(230)))

    def enough(progress):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        client.unwrap(mesh, progress=enough)
    job = service.call("GET", "/v1/jobs?limit=1")["jobs"][0]
    assert service.call("GET", f"/v1/jobs/{job['id']}?wait=60")["state"] == "cancelled"


@pytest.mark.parametrize("ordered", [True, False])
def test_map(client, mesh, ordered):
    paths = [mesh.with_name(f"{n}.obj") for n in range(12)]
    for n, path in enumerate(paths):
        path.write_text(f"# {n} {ordered}\n" + PYRAMID.replace(".7", f".{n + 1}"))
    paths[5].write_text("v 0 0 nan\n" + PYRAMID)
    paths[7].unlink()
    outcomes = list(client.map(iter(paths), in_flight=3, ordered=ordered))
    if not ordered:
        outcomes.sort(key=lambda outcome: paths.index(outcome.path))
    assert [outcome.path for outcome in outcomes] == paths
    failed = {n: outcome.error for n, outcome in enumerate(outcomes) if outcome.job is None}
    assert failed.keys() == {5, 7}
    assert failed[5].code == "non_finite_position"
    with pytest.raises(FileNotFoundError):
        outcomes[7].result()
    assert all(outcome.result().certified for n, outcome in enumerate(outcomes) if n not in failed)


def test_map_takes_paths_as_places_get_free(client, mesh):
    taken = []
    paths = (taken.append(n) or mesh for n in range(100))
    outcomes = client.map(paths, in_flight=2)
    assert next(outcomes).job
    assert len(taken) <= 5
    outcomes.close()


@pytest.mark.parametrize("name", ["../a.bin", "/a.bin", "b/../../a.bin", "..\\a.bin", ""])
def test_files_stay_beside_the_result(name):
    with pytest.raises(unwrapd.ServiceError):
        _inside(name)


class Faulty(http.server.BaseHTTPRequestHandler):
    """Fails as often as it is told to, then has a job that is done."""

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        calls = self.server.calls
        calls.append((time.monotonic(), self.headers["Idempotency-Key"], self.headers["Authorization"], body))
        status, headers = self.server.faults[min(len(calls), len(self.server.faults)) - 1]
        if status is None:
            self.close_connection = True
            return
        job = {"id": "1", "state": "succeeded", "kind": "unwrap", "warnings": []}
        problem = {"code": "queue_full", "detail": "wait", "status": status}
        content = json.dumps(job if status < 300 else problem).encode()
        self.send_response(status)
        for name, value in {**headers, "Content-Length": str(len(content))}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_):
        pass


@pytest.fixture
def faulty():
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Faulty)
    server.calls = []
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield server
    server.shutdown()
    thread.join()
    server.server_close()


def at(server, **more):
    return unwrapd.Client("http://127.0.0.1:{}".format(server.server_address[1]), **more)


def test_a_repetition_is_the_same_request_and_keeps_to_retry_after(faulty, mesh):
    faulty.faults = [(503, {"Retry-After": "1"}), (None, {}), (429, {"Retry-After": "0"}), (200, {})]
    assert at(faulty, key="secret").unwrap(mesh).id == "1"
    times, keys, secrets, bodies = zip(*faulty.calls)
    assert len(times) == 4 and len(set(keys)) == 1 and len(set(bodies)) == 1
    assert set(secrets) == {"Bearer secret"}
    assert times[1] - times[0] >= 1


def test_patience_ends(faulty, mesh):
    faulty.faults = [(503, {"Retry-After": "30"})]
    with pytest.raises(unwrapd.ServiceError) as full:
        at(faulty, patience=5).unwrap(mesh)
    assert (full.value.code, full.value.status, len(faulty.calls)) == ("queue_full", 503, 1)
    again = pickle.loads(pickle.dumps(full.value))
    assert (again.code, again.status) == ("queue_full", 503)


def test_what_is_refused_for_good_is_not_repeated(faulty, mesh):
    faulty.faults = [(403, {})]
    with pytest.raises(unwrapd.ServiceError):
        at(faulty).unwrap(mesh)
    assert len(faulty.calls) == 1


def test_nobody_is_there(mesh):
    with pytest.raises(unwrapd.ServiceError) as nobody:
        unwrapd.Client("http://127.0.0.1:9", patience=0).unwrap(mesh)
    assert nobody.value.code == "server_unavailable"


def test_a_service_that_is_not_there_yet(tmp_path, mesh):
    with Service(tmp_path / "data") as first:
        url = first.url
    with ThreadPoolExecutor(1) as pool:
        job = pool.submit(unwrapd.Client(url, patience=60).unwrap, mesh)
        with Service(tmp_path / "data", listen=url.split("//")[1]):
            assert job.result(timeout=90).certified
