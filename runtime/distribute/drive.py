"""Renders the open parts of a job folder on the workers of a Dask cluster. Carried by the program, which runs it with the job as one
JSON argument: program, folder, threads (0: all), workers (of a cluster of its own on this machine) or scheduler, quiet. A unit of work is
`program distribute --dir FOLDER --unit I`; which parts are done is asked of `program status`. Knows nothing of scenes and films."""
import json
import logging
import multiprocessing
import signal
import subprocess
import sys
import time

ATTEMPTS = 3  # of a unit that fails by itself; a unit whose worker is lost starts again without being counted
ROUNDS = 3  # of looking which parts are open and rendering them
HOPELESS = (2, 64)  # a bad scene or command line is not mended by trying again
EXIT_INTERNAL, EXIT_UNAVAILABLE, EXIT_INTERRUPTED = 1, 3, 6


class Failure(Exception):
    """Ends the program with a message and an exit code."""

    def __init__(self, message, code):
        super().__init__(message)
        self.code = code


def render_unit(command):
    """Runs on a worker, which imports nothing of ours: returns (exit code, what it said) or raises them, to be tried again."""
    import socket
    import subprocess

    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, errors="replace")
    except OSError as error:
        raise RuntimeError(3, f"{socket.gethostname()}: {command[0]} cannot be run: {error.strerror}") from None
    said = done.stderr.strip()[-2000:]
    if done.returncode not in (0, 2, 64):
        raise RuntimeError(done.returncode, said or f"{socket.gethostname()}: ended by signal {-done.returncode}")
    return done.returncode, said


class Progress:
    """One rewritten line on a terminal, else a line every ten seconds."""

    def __init__(self, total, done, quiet):
        self.total, self.begun_with, self.quiet = total, done, quiet
        self.terminal = sys.stderr.isatty()
        self.start = self.last = time.monotonic()

    def show(self, done, workers, force=False):
        now = time.monotonic()
        if self.quiet or not (force or now - self.last >= (0.5 if self.terminal else 10)):
            return
        self.last = now
        elapsed, fresh = now - self.start, done - self.begun_with
        text = f"{done} of {self.total} parts, {workers} workers, {elapsed:.0f} s"
        if fresh and done < self.total:
            text += f", {elapsed / fresh * (self.total - done):.0f} s to go"
        end = "" if self.terminal and not force else "\n"
        print(("\r\033[K" if self.terminal else "") + text, end=end, file=sys.stderr, flush=True)


def open_parts(job):
    """The indices of the parts that are not done, and how many there are."""
    answer = subprocess.run([job["program"], "status", job["folder"], "--json"], stdout=subprocess.PIPE)
    if answer.returncode not in (0, EXIT_INTERRUPTED):
        raise Failure("", answer.returncode)
    parts = json.loads(answer.stdout)["parts"]
    return [part["index"] for part in parts if part["state"] != "done"], len(parts)


def outcome(future):
    """(exit code, message) of a finished future."""
    if future.status == "finished":
        return future.result()
    error = future.exception() if future.status == "error" else None
    if isinstance(error, RuntimeError) and len(error.args) == 2:
        return error.args
    return EXIT_INTERNAL, str(error) if error else f"the scheduler has {future.status} it"


def render_round(client, job, units, progress, done):
    """Renders the units and returns the failures, as (unit, exit code, message). One that is hopeless ends the round."""
    command = [job["program"], "distribute", "--dir", job["folder"], "--threads", str(job["threads"]), "--end-with-parent", "--unit"]
    futures = {client.submit(render_unit, command + [str(unit)], pure=False, retries=ATTEMPTS - 1): unit for unit in units}
    failures = []
    workers = 0
    asked = float("-inf")
    while futures:
        for future in [future for future in futures if future.status != "pending"]:
            code, message = outcome(future)
            unit = futures.pop(future)
            done += code == 0
            if code:
                failures.append((unit, code, message))
            if code in HOPELESS:
                client.cancel(list(futures))
                return failures
        if time.monotonic() - asked > 2:
            workers, asked = len(client.nthreads()), time.monotonic()
        progress.show(done, workers)
        time.sleep(0.05)
    return failures


def render_all(client, job):
    units, total = open_parts(job)
    progress = Progress(total, total - len(units), job["quiet"])
    failures = []
    for _ in range(ROUNDS):
        failures = render_round(client, job, units, progress, total - len(units))
        units, total = open_parts(job)
        if not units or any(code in HOPELESS for _, code, _ in failures):
            break
    progress.show(total - len(units), len(client.nthreads()), force=True)
    if units:
        unit, code, message = failures[0] if failures else (units[0], EXIT_INTERNAL, "it was rendered, but is not there")
        if code < 0 or code > 125:
            code = EXIT_INTERNAL
        raise Failure(f"part {unit} was not rendered: {message}\n{total - len(units)} of {total} parts are done; the same command continues", code)


def start_workers(cluster, client, count):
    """Starts a cluster's workers. One that dies before it is ready is dropped by Dask for good, so all start again then."""
    for _ in range(ATTEMPTS):
        cluster.scale(count)
        while True:
            if len(client.nthreads()) >= count:
                return
            states = [worker.status.name for worker in list(cluster.workers.values())]
            if len(states) == count and any(state in ("failed", "closed") for state in states):
                break
            time.sleep(0.05)
        cluster.scale(0)
        while cluster.workers:
            time.sleep(0.05)
    raise Failure(f"error: no worker could be started in {ATTEMPTS} attempts: they died before they were ready", EXIT_INTERNAL)


def connect(job, dask):
    """A client, and the cluster to be closed after it."""
    if job["scheduler"]:
        try:
            return dask.Client(job["scheduler"], timeout=15), None
        except (OSError, ValueError) as error:
            raise Failure(f"error: --scheduler: no answer from {job['scheduler']}: {error}", EXIT_UNAVAILABLE) from None
    # Memory is the renderer's, not Python's, so Dask shall not judge a worker by it.
    cluster = dask.LocalCluster(n_workers=0, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None, memory_limit=0,
                                silence_logs=logging.CRITICAL)
    return dask.Client(cluster), cluster


def end_cluster(client, cluster):
    """Closes both. A worker that died while it started can keep Dask from closing (2022.12 does): its processes are ended by force then."""
    try:
        client.close(timeout=5)
        if cluster:
            cluster.close(timeout=10)
    except (OSError, TimeoutError):
        for process in multiprocessing.active_children():
            process.kill()


def interrupt(*_):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    raise KeyboardInterrupt


def run(job):
    try:
        import dask
        import distributed
    except ImportError:
        raise Failure(f"error: {sys.executable} has no module 'distributed'; `{sys.executable} -m pip install distributed` brings it, "
                      "and STOKES_DASK_PYTHON names another Python", EXIT_UNAVAILABLE) from None
    # A worker that was lost says nothing about the unit it held.
    dask.config.set({"distributed.scheduler.allowed-failures": 100})
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    client, cluster = connect(job, distributed)
    try:
        if cluster:
            start_workers(cluster, client, job["workers"])
        render_all(client, job)
    finally:
        end_cluster(client, cluster)


def main():
    signal.signal(signal.SIGINT, interrupt)
    signal.signal(signal.SIGTERM, interrupt)
    try:
        run(json.loads(sys.argv[1]))
    except KeyboardInterrupt:
        print("\ninterrupted; the parts that are done stay, and the same command continues", file=sys.stderr)
        return EXIT_INTERRUPTED
    except Failure as failure:
        if str(failure):
            print(failure, file=sys.stderr)
        return failure.code
    return 0


if __name__ == "__main__":
    sys.exit(main())
