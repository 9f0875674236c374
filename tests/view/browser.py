"""Drives Chromium over its DevTools protocol through the live page. See browser.sh."""
import base64, json, os, pathlib, shutil, signal, subprocess, sys, tempfile, time, urllib.request

import websocket

STOKES, SCENE, FOLDER = sys.argv[1:4]
SIZES = {"desktop": (1280, 800), "phone": (390, 844)}
failures = []


def check(what, truth):
    print(("ok     " if truth else "FAILED ") + what, flush=True)
    if not truth:
        failures.append(what)


class Browser:
    def __init__(self):
        self.profile = tempfile.mkdtemp()
        self.process = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--remote-debugging-port=0",
             "--remote-allow-origins=*", "--user-data-dir=" + self.profile, "about:blank"], stderr=subprocess.PIPE, text=True)
        for line in self.process.stderr:
            if "DevTools listening on" in line:
                port = line.split("://")[1].split("/")[0].split(":")[1]
                break
        pages = json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/json"))
        self.socket = websocket.create_connection(next(p for p in pages if p["type"] == "page")["webSocketDebuggerUrl"], timeout=120)
        self.number, self.problems = 0, []
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def call(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            if message.get("method") == "Runtime.exceptionThrown":
                self.problems.append(message["params"]["exceptionDetails"].get("exception", {}).get("description", "exception"))
            if message.get("method") == "Log.entryAdded" and message["params"]["entry"]["level"] == "error":
                self.problems.append(message["params"]["entry"]["text"])
            if message.get("method") == "Network.requestWillBeSent":
                url = message["params"]["request"]["url"]
                if not url.startswith(("http://127.0.0.1:", "data:", "blob:")):
                    self.problems.append("asks " + url)

    def value(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(expression + ": " + result["exceptionDetails"]["exception"]["description"])
        return result["result"].get("value")

    def wait(self, expression, seconds=120):
        end = time.time() + seconds
        while time.time() < end:
            if self.value(expression):
                return True
            time.sleep(0.2)
        return False

    def shoot(self, name):
        picture = self.call("Page.captureScreenshot", format="png")["data"]
        path = pathlib.Path(FOLDER) / (name + ".png")
        path.write_bytes(base64.b64decode(picture))

    def size(self, width, height, phone):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2 if phone else 1, mobile=phone)
        self.call("Emulation.setTouchEmulationEnabled", enabled=phone)

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def close(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)


def drag(browser, x, y, dx, dy):
    browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
    for i in range(1, 9):
        browser.mouse("mouseMoved", x + dx * i / 8, y + dy * i / 8, button="left", buttons=1)
    browser.mouse("mouseReleased", x + dx, y + dy, button="left", buttons=0, clickCount=1)


def middle(browser):
    return browser.value("(b => [b.left + b.width / 2, b.top + b.height / 2])(document.getElementById('picture').getBoundingClientRect())")


def look(browser, name, url, scene):
    width, height = SIZES[name]
    browser.size(width, height, name == "phone")
    browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    browser.call("Page.navigate", url=url)
    check(f"{name}: a picture appears", browser.wait("typeof frame !== 'undefined' && frame && frame.width === state.size[0]", 300))
    check(f"{name}: nothing is wider than the page", browser.value(f"document.scrollingElement.scrollWidth <= {width}"))
    check(f"{name}: the picture is not black", browser.value(
        "(d => { let s = 0; for (const v of d) s += v; return s / d.length; })(picture.getContext('2d').getImageData(0, 0, picture.width, picture.height).data) > 80"))
    x, y = middle(browser)
    if name == "phone":
        browser.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    else:
        browser.mouse("mouseMoved", x, y + 60, buttons=0)
    check(f"{name}: the spectrum under the {'finger' if name == 'phone' else 'mouse'} is read", browser.wait("reading.textContent.includes('R, G, B')", 20))
    time.sleep(1)
    browser.shoot(name)
    if name == "phone":
        browser.value("document.querySelector('aside').scrollIntoView()")
        browser.shoot("phone_lower")
        browser.value("scrollTo(0, 0)")

    # Exposure is immediate: the pixels change without a new frame.
    mean = "(d => d.reduce((s, v) => s + v, 0) / d.length)(picture.getContext('2d').getImageData(0, 0, picture.width, picture.height).data)"
    before = browser.value(mean)
    browser.value("exposure.value = 2, exposure.oninput({target: exposure})")
    check(f"{name}: exposure brightens at once", browser.value(mean) > before + 5)
    browser.value("neutral.onclick()")
    for layer in browser.value("state.layers"):
        browser.value(f"layer.value = '{layer}', layer.onchange({{target: layer}})")
        time.sleep(0.5)
        if name == "desktop" and layer in ("normal", "fluorescence"):
            browser.shoot("desktop_" + layer)
    browser.value("layer.value = 'picture', layer.onchange({target: layer})")

    # Orbit, and back.
    number = browser.value("state.frame")
    x, y = middle(browser)
    if name == "phone":
        browser.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        for i in range(1, 8):
            browser.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": x + 8 * i, "y": y + 2 * i}])
        browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    else:
        drag(browser, x, y, 120, 20)
    started = time.time()
    check(f"{name}: a drag orbits", browser.wait(f"state.moved && state.frame > {number}", 60))
    print(f"       first picture {time.time() - started:.2f} s after the drag")
    browser.shoot(name + "_orbit")
    browser.value("home.onclick()")
    check(f"{name}: the camera comes back", browser.wait("!state.moved", 60))

    # An edit with an error, and its correction.
    text = pathlib.Path(scene).read_text()
    pathlib.Path(scene).write_text(text.replace('"vfov"', '"vfow"', 1))
    check(f"{name}: an error shows its line", browser.wait("!problem.hidden && problem.textContent.includes('vfow')", 60))
    check(f"{name}: the picture stays", browser.value("frame !== null"))
    browser.shoot(name + "_error")
    pathlib.Path(scene).write_text(text)
    check(f"{name}: the correction takes the error away", browser.wait("problem.hidden", 60))


def look_at_the_rest(browser):
    """A narrow phone, and the light colours."""
    browser.size(360, 640, True)
    check("360 px: nothing is wider than the page", browser.value("document.scrollingElement.scrollWidth <= 360"))
    browser.shoot("narrow")
    browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "light"}])
    browser.size(*SIZES["desktop"], False)
    time.sleep(1)
    check("light: the page is light", browser.value("getComputedStyle(document.body).backgroundColor") == "rgb(241, 242, 244)")
    x, y = middle(browser)
    browser.mouse("mouseMoved", x + 40, y + 90, buttons=0)
    time.sleep(1)
    browser.shoot("light")
    browser.call("Emulation.setEmulatedMedia", features=[])


