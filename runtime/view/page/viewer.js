// The live page: what the server tells becomes a picture, a spectrum and numbers; what the hand does becomes requests.
"use strict";

const $ = id => document.getElementById(id);
const canvas = $("picture"), stage = $("stage");
let state = null, frame = null, spot = null, pinned = false;
const look = {layer: "picture", exposure: 0, tone: "clip"};

// ---- One request of a sort at a time; while it is away, the last wish waits.
function latest(send) {
  let away = false, waiting = false;
  return async function wish() {
    if (away) { waiting = true; return; }
    away = true;
    try { await send(); } catch (error) { /* the connection's own message says it */ }
    away = false;
    if (waiting) { waiting = false; wish(); }
  };
}

async function post(path, body) {
  const answer = await fetch(path, {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body || {})});
  const json = await answer.json();
  if (!answer.ok) throw new Error(json.error);
  return json;
}

// ---- The picture
function paint() {
  if (!frame) return;
  canvas.width = frame.width; canvas.height = frame.height;
  canvas.getContext("2d").putImageData(paintFrame(frame, look), 0, 0);
  $("hint").hidden = false;
  showWaiting();
  fit();
}

// Before the first picture: what takes its time, and for how long already.
let preparing = 0, waitingTimer = 0;
function showWaiting() {
  const waits = !frame && state && state.phase === "preparing";
  $("waiting").hidden = !waits;
  if (!waits) return;
  preparing = preparing || Date.now();
  const seconds = Math.round((Date.now() - preparing) / 1000);
  $("waiting").textContent = `Preparing kernels${seconds > 1 ? ", " + (seconds < 60 ? seconds + " s" : clock(seconds)) : ""}\nOnce for each kind of scene; the next time they are there.`;
  clearTimeout(waitingTimer);
  waitingTimer = setTimeout(showWaiting, 1000);
}

const fetchFrame = latest(async () => {
  const layer = look.layer, answer = await fetch("/frame?layer=" + layer);
  if (!answer.ok) return;
  const got = decodeFrame(await answer.arrayBuffer());
  if (layer !== look.layer) return;
  frame = got;
  paint();
  fetchSpectrum();
});

// As large as the stage allows; small pictures keep square pixels, coarse previews are smoothed.
function fit() {
  if (!state || !state.size[0]) return;
  const [w, h] = state.size, phone = matchMedia("(max-width: 760px)").matches;
  const room = phone ? [stage.clientWidth, innerHeight * 0.62] : [stage.clientWidth, stage.clientHeight];
  const scale = Math.min(room[0] / w, room[1] / h, 8);
  canvas.style.width = Math.round(w * scale) + "px";
  canvas.style.height = Math.round(h * scale) + "px";
  canvas.style.imageRendering = scale >= 2 && frame && frame.width === w ? "pixelated" : "auto";
  placeMark();
}

// ---- What the server tells
const phases = {preparing: "Preparing kernels", preview: "Preview", rendering: "Rendering", stopped: "Stopped", done: "Done", failed: "Failed"};
const clock = s => s >= 3600 ? `${Math.floor(s / 3600)} h ${Math.round(s / 60) % 60} min` : s >= 60 ? `${Math.floor(s / 60)} min ${Math.round(s) % 60} s` : `${s.toFixed(s < 10 ? 1 : 0)} s`;
const layerNames = {picture: "Picture", fluorescence: "Excited light", reflected: "Reflected light", albedo: "Albedo", normal: "Normal", depth: "Depth", noise: "Noise (standard error)"};

function showState(next) {
  const fresh = !state || state.layers.join() !== next.layers.join();
  state = next;
  $("title").textContent = state.title;
  const percent = Math.round(100 * state.progress);
  document.title = (state.phase === "rendering" ? percent + " % " : "") + state.title + " - Stokes";
  const share = state.phase === "rendering" || state.phase === "stopped" ? ` ${percent} %` : "";
  const left = state.phase === "rendering" && state.samples ? `, ${clock(state.seconds_left)} left` : "";
  $("phase").replaceChildren(phases[state.phase] + share, Object.assign(document.createElement("span"), {textContent: left}));
  $("progress").firstElementChild.style.width = 100 * state.progress + "%";
  const running = state.phase === "rendering" || state.phase === "preview";
  $("stop").textContent = running || state.phase === "preparing" ? "Stop" : state.phase === "done" ? "More samples" : "Resume";
  $("stop").disabled = state.phase === "preparing" || state.phase === "failed";
  $("home").disabled = !state.moved;
  for (const id of ["save_exr", "save_png"]) $(id).disabled = !state.samples;
  if (fresh) {
    $("layer").replaceChildren(...state.layers.map(l => new Option(layerNames[l] || l, l)));
    if (!state.layers.includes(look.layer)) { look.layer = "picture"; fetchFrame(); }
    $("layer").value = look.layer;
    $("spectrum_title").textContent = "Radiance per nm";
  }
  showFacts();
  showProblem();
  showWaiting();
  fit();
}

