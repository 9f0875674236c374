// A plot of spectra on a canvas, 280 to 780 nm. Knows curves, not where they come from.
"use strict";

// Roughly what a wavelength looks like, for the band under the axis only.
function wavelengthColour(nm) {
  const bump = (x, m, a, b) => Math.exp(-0.5 * ((x - m) / (x < m ? a : b)) ** 2);
  const x = 1.06 * bump(nm, 599.8, 38, 31) + 0.36 * bump(nm, 442, 16, 27), y = 0.82 * bump(nm, 568.8, 47, 40) + 0.29 * bump(nm, 530.9, 16, 31), z = 1.22 * bump(nm, 437, 12, 36) + 0.68 * bump(nm, 459, 26, 14);
  const rgb = [3.24 * x - 1.54 * y - 0.5 * z, -0.97 * x + 1.88 * y + 0.04 * z, 0.06 * x - 0.2 * y + 1.06 * z];
  return "rgb(" + rgb.map(v => Math.round(255 * srgbEncode(Math.min(1, Math.max(0, 0.9 * v))))).join(" ") + ")";
}

function niceStep(range) {
  const power = 10 ** Math.floor(Math.log10(range / 3)), by = range / 3 / power;
  return power * (by < 1.5 ? 1 : by < 3.5 ? 2 : by < 7.5 ? 5 : 10);
}

function label(v) { return v === 0 ? "0" : Math.abs(v) >= 1e4 || Math.abs(v) < 1e-3 ? v.toExponential(1) : String(+v.toPrecision(3)); }

// A colour of the style sheet, light or dark as the page is.
function ink(name) { return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim(); }

// `curves`: [{values, colour, fill}], each of equal bins from `begin` to `end` nm, drawn as steps: a bin's mean is all that is known.
function plotSpectrum(canvas, begin, end, curves, names) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = width * ratio; canvas.height = height * ratio;
  const g = canvas.getContext("2d");
  g.scale(ratio, ratio);
  g.font = "11px system-ui, sans-serif";
  const left = 44, right = 8, top = 8, bottom = 30, x = nm => left + (nm - 280) / 500 * (width - left - right);
  const most = Math.max(0, ...curves.flatMap(c => c.values)), largest = most || 1, least = Math.min(0, ...curves.flatMap(c => c.values));
  const y = v => top + (largest - v) / (largest - least) * (height - top - bottom);

  // The visible band, axes and their numbers.
  g.fillStyle = ink("band");
  g.fillRect(x(380), top, x(740) - x(380), height - top - bottom);
  for (let nm = 380; nm < 740; nm += 2) { g.fillStyle = wavelengthColour(nm); g.fillRect(x(nm), height - bottom + 1, x(nm + 2) - x(nm) + 0.5, 4); }
  g.fillStyle = ink("dim"); g.strokeStyle = ink("line"); g.textAlign = "center";
  for (const nm of [300, 400, 500, 600, 700]) g.fillText(nm, x(nm), height - 8);
  g.textAlign = "right";
  g.fillText("nm", width - right, height - 8);
  const step = niceStep(largest - least);
  for (let v = Math.ceil(least / step) * step; curves.length && v <= most * 1.0001; v += step) {
    g.fillText(label(v), left - 5, y(v) + 4);
    g.beginPath(); g.moveTo(left, y(v)); g.lineTo(width - right, y(v)); g.stroke();
  }
  for (const curve of curves) {
    const n = curve.values.length, edge = i => x(begin + (end - begin) * i / n);
    g.beginPath();
    g.moveTo(edge(0), y(0));
    curve.values.forEach((v, i) => { g.lineTo(edge(i), y(v)); g.lineTo(edge(i + 1), y(v)); });
    g.lineTo(edge(n), y(0));
    if (curve.fill) { g.fillStyle = curve.fill; g.fill(); }
    g.strokeStyle = curve.colour; g.lineWidth = 1.5; g.stroke(); g.lineWidth = 1;
  }
  // The names stand at the left, unless a curve is high there (an ultraviolet lamp's) and lower at the right.
  const high = (from, to) => Math.max(0, ...curves.flatMap(c => c.values.filter((_, i) => {
    const nm = begin + (end - begin) * (i + 0.5) / c.values.length;
    return nm >= from && nm <= to;
  })));
  const atRight = high(280, 380) > 0.6 * largest && high(680, 780) < high(280, 380);
  (names || []).forEach(([text, colour], i) => {
    const wide = g.measureText(text).width, start = atRight ? width - right - wide - 6 : left + 6;
    g.textAlign = "left";
    g.fillStyle = ink("panel") + "c0"; g.fillRect(start - 2, top + 2 + 14 * i, wide + 4, 13);
    g.fillStyle = colour; g.fillText(text, start, top + 12 + 14 * i);
  });
}
