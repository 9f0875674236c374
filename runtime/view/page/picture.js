// A picture of half floats on a canvas: decoding, exposure, tone. Knows no server; the viewer and the reports share it.
"use strict";

// A half's value by its bits. Everything a pixel becomes is looked up by its half, so exposure costs one table and one pass.
const HALF = new Float32Array(65536);
for (let bits = 0; bits < 65536; bits++) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  HALF[bits] = sign * (exponent === 31 ? (fraction ? NaN : Infinity) : exponent ? (1 + fraction / 1024) * 2 ** (exponent - 15) : fraction * 2 ** -24);
}

// The bytes of encode_frame (runtime/view/frame.h).
function decodeFrame(buffer) {
  const head = new DataView(buffer);
  if (head.getUint32(0, true) !== 0x464b5453 || head.getUint32(4, true) !== 1) throw new Error("not a frame of this version");
  const word = i => head.getUint32(4 * i, true);
  return {width: word(2), height: word(3), channels: word(4), exponent: head.getInt32(20, true), samples: word(6), number: word(7),
          halves: new Uint16Array(buffer, 32)};
}

function srgbEncode(v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055; }
// Highlights roll off instead of clipping: x below 1/2, then a smooth approach to 1.
function softShoulder(v) { return v <= 0.5 ? v : 1 - 0.25 / v; }

// Luminance in stops against 0.18, from black by blue, green and yellow to white.
function falseColour(luminance) {
  const stops = [[-8, 0, 0, 0], [-5, 40, 20, 110], [-3, 20, 90, 200], [-1, 20, 150, 120], [0, 120, 120, 120], [1, 90, 180, 40], [2.5, 240, 220, 40], [4, 240, 90, 30], [6, 255, 255, 255]];
  const x = Math.log2(Math.max(luminance, 1e-12) / 0.18);
  if (x <= stops[0][0]) return [0, 0, 0];
  for (let i = 1; i < stops.length; i++) {
    const [a, b] = [stops[i - 1], stops[i]];
    if (x <= b[0]) { const t = (x - a[0]) / (b[0] - a[0]); return [1, 2, 3].map(c => a[c] + t * (b[c] - a[c])); }
  }
  return [255, 255, 255];
}

// Linear sRGB with negative components to bytes: towards the grey of the same luminance until none is negative, as write_png does it.
function inGamut(r, g, b) {
  const low = Math.min(r, g, b), y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  if (low >= 0) return [r, g, b];
  if (!(y > 0)) return [0, 0, 0];
  const keep = y / (y - low);
  return [r, g, b].map(v => Math.max(0, y + keep * (v - y)));
}

// Paints a frame: `look` is {layer, exposure (stops), tone}. Returns the ImageData.
function paintFrame(frame, look) {
  const {width, height, halves, channels} = frame, unit = 2 ** frame.exponent, out = new ImageData(width, height), px = out.data;
  if (look.layer === "depth") return paintDepth(frame, out);
  const radiance = look.layer !== "normal" && look.layer !== "albedo";
  const scale = unit * (radiance ? 2 ** look.exposure : 1), soft = radiance && look.tone === "film";
  const curve = v => look.layer === "normal" ? 0.5 + 0.5 * v : srgbEncode(Math.min(1, Math.max(0, soft ? softShoulder(v) : v)));
  const bytes = new Uint8ClampedArray(65536);
  for (let h = 0; h < 65536; h++) { const v = HALF[h] * scale; bytes[h] = v !== v ? 0 : Math.floor(255 * curve(v) + 0.5); }
  const falsely = radiance && look.tone === "false";
  for (let i = 0, p = 0, n = width * height; i < n; i++, p += 4) {
    const a = halves[channels * i], b = halves[channels * i + 1], c = halves[channels * i + 2];
    if (falsely) {
      [px[p], px[p + 1], px[p + 2]] = falseColour(scale * (0.2126 * HALF[a] + 0.7152 * HALF[b] + 0.0722 * HALF[c]));
    } else if (radiance && ((a | b | c) & 0x8000)) {
      const rgb = inGamut(HALF[a] * scale || 0, HALF[b] * scale || 0, HALF[c] * scale || 0);
      for (let k = 0; k < 3; k++) px[p + k] = Math.floor(255 * curve(rgb[k]) + 0.5);
    } else {
      px[p] = bytes[a]; px[p + 1] = bytes[b]; px[p + 2] = bytes[c];
    }
    px[p + 3] = 255;
  }
  return out;
}

// Near is light, far is dark; nothing was hit where the depth is 0.
function paintDepth(frame, out) {
  let near = Infinity, far = 0;
  for (const h of frame.halves) { const v = HALF[h]; if (v > 0 && v < Infinity) { near = Math.min(near, v); far = Math.max(far, v); } }
  for (let i = 0; i < frame.halves.length; i++) {
    const v = HALF[frame.halves[i]], grey = v > 0 ? 40 + 200 * (far > near ? (far - v) / (far - near) : 1) : 0;
    out.data.set([grey, grey, grey, 255], 4 * i);
  }
  return out;
}

// The exposure that brings the picture's 95th percentile of luminance to 0.8.
function autoExposure(frame) {
  const {halves, channels} = frame, unit = 2 ** frame.exponent, values = [];
  const step = Math.max(1, Math.floor(halves.length / channels / 20000));
  for (let i = 0; i * channels < halves.length; i += step) {
    const at = k => HALF[halves[channels * i + Math.min(k, channels - 1)]];
    const y = unit * (0.2126 * at(0) + 0.7152 * at(1) + 0.0722 * at(2));
    if (y > 0 && y < Infinity) values.push(y);
  }
  if (!values.length) return 0;
  values.sort((a, b) => a - b);
  return Math.log2(0.8 / values[Math.floor(0.95 * (values.length - 1))]);
}
