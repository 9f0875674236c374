// The comparison's page: everything is in it; nothing is fetched.
"use strict";

const $ = id => document.getElementById(id);
const data = JSON.parse($("data").textContent);
const decode = text => decodeFrame(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
const look = {layer: "picture", exposure: 0, tone: "clip"};
let current = null, tab = "Slider", spot = null;

const at = (frame, x, y) => [...Array(frame.channels).keys()].map(c => HALF[frame.halves[(y * frame.width + x) * frame.channels + c]] * 2 ** frame.exponent);

function open(index) {
  const c = data.cases[index];
  current = {...c, a: decode(c.a), b: decode(c.b), z: c.z && decode(c.z), spectra: c.spectra && {...c.spectra, a: decode(c.spectra.a), b: decode(c.spectra.b)}};
  $("verdict").textContent = c.verdict;
  $("verdict").className = c.different ? "bad" : "";
  $("label_a").textContent = "A: " + c.name_a;
  $("label_b").textContent = "B: " + c.name_b;
  const tabs = ["Slider", "A", "B", "Difference", ...(current.z ? ["z-score"] : [])];
  if (!tabs.includes(tab)) tab = "Slider";
  $("tabs").replaceChildren(...tabs.map(name => { const b = document.createElement("button"); b.textContent = name; b.onclick = () => { tab = name; paint(); }; return b; }));
  $("numbers").replaceChildren(...c.numbers.flatMap(([k, v]) => [Object.assign(document.createElement("dt"), {textContent: k}), Object.assign(document.createElement("dd"), {textContent: v})]));
  $("spectra").hidden = !current.spectra;
  $("convergence").hidden = !c.convergence.length;
  spot = c.largest;
  paint();
  read();
  plotConvergence();
}

// Signed values as blue (below) and orange (above) on grey; `full` is the value of full colour.
function paintSigned(width, height, value, full) {
  const out = new ImageData(width, height);
  for (let i = 0; i < width * height; i++) {
    const t = Math.max(-1, Math.min(1, value(i) / full)) || 0, s = Math.sqrt(Math.abs(t));
    const to = t < 0 ? [90, 160, 255] : [255, 150, 50];
    out.data.set([...to.map(v => 38 + s * (v - 38)), 255], 4 * i);
  }
  return out;
}

function paint() {
  const {a, b, z} = current, canvas = $("picture"), g = canvas.getContext("2d"), w = a.width, h = a.height;
  canvas.width = w; canvas.height = h;
  const room = $("stage").clientWidth, scale = Math.min(room / w, Math.max(360, innerHeight - 240) / h, 8);
  canvas.style.width = Math.round(w * scale) + "px"; canvas.style.height = Math.round(h * scale) + "px";
  $("split").style.width = `min(100%, ${canvas.style.width})`;
  canvas.style.imageRendering = scale >= 2 ? "pixelated" : "auto";
  for (const button of $("tabs").children) button.setAttribute("aria-pressed", button.textContent === tab);
  const slider = tab === "Slider", cut = Math.round($("split").value / 1000 * w);
  $("divider").hidden = $("split").hidden = !slider;
  $("divider").style.left = 100 * $("split").value / 1000 + "%";
  $("label_a").hidden = !slider && tab !== "A";
  $("label_b").hidden = !slider && tab !== "B";
  if (tab === "Difference") {
    const luminance = f => i => { const k = 3 * i; return 2 ** f.exponent * (0.2126 * HALF[f.halves[k]] + 0.7152 * HALF[f.halves[k + 1]] + 0.0722 * HALF[f.halves[k + 2]]); };
    const la = luminance(a), lb = luminance(b);
    g.putImageData(paintSigned(w, h, i => la(i) - lb(i), 2 ** -look.exposure), 0, 0);
  } else if (tab === "z-score") {
    g.putImageData(paintSigned(w, h, i => HALF[z.halves[i]] * 2 ** z.exponent, 5), 0, 0);
  } else {
    if (tab !== "B") g.putImageData(current.painted_a || (current.painted_a = paintFrame(a, look)), 0, 0);
    if (tab === "B") g.putImageData(current.painted_b || (current.painted_b = paintFrame(b, look)), 0, 0);
    if (slider) g.putImageData(current.painted_b || (current.painted_b = paintFrame(b, look)), 0, 0, cut, 0, w - cut, h);
  }
}

function read() {
  const {a, b, z, spectra} = current, [x, y] = spot, text = v => v.map(n => n.toPrecision(4)).join("  ");
  const lines = [`Pixel ${x}, ${y}`, "A  " + text(at(a, x, y)), "B  " + text(at(b, x, y)) + (z ? `   z ${at(z, x, y)[0].toFixed(2)}` : "")];
  $("reading").replaceChildren(...lines.map(l => Object.assign(document.createElement("div"), {textContent: l})));
  if (!spectra) return;
  const cx = Math.floor(x / spectra.edge), cy = Math.floor(y / spectra.edge);
  $("spectra_title").textContent = spectra.edge > 1 ? `Spectrum, mean of the ${spectra.edge} x ${spectra.edge} pixels here` : "Spectrum of the pixel";
  plotSpectrum($("spectrum"), spectra.begin, spectra.end, [{values: at(spectra.a, cx, cy), colour: ink("accent")}, {values: at(spectra.b, cx, cy), colour: ink("warn")}], [["A", ink("accent")], ["B", ink("warn")]]);
}

// Both axes logarithmic; the dashed line has the slope -1/2 that independent samples give, through the points' middle.
function plotConvergence() {
  const points = current.convergence.filter(p => p[1] > 0);
  $("curve").style.display = points.length < 2 ? "none" : "";
  if (points.length < 2) {
    $("slope").textContent = "Not to be seen: B has as much noise as the difference. More samples in B, or a scene with less noise, show it.";
    return;
  }
  const canvas = $("curve"), ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = width * ratio; canvas.height = height * ratio;
  const g = canvas.getContext("2d");
  g.scale(ratio, ratio);
  g.font = "11px system-ui, sans-serif";
  const logs = points.map(([n, e]) => [Math.log10(n), Math.log10(e)]), mean = k => logs.reduce((s, p) => s + p[k], 0) / logs.length;
  const [mx, my] = [mean(0), mean(1)], slope = logs.reduce((s, p) => s + (p[0] - mx) * (p[1] - my), 0) / logs.reduce((s, p) => s + (p[0] - mx) ** 2, 0);
  const x0 = logs[0][0], x1 = logs[logs.length - 1][0], ideal = x => my - 0.5 * (x - mx);
  const ys = [...logs.map(p => p[1]), ideal(x0), ideal(x1)], y0 = Math.min(...ys) - 0.1, y1 = Math.max(...ys) + 0.1;
  const left = 52, right = 14, top = 8, bottom = 24, x = v => left + (v - x0) / (x1 - x0) * (width - left - right), y = v => top + (y1 - v) / (y1 - y0) * (height - top - bottom);
  g.strokeStyle = ink("line"); g.fillStyle = ink("dim"); g.textAlign = "right";
  const marks = [];
  for (let decade = Math.floor(y0); decade <= y1; decade++) for (const m of [1, 2, 5]) { const v = decade + Math.log10(m); if (v >= y0 && v <= y1) marks.push([v, +(m * 10 ** decade).toPrecision(3)]); }
  for (const [v, name] of marks) { g.fillText(label(name), left - 6, y(v) + 4); g.beginPath(); g.moveTo(left, y(v)); g.lineTo(width - right, y(v)); g.stroke(); }
  g.textAlign = "center";
  const every = Math.ceil(points.length / 8);
  points.forEach(([n], i) => { if (i % every === 0) g.fillText(n, x(logs[i][0]), height - 6); });
  g.strokeStyle = ink("dim"); g.setLineDash([5, 4]); g.beginPath(); g.moveTo(x(x0), y(ideal(x0))); g.lineTo(x(x1), y(ideal(x1))); g.stroke(); g.setLineDash([]);
  g.strokeStyle = g.fillStyle = ink("accent"); g.lineWidth = 1.5; g.beginPath(); logs.forEach(p => g.lineTo(x(p[0]), y(p[1]))); g.stroke();
  for (const p of logs) { g.beginPath(); g.arc(x(p[0]), y(p[1]), 3, 0, 7); g.fill(); }
  $("slope").textContent = `Slope ${slope.toFixed(3)}; dashed: -1/2. Root of the mean squared difference from B, less B's own noise; where that hides it, there is no point.`;
}

function setExposure(ev) {
  look.exposure = ev;
  $("exposure_text").textContent = (ev > 0 ? "+" : "") + ev.toFixed(1) + " EV";
  if (current) { current.painted_a = current.painted_b = null; paint(); }
}

function pixelOf(e) {
  const box = $("picture").getBoundingClientRect(), {width, height} = current.a;
  return [Math.max(0, Math.min(width - 1, Math.floor((e.clientX - box.left) / box.width * width))), Math.max(0, Math.min(height - 1, Math.floor((e.clientY - box.top) / box.height * height)))];
}
$("picture").addEventListener("pointermove", e => {
  spot = pixelOf(e);
  if (e.buttons & 1 && tab === "Slider") { $("split").value = 1000 * spot[0] / current.a.width; paint(); }
  read();
});
$("picture").addEventListener("pointerdown", e => { spot = pixelOf(e); if (tab === "Slider") { $("split").value = 1000 * spot[0] / current.a.width; paint(); } read(); });
$("split").oninput = paint;
$("exposure").oninput = e => setExposure(+e.target.value);
$("tone").onchange = e => { look.tone = e.target.value; setExposure(look.exposure); };
$("case").onchange = e => open(+e.target.value);
const redraw = () => { paint(); read(); plotConvergence(); };
addEventListener("resize", redraw);
matchMedia("(prefers-color-scheme: light)").addEventListener("change", redraw);

document.title = $("title").textContent = data.title;
$("case").replaceChildren(...data.cases.map((c, i) => new Option(c.name, i)));
$("case").hidden = data.cases.length < 2;
setExposure(0);
open(0);