def look_at_the_names(browser):
    """The names of the curves stand where they cover none: at the right where an ultraviolet lamp is high at the left."""
    plot = """((low, high) => { plotSpectrum(spectrum, 280, 780, [{values: Array.from({length: 50}, (_, i) => i > 5 && i < 9 ? low : i > 44 ? high : 0.01), colour: "rgb(0 0 0)"}], [["Name", "rgb(255 0 255)"]]);
      const g = spectrum.getContext("2d"), d = g.getImageData(0, 0, spectrum.width, spectrum.height).data;
      let left = 0, right = 0;
      for (let i = 0; i < d.length; i += 4) if (d[i] > 200 && d[i + 1] < 80 && d[i + 2] > 200 && d[i + 3] > 100) i / 4 % spectrum.width < spectrum.width / 2 ? left++ : right++;
      return left > right ? "left" : "right"; })"""
    check("the names of curves leave an ultraviolet peak free", browser.value(plot + "(1, 0.01)") == "right" and browser.value(plot + "(0.01, 1)") == "left" and browser.value(plot + "(1, 1)") == "left")


def look_from_the_keyboard(browser):
    browser.value("picture.focus()")
    for key in ("ArrowLeft", "+"):
        browser.call("Input.dispatchKeyEvent", type="keyDown", key=key)
    check("keys orbit and zoom", browser.wait("state.moved", 60))
    browser.call("Input.dispatchMouseEvent", type="mouseWheel", x=middle(browser)[0], y=middle(browser)[1], deltaX=0, deltaY=200)
    time.sleep(1)
    browser.value("home.onclick()")
    check("and the camera comes back", browser.wait("!state.moved", 60))


def main():
    folder = tempfile.mkdtemp()
    shutil.copytree(pathlib.Path(SCENE).parent, folder + "/scenes")
    scene = f"{folder}/scenes/{pathlib.Path(SCENE).name}"
    options = os.environ.get("VIEW_OPTIONS", "").split()
    viewer = subprocess.Popen([os.path.abspath(STOKES), "view", scene, "--port", "0", *options], stdout=subprocess.PIPE, text=True, cwd=folder)
    url = viewer.stdout.readline().strip()
    browser = Browser()
    try:
        for name in SIZES:
            look(browser, name, url, scene)
        look_at_the_rest(browser)
        look_at_the_names(browser)
        look_from_the_keyboard(browser)
        browser.wait("!save_png.disabled", 120)
        browser.value("save_png.onclick()")
        check("a picture is saved", browser.wait("saved.textContent.includes('.png')", 60) and any(pathlib.Path(folder).glob("*.png")))
        viewer.send_signal(signal.SIGINT)
        check("Ctrl-C ends it with 0", viewer.wait(60) == 0)
        check("the page says that the program has gone", browser.wait("problem.textContent.includes('does not answer')", 20))
        problems = [p for p in browser.problems if "ERR_CONNECTION_REFUSED" not in p and "ERR_INCOMPLETE" not in p]
        check(f"no errors in the console, no foreign requests {problems}", not problems)
    finally:
        browser.close()
        viewer.kill()
        shutil.rmtree(folder, ignore_errors=True)
    sys.exit(f"{len(failures)} failures" if failures else 0)


main()