function showFacts() {
  const facts = [["Samples", `${state.samples} of ${state.samples_total}`]];
  facts.push(["Speed", state.samples_per_second ? (state.samples_per_second / 1e6).toPrecision(3) + " M samples/s" : "-"]);
  facts.push(["Time left", state.phase === "done" ? "none" : state.samples ? clock(state.seconds_left) : "-"]);
  facts.push(["Size", state.size[0] ? state.size.join(" x ") : "-"], ["Device", state.device]);
  if (state.build_seconds >= 0.1) facts.push(["Kernels built in", clock(state.build_seconds)]);
  $("facts").replaceChildren(...facts.flatMap(([name, value]) => [Object.assign(document.createElement("dt"), {textContent: name}), Object.assign(document.createElement("dd"), {textContent: value})]));
}

function showProblem(lost) {
  const box = $("problem"), e = state && state.error;
  box.hidden = !lost && !e && !(state && state.warnings.length);
  box.replaceChildren();
  if (lost) { box.append("The program does not answer. When it runs again, this page goes on by itself."); return; }
  if (!e) { if (state) box.append(state.warnings.join("\n")); return; }
  const name = e.file ? e.file.split("/").pop() : "";
  box.append(e.line ? `${name}, line ${e.line}: ${e.text}` : e.message);
  if (e.source !== undefined) {
    const code = document.createElement("pre");
    code.textContent = `${e.line} | ${e.source.replace(/\t/g, " ")}\n${" ".repeat(String(e.line).length)} | ${" ".repeat(Math.max(0, e.column - 1))}^`;
    box.append(code);
    // The mark stays in sight where the line is longer than the page.
    code.scrollLeft = code.scrollWidth * (e.column + String(e.line).length + 3) / code.textContent.indexOf("\n") - code.clientWidth / 2;
  }
}

const events = new EventSource("/events");
events.addEventListener("state", e => showState(JSON.parse(e.data)));
events.addEventListener("frame", fetchFrame);
events.onerror = () => showProblem(true);
events.onopen = () => showProblem(false);

// ---- The camera: movements add up while a request is away
let move = null;
const sendMove = latest(async () => { const m = move; move = null; if (m) await post("/camera", m); });
function addMove(m) {
  move = move || {around: 0, up: 0, right: 0, lift: 0, zoom: 1};
  for (const k of ["around", "up", "right", "lift"]) move[k] += m[k] || 0;
  move.zoom *= m.zoom || 1;
  $("hint").style.opacity = 0;
  sendMove();
}

const fingers = new Map();
let travelled = 0, pinch = 0;
canvas.addEventListener("contextmenu", e => e.preventDefault());
canvas.addEventListener("pointerdown", e => {
  canvas.setPointerCapture(e.pointerId);
  fingers.set(e.pointerId, [e.clientX, e.clientY]);
  travelled = fingers.size > 1 ? 99 : 0;
  pinch = spread();
  canvas.classList.add("dragging");
});
function spread() {
  const [a, b] = [...fingers.values()];
  return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
}
canvas.addEventListener("pointermove", e => {
  const from = fingers.get(e.pointerId);
  if (!from) { if (e.pointerType === "mouse" && !pinned) pointAt(e); return; }
  const dx = (e.clientX - from[0]) / canvas.clientHeight, dy = (e.clientY - from[1]) / canvas.clientHeight;
  travelled += Math.hypot(e.clientX - from[0], e.clientY - from[1]);
  if (travelled < 4) return;
  fingers.set(e.pointerId, [e.clientX, e.clientY]);
  const share = 1 / fingers.size, now = spread();
  if (fingers.size > 1 || e.shiftKey || e.buttons > 1) addMove({right: -dx * share, lift: dy * share, zoom: pinch && now ? pinch / now : 1});
  else addMove({around: -dx * 3, up: dy * 3});
  pinch = now;
});
function lift(e) {
  if (fingers.delete(e.pointerId) && travelled < 4 && e.type === "pointerup") { pinned = !(pinned && e.pointerType === "mouse"); pointAt(e); }
  if (!fingers.size) canvas.classList.remove("dragging");
  pinch = spread();
}
canvas.addEventListener("pointerup", lift);
canvas.addEventListener("pointercancel", lift);
canvas.addEventListener("wheel", e => { e.preventDefault(); addMove({zoom: Math.exp(Math.max(-100, Math.min(100, e.deltaMode ? e.deltaY * 30 : e.deltaY)) * 0.0015)}); }, {passive: false});
canvas.addEventListener("keydown", e => {
  const keys = {ArrowLeft: {around: -0.1}, ArrowRight: {around: 0.1}, ArrowUp: {up: 0.1}, ArrowDown: {up: -0.1}, "+": {zoom: 0.9}, "-": {zoom: 1 / 0.9}};
  if (keys[e.key]) { e.preventDefault(); addMove(keys[e.key]); }
});
$("home").onclick = () => post("/camera", {reset: true});

