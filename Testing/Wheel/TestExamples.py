# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The examples of the Python package: the script, the notebook, as nbclient runs it, and the page of
# trame, in a headless Chromium whose sliders are moved. What is not installed is not tested.
#   LIMPID_TEST_PICTURES=FOLDER python3 TestExamples.py
# keeps the notebook with its results and the picture of the page in FOLDER.

import asyncio
import base64
import contextlib
import importlib.util
import io
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "Documentation/Examples"
NOTEBOOK = EXAMPLES / "notebooks/first_steps.ipynb"
CHROMIUM = next(filter(None, map(shutil.which, (
    "chromium", "chromium-browser", "google-chrome"))), None)
PATIENCE = 120  # seconds until a page must be there
sys.path.append(str(EXAMPLES))


def is_missing(*modules):
    """A reason to skip; None: all modules are installed."""
    missing = [name for name in modules if importlib.util.find_spec(name) is None]
    return f"{' and '.join(missing)} cannot be imported" if missing else None


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def local(port, path):
    """An address of this machine."""
    return urllib.parse.urlunsplit(("http", f"127.0.0.1:{port}", path, "", ""))


class Example(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def keep(self, name, data):
        """Keeps a file if somebody wants to see it."""
        if "LIMPID_TEST_PICTURES" in os.environ:
            pathlib.Path(os.environ["LIMPID_TEST_PICTURES"], name).write_bytes(data)

    def skip_without(self, *modules):
        reason = is_missing(*modules)
        if reason:
            self.skipTest(reason)


class TestScript(Example):
    def test_writes_pictures_and_the_result(self):
        import python_package
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            found = python_package.main(self.folder / "out")

        self.assertGreater(found.visible_fraction, 5 * found.base_visible_fraction)
        self.assertEqual(sorted(path.name for path in (self.folder / "out").iterdir()),
                         ["after.png", "before.png", "best_view.png", "found.npz"])


class TestNotebook(Example):
    def test_is_kept_without_results(self):
        cells = json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]
        for cell in cells:
            self.assertFalse(cell.get("outputs"))
            self.assertIsNone(cell.get("execution_count"))

    def test_runs(self):
        self.skip_without("nbclient", "ipykernel")
        import nbclient
        import nbformat
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        kernel = nbclient.NotebookClient(
            notebook, timeout=300, kernel_name="python3",
            resources={"metadata": {"path": str(self.folder)}})
        kernel.execute()

        outputs = [output.get("data", {}) for cell in notebook.cells if cell.cell_type == "code"
                   for output in cell.outputs]
        self.keep("first_steps.ipynb", nbformat.writes(notebook).encode())
        self.assertEqual(len([data for data in outputs if "image/png" in data]), 1)
        shown = [data["text/html"] for data in outputs if "text/html" in data]
        self.assertEqual([re.search(r"limpid\.(\w+)", html).group(1) for html in shown],
                         ["Optimization", "Viewpoints", "Optimization"])


class Page:
    """A page in a headless Chromium, by the protocol of its developer tools."""

    def __init__(self, session, socket_of_page):
        self.session = session
        self.socket = socket_of_page
        self.last = 0

    async def call(self, method, **parameters):
        self.last += 1
        await self.socket.send_json({"id": self.last, "method": method, "params": parameters})
        while True:
            answer = await self.socket.receive_json(timeout=PATIENCE)
            if answer.get("id") == self.last:
                return answer["result"]

    async def value(self, script):
        """The value of a JavaScript expression."""
        result = await self.call("Runtime.evaluate", expression=script, returnByValue=True)
        return result["result"].get("value")

    async def wait_for(self, script):
        """The value of an expression as soon as it counts as true."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            value = await self.value(script)
            if value:
                return value
            await asyncio.sleep(0.2)
        raise TimeoutError(f"{script} did not become true in {PATIENCE} s")


@unittest.skipIf(CHROMIUM is None, "There is no Chromium: the page of trame is not tested")
class TestTrame(Example):
    def setUp(self):
        super().setUp()
        self.skip_without("trame", "aiohttp")

    def start(self, *command, **options):
        """Starts a program that ends with the test. Returns it."""
        process = subprocess.Popen(command, start_new_session=True, **options)
        self.addCleanup(process.wait)
        self.addCleanup(lambda: process.poll() is None and os.killpg(process.pid, signal.SIGKILL))
        return process

    async def opened(self, session, address):
        """The page at an address, in a browser that ends with the test."""
        profile = self.folder / "profile"
        self.start(CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
                   "--disable-dev-shm-usage", "--window-size=700,800", "--remote-debugging-port=0",
                   "--remote-allow-origins=*", f"--user-data-dir={profile}", address,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port_file = profile / "DevToolsActivePort"
        end = time.monotonic() + PATIENCE
        while not (port_file.is_file() and port_file.read_text(encoding="utf-8")):
            self.assertLess(time.monotonic(), end, "Chromium does not start")
            await asyncio.sleep(0.2)
        port = port_file.read_text(encoding="utf-8").split()[0]
        while True:
            self.assertLess(time.monotonic(), end, "Chromium does not open the page")
            async with session.get(local(port, "/json/list")) as answer:
                pages = [page for page in await answer.json(content_type=None)
                         if page["type"] == "page" and page["url"].startswith(address)]
            if pages:
                return Page(session, await session.ws_connect(
                    pages[0]["webSocketDebuggerUrl"], max_msg_size=0))
            await asyncio.sleep(0.2)

    async def look(self, address):
        """Sees the page, moves a slider, and sees it again. Returns pictures, texts, screenshot."""
        import aiohttp
        async with aiohttp.ClientSession() as session:
            page = await self.opened(session, address)
            ready = "document.querySelector('#picture')?.naturalWidth > 0 && " \
                "document.querySelector('#picture').src"
            before = await page.wait_for(ready), await page.value(
                "document.querySelector('#words').innerText")
            screenshot = await page.call("Page.captureScreenshot", format="png")
            await page.value("const slider = document.querySelector('#view_weight'); "
                             "slider.value = 0; slider.dispatchEvent(new Event('change'))")
            await page.wait_for("document.querySelector('#words').innerText != "
                                + json.dumps(before[1]))
            after = await page.value("document.querySelector('#picture').src"), await page.value(
                "document.querySelector('#words').innerText")
            await page.socket.close()
            return before, after, base64.b64decode(screenshot["data"])

    def test_page_shows_the_picture_and_follows_a_slider(self):
        port = free_port()
        address = local(port, "/index.html")
        self.start(sys.executable, "-B", EXAMPLES / "trame_viewer.py", "--server", "--port",
                   str(port), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + PATIENCE
        while True:
            self.assertLess(time.monotonic(), end, "The page is not served")
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port)):
                break
            time.sleep(0.2)

        before, after, screenshot = asyncio.run(self.look(address))

        self.keep("trame_viewer.png", screenshot)
        self.assertNotEqual(before[0], after[0])
        shares = [list(map(float, re.findall(r"([\d.]+) %", text))) for _, text in (before, after)]
        self.assertGreater(shares[0][0], 4 * shares[0][1])
        self.assertLess(shares[1][0], shares[0][0] / 2)  # without a weight of the view


if __name__ == "__main__":
    unittest.main()
