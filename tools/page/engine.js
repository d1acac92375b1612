"use strict";
// The laboratory's C++ in WebAssembly, and its answers as arrays. Nothing is computed here.
const lab = {};

lab.byId = (id) => document.getElementById(id);
lab.bytesOf = (id) => Uint8Array.from(atob(lab.byId(id).textContent), (c) => c.charCodeAt(0));

/** Fields of the rows, in the order of laboratory.hpp. */
lab.trackFields = ["scan", "id", "status", "filter", "label", "x", "y", "vx", "vy", "ax", "ay",
  "x_pred", "y_pred", "rx", "ry", "sigma_x", "sigma_y", "s_xx", "s_xy", "s_yy", "p_xx", "p_xy",
  "p_yy", "existence", "nis", "object"];
lab.detectionFields = ["scan", "x", "y", "r_xx", "r_xy", "r_yy", "label", "origin"];
lab.scanFields = ["time", "sensor", "first", "count"];
lab.statuses = ["tentative", "confirmed", "coasting"];

/** A table of numbers with named columns: table.get(row, "x"). */
lab.Table = class {
  constructor(fields, numbers) {
    this.width = fields.length;
    this.numbers = numbers;
    this.length = numbers.length / fields.length;
    this.column = Object.fromEntries(fields.map((field, i) => [field, i]));
  }
  get(row, field) { return this.numbers[row * this.width + this.column[field]]; }
};

lab.Engine = class {
  /** @param module a WebAssembly.Module; truth: Uint8Array; recorded: text; of a series neither */
  constructor(module, truth, recorded) {
    Object.assign(this, { module, truth, recorded });
    this.start();
  }

  start() {
    // The C library would speak to a system; there is none.
    const imports = {};
    for (const { module, name } of WebAssembly.Module.imports(this.module)) {
      (imports[module] ??= {})[name] = () => 0;
    }
    this.wasm = new WebAssembly.Instance(this.module, imports).exports;
    this.wasm._initialize();
    if (!this.truth) return;
    const text = new TextEncoder().encode(this.recorded);
    const address = this.wasm.reserve(this.truth.length + text.length);
    const memory = new Uint8Array(this.wasm.memory.buffer);
    memory.set(this.truth, address);
    memory.set(text, address + this.truth.length);
    this.wasm.load(this.truth.length / 8, text.length);
  }

  textAt(address) {
    const memory = new Uint8Array(this.wasm.memory.buffer);
    return new TextDecoder().decode(memory.subarray(address, memory.indexOf(0, address)));
  }

  /** Calls with a text as input. A call that fails has a reason, and leaves a fresh instance. */
  call(name, text) {
    const bytes = new TextEncoder().encode(text);
    const address = this.wasm.reserve(bytes.length);
    new Uint8Array(this.wasm.memory.buffer).set(bytes, address);
    try {
      return this.wasm[name](bytes.length);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      const reason = this.textAt(this.wasm.message());
      this.start();
      if (this.latest !== undefined && name !== "run") this.run(this.latest);
      throw new Error(reason.replace(/^:? ?error: /, "") || error.message);
    }
  }

  table(fields, address, count) {
    const numbers = new Float64Array(this.wasm.memory.buffer, address, count * fields.length);
    return new lab.Table(fields, numbers.slice());
  }

  /** Runs sensors and trackers; the setting is a text. */
  run(setting) {
    this.call("run", setting);
    this.latest = setting;
    const { wasm } = this;
    const answers = [];
    for (let i = 0; i < wasm.answer_count(); ++i) {
      answers.push({
        scans: this.table(lab.scanFields, wasm.answer_scans(i), wasm.answer_scan_count(i)),
        tracks: this.table(lab.trackFields, wasm.tracks(i), wasm.track_count(i)),
      });
    }
    return {
      scans: this.table(lab.scanFields, wasm.scans(), wasm.scan_count()),
      detections: this.table(lab.detectionFields, wasm.detections(), wasm.detection_count()),
      words: this.textAt(wasm.words()).split("\n"),
      answers,
    };
  }

  /** metrics.json of a tracker in the latest setting, as text. */
  metrics(tracker) { return this.textAt(this.wasm.metrics(tracker)); }

  /** What the filters of a series made of it. */
  runSeries(scene) { return JSON.parse(this.textAt(this.call("run_series", scene))); }

  /** A filter that was typed, as JSON. */
  filterOf(text) { return JSON.parse(this.textAt(this.call("filter_json", text))); }

  /** What closed forms say of a filter. */
  theory(filter) { return JSON.parse(this.textAt(this.call("theory", filter))); }
};

/** The recorded truth, for drawing: what C++ reads as snapshots, here one path per object. */
lab.Truth = class {
  constructor(bytes, count) {
    const numbers = new Float64Array(bytes.buffer);
    this.times = [];
    this.bodies = [];  // of each instant: [object, x, y, angle] one after the other
    this.paths = Array.from({ length: count }, () => ({ t: [], x: [], y: [], vx: [], vy: [] }));
    for (let i = 0; i < numbers.length;) {
      const time = numbers[i++];
      this.times.push(time);
      for (let left = numbers[i++]; left > 0; --left, i += 7) {
        const path = this.paths[numbers[i]];
        path.t.push(time);
        path.x.push(numbers[i + 1]);
        path.y.push(numbers[i + 2]);
        path.vx.push(numbers[i + 3]);
        path.vy.push(numbers[i + 4]);
      }
      const bodies = numbers[i++];
      this.bodies.push(numbers.subarray(i, i + 4 * bodies));
      i += 4 * bodies;
    }
  }

  /** Where an object is: between two instants the cubic through places and velocities. */
  at(object, time) {
    const path = this.paths[object];
    const last = path.t.length - 1;
    if (last < 0 || time < path.t[0] - 1e-9 || time > path.t[last] + 0.2) return null;
    const i = lab.latest(path.t, time);
    if (i < 0) return [path.x[0], path.y[0]];
    if (i === last) return [path.x[i], path.y[i]];
    const h = path.t[i + 1] - path.t[i], s = (time - path.t[i]) / h;
    const cubic = (a, va, b, vb) => a * (1 + 2 * s) * (1 - s) ** 2 + h * va * s * (1 - s) ** 2 +
      b * s * s * (3 - 2 * s) + h * vb * s * s * (s - 1);
    return [cubic(path.x[i], path.vx[i], path.x[i + 1], path.vx[i + 1]),
      cubic(path.y[i], path.vy[i], path.y[i + 1], path.vy[i + 1])];
  }

  /** The rigid parts of all objects: [object, x, y, angle]. */
  bodiesAt(time) {
    const i = Math.max(0, lab.latest(this.times, time));
    const now = this.bodies[i], next = this.bodies[Math.min(i + 1, this.bodies.length - 1)];
    const step = this.times[i + 1] - this.times[i];
    const share = step > 0 && next.length === now.length ? (time - this.times[i]) / step : 0;
    const parts = [];
    for (let k = 0; k < now.length; k += 4) {
      const same = share > 0 && next[k] === now[k];
      const mix = (j) => same ? now[k + j] + share * (next[k + j] - now[k + j]) : now[k + j];
      parts.push([now[k], mix(1), mix(2), mix(3)]);
    }
    return parts;
  }
};

/** Index of the last of ascending numbers that is not above a value; -1 if there is none. */
lab.latest = (ascending, value, get = (i) => ascending[i], count = ascending.length) => {
  let low = 0, high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (get(middle) <= value + 1e-9) low = middle + 1; else high = middle;
  }
  return low - 1;
};