// ---- The spectrum under the mouse
function pointAt(e) {
  const box = canvas.getBoundingClientRect();
  if (!state || !box.width) return;
  const x = (e.clientX - box.left) / box.width * state.size[0], y = (e.clientY - box.top) / box.height * state.size[1];
  spot = [Math.min(state.size[0] - 1, Math.max(0, Math.floor(x))), Math.min(state.size[1] - 1, Math.max(0, Math.floor(y)))];
  placeMark();
  fetchSpectrum();
}

function placeMark() {
  $("mark").hidden = !pinned || !spot;
  if (!pinned || !spot) return;
  $("mark").style.left = canvas.offsetLeft + (spot[0] + 0.5) / state.size[0] * canvas.clientWidth + "px";
  $("mark").style.top = canvas.offsetTop + (spot[1] + 0.5) / state.size[1] * canvas.clientHeight + "px";
}

const fetchSpectrum = latest(async () => {
  if (!spot) return;
  const answer = await fetch(`/spectrum?x=${spot[0] + 0.5}&y=${spot[1] + 0.5}&radius=${$("area").value}`);
  if (answer.ok) showSpectrum(await answer.json());
});

function showSpectrum(p) {
  const curves = [], names = [];
  if (p.spectrum.length) {
    curves.push({values: p.spectrum, colour: ink("text"), fill: ink("accent") + "30"});
    if (p.fluorescent.length) {
      curves.push({values: p.fluorescent, colour: ink("excited"), fill: ink("excited") + "50"});
      names.push(["All light", ink("text")], ["Excited", ink("excited")]);
    }
  }
  plotSpectrum($("spectrum"), p.begin, p.end, curves, names);
  const text = v => v === 0 ? "0" : Math.abs(v) < 1e-3 || Math.abs(v) >= 1e4 ? v.toExponential(2) : v.toPrecision(3);
  const hold = !matchMedia("(hover: hover)").matches ? "" : pinned ? ", held: click to let go" : ", click to hold";
  const rows = [[+$("area").value ? "Around" : "Pixel", `${spot[0]}, ${spot[1]}${hold}`], ["R, G, B", ...p.rgb.map(text)]];
  if (p.samples > 1) rows.push(["Noise", ...p.error.map(text)]);
  if (p.fluorescent.length && p.energy > 0) rows.push(["Excited", `${(100 * p.fluorescent_energy / p.energy).toFixed(1)} % of the energy`]);
  if (!p.spectrum.length) rows.push(["Spectrum", state.spectral ? "not known yet" : "none: RGB mode, or the picture is too large"]);
  $("reading").replaceChildren(...rows.flatMap(row => row.map((cell, i) => {
    const span = Object.assign(document.createElement("span"), {textContent: cell});
    if (i === 1 && row.length === 2) span.className = "wide";
    if (i > 0) span.style.color = "var(--text)";
    return span;
  })));
}

// ---- Controls
function setExposure(ev) {
  look.exposure = Math.max(-30, Math.min(30, ev));
  $("exposure").value = look.exposure;
  $("exposure_text").textContent = (look.exposure > 0 ? "+" : "") + look.exposure.toFixed(1) + " EV";
  paint();
}
$("exposure").oninput = e => setExposure(+e.target.value);
$("auto").onclick = () => frame && setExposure(Math.round(10 * autoExposure(frame)) / 10);
$("neutral").onclick = () => { look.tone = $("tone").value = "clip"; setExposure(0); };
$("tone").onchange = e => { look.tone = e.target.value; paint(); };
$("layer").onchange = e => { look.layer = e.target.value; fetchFrame(); };
$("stop").onclick = () => post(state.phase === "rendering" || state.phase === "preview" ? "/stop" : "/resume");

async function save(format) {
  const exposure = look.exposure;
  try {
    const {path} = await post("/save", {format, exposure});
    const link = Object.assign(document.createElement("a"), {textContent: "Download it", href: `/picture.${format}?exposure=${exposure}`});
    $("saved").replaceChildren(`Saved ${path}. `, link);
  } catch (error) {
    $("saved").textContent = "Not saved: " + error.message;
  }
}
$("save_exr").onclick = () => save("exr");
$("save_png").onclick = () => save("png");
$("copy").onclick = async () => {
  const text = JSON.stringify(state.camera).slice(1, -1);
  try { await navigator.clipboard.writeText(text); $("saved").textContent = "Copied; it goes into the scene's \"camera\"."; }
  catch (error) { $("saved").textContent = text; }
};

$("area").onchange = fetchSpectrum;
addEventListener("resize", () => { fit(); fetchSpectrum(); });
matchMedia("(prefers-color-scheme: light)").addEventListener("change", fetchSpectrum);
setExposure(0);
plotSpectrum($("spectrum"), 280, 780, [], []);
