"use strict";
// The world on a canvas: what is there, what was seen, what was made of it.

lab.Palette = class {
  /** @param hues  { dark, light, own }: the colours, and which of them stands for which object */
  constructor(hues) { this.hues = hues; this.refresh(); }
  refresh() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ["page", "panel", "line", "grid", "text", "muted", "accent", "bad"]) {
      this[name] = style.getPropertyValue(`--${name}`).trim();
    }
    this.isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  }
  /** Of an object; -1: of nobody's track. */
  of(object) {
    if (object < 0) return this.bad;
    const hues = this.isDark ? this.hues.dark : this.hues.light;
    return hues[(this.hues.own[object] ?? object) % hues.length];
  }
};

/** Steps of 1, 2 or 5 times a power of ten, about so many. */
lab.ticks = (low, high, count) => {
  if (!(high > low)) return [];
  const least = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= least * (1 - 1e-9));
  const all = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) {
    all.push(Number((n * step).toPrecision(12)));
  }
  return all;
};
/** The greatest of 1, 2 or 5 times a power of ten that is not above a value. */
lab.roundBelow = (value) => {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  return Number((power * [5, 2, 1].find((factor) => factor * power <= value * (1 + 1e-9))).toPrecision(12));
};
lab.short = (value) => !Number.isFinite(value) ? "–" : value === 0 ? "0" :
  Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4 ? value.toExponential(2)
    : String(Number(value.toPrecision(4)));

/** Where the camera looks: world [m] ↔ picture [px]. Panels share one. */
lab.Camera = class {
  constructor(world) { this.world = world; this.fit(); }
  fit() {
    const [[x0, y0], [x1, y1]] = this.world;
    this.center = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.span = [Math.max(x1 - x0, 1e-3), Math.max(y1 - y0, 1e-3)];
    this.zoom = 1;
    this.follow = -1;
  }
  /** Pixels per metre in a picture of that size. */
  scale(width, height) {
    return this.zoom * Math.min(width / this.span[0], height / this.span[1]) * 0.94;
  }
  pan(dx, dy) { this.follow = -1; this.center = [this.center[0] + dx, this.center[1] + dy]; }
  magnify(factor, around) {
    const zoom = Math.min(1e5, Math.max(0.05, this.zoom * factor));
    if (around && this.follow < 0) {
      const share = 1 - this.zoom / zoom;
      this.center = this.center.map((c, i) => c + (around[i] - c) * share);
    }
    this.zoom = zoom;
  }
};

lab.WorldView = class {
  /** @param state  what is shown: see page.js */
  constructor(canvas, state, tracker) {
    Object.assign(this, { canvas, state, tracker });
    this.pen = canvas.getContext("2d");
    this.listen();
  }

  /** As high as the world asks for, as far as it leaves room for what is below. */
  shape() {
    const [[x0, y0], [x1, y1]] = this.state.camera.world;
    const wanted = 1.06 * this.canvas.clientWidth * (y1 - y0) / Math.max(x1 - x0, 1e-3);
    const height = `${Math.round(Math.min(0.6 * innerHeight, Math.max(0.3 * innerHeight, wanted)))}px`;
    if (this.canvas.style.height !== height) this.canvas.style.height = height;
  }

  size() {
    const ratio = devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (this.canvas.width !== Math.round(width * ratio) ||
        this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    return [width, height];
  }

  toWorld(px, py) {
    const { camera } = this.state;
    return [camera.center[0] + (px - this.width / 2) / this.scale,
      camera.center[1] - (py - this.height / 2) / this.scale];
  }
  x(x) { return this.width / 2 + (x - this.state.camera.center[0]) * this.scale; }
  y(y) { return this.height / 2 - (y - this.state.camera.center[1]) * this.scale; }

  draw() {
    const { state, pen } = this;
    [this.width, this.height] = this.size();
    if (this.width === 0) return;
    const { camera, colours } = state;
    if (camera.follow >= 0) {
      camera.center = state.truth.at(camera.follow, state.time) ?? camera.center;
    }
    this.scale = camera.scale(this.width, this.height);
    pen.lineJoin = pen.lineCap = "round";
    pen.font = "13px system-ui, sans-serif";
    pen.fillStyle = colours.page;
    pen.fillRect(0, 0, this.width, this.height);
    if (state.shows("grid")) this.drawGrid();
    this.drawScenery();
    if (state.shows("sensors")) this.drawSensors();
    if (state.shows("grid")) this.drawNumbers();
    if (state.shows("truth")) this.drawTruthPaths();
    this.drawDetections();
    if (state.shows("truth")) this.drawTruth();
    const answer = state.result.answers[this.tracker];
    if (answer) this.drawTracks(answer);
    if (state.shows("names")) this.drawNames();
    this.drawScale();
  }

  line(points, close = false) { this.path(points.map(([x, y]) => [this.x(x), this.y(y)]), close); }

  path(pixels, close = false) {
    const { pen } = this;
    pen.beginPath();
    pixels.forEach(([x, y], i) => i === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y));
    if (close) pen.closePath();
  }

  /** Where lines of the grid are: values, and pixels beside them. */
  grid() {
    const [left, top] = this.toWorld(0, 0), [right, bottom] = this.toWorld(this.width, this.height);
    return [lab.ticks(left, right, Math.max(4, this.width / 110)).map((x) => [x, Math.round(this.x(x)) + 0.5]),
      lab.ticks(bottom, top, Math.max(2, this.height / 70)).map((y) => [y, Math.round(this.y(y)) + 0.5])];
  }

  drawGrid() {
    const { pen, state: { colours } } = this;
    const [upright, level] = this.grid();
    pen.strokeStyle = colours.grid;
    pen.lineWidth = 1;
    pen.beginPath();
    for (const [, at] of upright) { pen.moveTo(at, 0); pen.lineTo(at, this.height); }
    for (const [, at] of level) { pen.moveTo(0, at); pen.lineTo(this.width, at); }
    pen.stroke();
  }

  drawNumbers() {
    const { pen, state: { colours } } = this;
    const [upright, level] = this.grid();
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "center";
    const end = this.scaleBar().left - 18;
    for (const [x, at] of upright) if (at > 40 && at < end) this.write(lab.short(x), at, this.height - 5, colours.muted);
    pen.textAlign = "left";
    for (const [y, at] of level) if (at > 16 && at < this.height - 20) this.write(lab.short(y), 4, at - 3, colours.muted);
  }

  /** Letters that stand out from whatever lies below them. */
  write(text, x, y, colour) {
    const { pen, state: { colours } } = this;
    pen.lineWidth = 4;
    pen.strokeStyle = colours.page;
    pen.strokeText(text, x, y);
    pen.fillStyle = colour;
    pen.fillText(text, x, y);
  }

  /** A bar to measure with, beside the numbers of the axis. */
  scaleBar() {
    const metres = lab.roundBelow(Math.min(100, this.width / 6) / this.scale);
    const length = metres * this.scale, text = `${lab.short(metres)} m`, right = this.width - 8;
    this.pen.font = "12px system-ui, sans-serif";
    return { text, right, start: right - length, left: right - length - 12 - this.pen.measureText(text).width };
  }

  drawScale() {
    const { pen, state: { colours } } = this;
    const { text, right, start, left } = this.scaleBar(), low = this.height - 6;
    pen.globalAlpha = 0.8;
    pen.fillStyle = colours.page;
    pen.fillRect(left, low - 13, right + 5 - left, 18);
    pen.globalAlpha = 1;
    pen.strokeStyle = pen.fillStyle = colours.text;
    pen.lineWidth = 2;
    this.path([[start, low - 5], [start, low], [right, low], [right, low - 5]]);
    pen.stroke();
    pen.textAlign = "left";
    pen.fillText(text, left + 5, low);
  }

  drawScenery() {
    const { pen, state: { scenery, colours } } = this;
    if (scenery.ground_height !== undefined) {
      const [left] = this.toWorld(0, 0), [right, bottom] = this.toWorld(this.width, this.height);
      const base = scenery.ground_height;
      const profile = scenery.ground ?? [];
      const line = profile.length === 0 ? [[left, base], [right, base]]
        : [[Math.min(left, profile[0][0]), profile[0][1]], ...profile,
          [Math.max(right, profile.at(-1)[0]), profile.at(-1)[1]]];
      this.line([...line, [line.at(-1)[0], Math.min(bottom, base) - 10], [line[0][0], Math.min(bottom, base) - 10]], true);
      pen.fillStyle = colours.isDark ? "#232a22" : "#e9eee2";
      pen.fill();
      this.line(line);
      pen.strokeStyle = colours.muted;
      pen.lineWidth = 1.5;
      pen.stroke();
    }
    for (const rails of scenery.rails ?? []) {
      this.line(rails);
      pen.strokeStyle = colours.line;
      pen.lineWidth = 4;
      pen.stroke();
      pen.setLineDash([3, 5]);
      pen.strokeStyle = colours.muted;
      pen.lineWidth = 1.5;
      pen.stroke();
      pen.setLineDash([]);
    }
    pen.strokeStyle = colours.text;
    pen.lineWidth = 3;
    for (const wall of scenery.walls ?? []) { this.line(wall); pen.stroke(); }
    pen.fillStyle = colours.line;
    for (const box of scenery.boxes ?? []) { this.line(box, true); pen.fill(); pen.lineWidth = 1.5; pen.stroke(); }
  }

  drawSensors() {
    const { pen, state: { scenery, colours } } = this;
    (scenery.sensors ?? []).forEach((sensor, i) => {
      pen.strokeStyle = pen.fillStyle = colours.muted;
      pen.lineWidth = 1.2;
      pen.font = "12px system-ui, sans-serif";
      if (sensor.view.length > 0) {
        this.line(sensor.view, true);
        pen.setLineDash([8, 6]);
        pen.stroke();
        pen.setLineDash([]);
        const top = sensor.view.reduce((a, b) => b[1] > a[1] || (b[1] === a[1] && b[0] < a[0]) ? b : a);
        pen.textAlign = "left";
        const x = Math.min(Math.max(this.x(top[0]) + 4, 36), this.width - 120);
        const y = Math.min(Math.max(this.y(top[1]) + 14, 14), this.height - 8);
        pen.fillText(`seen by ${sensor.name}`, x, y + 14 * (i % 3));
      }
      if (sensor.site) {
        const [x, y] = [this.x(sensor.site[0]), this.y(sensor.site[1])];
        pen.beginPath(); pen.moveTo(x, y - 8); pen.lineTo(x + 7, y + 5); pen.lineTo(x - 7, y + 5); pen.closePath();
        pen.fill();
        pen.textAlign = "center";
        pen.fillText(sensor.name, x, y + 18);
      }
    });
  }

  drawTruthPaths() {
    const { pen, state } = this;
    pen.lineWidth = 1.2;
    pen.setLineDash([5, 4]);
    pen.globalAlpha = 0.75;
    state.truth.paths.forEach((path, object) => {
      const first = Math.max(0, lab.latest(path.t, state.time - state.trail));
      const last = lab.latest(path.t, state.time);
      if (last < first) return;
      const points = [];
      for (let i = first; i <= last; ++i) points.push([path.x[i], path.y[i]]);
      const now = state.truth.at(object, state.time);
      if (now) points.push(now);
      pen.strokeStyle = state.colours.text;
      this.line(points);
      pen.stroke();
    });
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  }

  drawTruth() {
    const { pen, state } = this;
    for (const [object, x, y, angle] of state.truth.bodiesAt(state.time)) {
      if (!state.truth.at(object, state.time)) continue;
      const { shape, length, width } = state.objects[object];
      const at = [this.x(x), this.y(y)];
      const half = Math.max(length * this.scale / 2, 3.5);
      pen.strokeStyle = state.colours.text;
      pen.fillStyle = state.colours.panel;
      pen.lineWidth = object === state.selected ? 3 : 1.5;
      pen.beginPath();
      if (shape === 0) {
        const side = Math.max(width * this.scale / 2, 2.5), c = Math.cos(angle), s = Math.sin(angle);
        for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) {
          pen.lineTo(at[0] + u * half * c - v * side * s, at[1] - u * half * s - v * side * c);
        }
        pen.closePath();
      } else if (shape === 2) {
        pen.ellipse(at[0], at[1], half * 0.85, half, 0, 0, 2 * Math.PI);
        pen.moveTo(at[0], at[1] + half); pen.lineTo(at[0], at[1] + half * 1.9);
      } else if (shape === 3) {
        for (const side of [-1, 1]) pen.ellipse(at[0] + side * half * 0.6, at[1], half * 0.45, half * 0.3, 0, 0, 2 * Math.PI);
      } else {
        pen.arc(at[0], at[1], half, 0, 2 * Math.PI);
      }
      pen.fill();
      pen.stroke();
    }
  }

  ellipse(x, y, xx, xy, yy, sigmas) {
    const half = (xx - yy) / 2, mean = (xx + yy) / 2, root = Math.hypot(half, xy);
    const angle = 0.5 * Math.atan2(2 * xy, xx - yy);
    const size = (variance) => Math.min(1e5, sigmas * Math.sqrt(Math.max(variance, 0)) * this.scale);
    this.pen.beginPath();
    this.pen.ellipse(this.x(x), this.y(y), size(mean + root), size(mean - root), -angle, 0, 2 * Math.PI);
  }

  drawDetections() {
    const { pen, state } = this;
    const { scans, detections } = state.result;
    const shown = lab.latest(null, state.time, (i) => scans.get(i, "time"), scans.length);
    const latestOf = new Map();
    for (let i = shown; i >= 0 && latestOf.size < state.sensors.length; --i) {
      if (!latestOf.has(scans.get(i, "sensor"))) latestOf.set(scans.get(i, "sensor"), i);
    }
    for (let i = shown; i >= 0; --i) {
      const age = state.time - scans.get(i, "time");
      const sensor = scans.get(i, "sensor");
      const isLatest = latestOf.get(sensor) === i;
      if (age > state.trail && !isLatest) { if (age > state.trail + 60) break; else continue; }
      const first = scans.get(i, "first");
      for (let row = first; row < first + scans.get(i, "count"); ++row) {
        const isClutter = detections.get(row, "origin") < 0;
        if (!state.shows(isClutter ? "clutter" : "detections")) continue;
        if (isClutter && !isLatest && age > 0.4) continue;  // the past of nothing is nothing
        const [x, y] = [detections.get(row, "x"), detections.get(row, "y")];
        const [px, py] = [this.x(x), this.y(y)];
        if (px < -20 || py < -20 || px > this.width + 20 || py > this.height + 20) continue;
        pen.globalAlpha = isLatest ? 1 : 0.65 * (1 - age / (state.trail + 0.01)) + 0.1;
        pen.strokeStyle = isClutter ? state.colours.bad : state.colours.muted;
        pen.lineWidth = isLatest ? 2 : 1.3;
        const size = isLatest ? 4.5 : 2.5;
        pen.beginPath();
        if (sensor % 3 === 0) {
          pen.moveTo(px - size, py - size); pen.lineTo(px + size, py + size);
          pen.moveTo(px - size, py + size); pen.lineTo(px + size, py - size);
        } else if (sensor % 3 === 1) {
          pen.moveTo(px, py - size - 1); pen.lineTo(px + size + 1, py); pen.lineTo(px, py + size + 1);
          pen.lineTo(px - size - 1, py); pen.closePath();
        } else {
          pen.moveTo(px, py - size - 1); pen.lineTo(px, py + size + 1);
          pen.moveTo(px - size - 1, py); pen.lineTo(px + size + 1, py);
        }
        pen.stroke();
        const [xx, xy, yy] = ["r_xx", "r_xy", "r_yy"].map((field) => detections.get(row, field));
        if (isLatest && (Math.abs(xy) > 0.02 * Math.sqrt(xx * yy) || xx > 1.5 * yy || yy > 1.5 * xx)) {
          this.ellipse(x, y, xx, xy, yy, 1);
          pen.lineWidth = 1;
          pen.stroke();
        }
      }
    }
    pen.globalAlpha = 1;
  }

  drawTracks(answer) {
    const { pen, state } = this;
    const { tracks, scans, paths } = answer;
    const now = lab.latest(null, state.time, (i) => scans.get(i, "time"), scans.length);
    if (now < 0) return;
    const from = state.time - state.trail;
    const live = new Set();
    const first = scans.get(now, "first");
    for (let row = first; row < first + scans.get(now, "count"); ++row) live.add(tracks.get(row, "id"));
    if (state.shows("trails")) {
      for (const [id, rows] of paths) {
        const last = lab.latest(null, now, (i) => tracks.get(rows[i], "scan"), rows.length);
        if (last < 0) continue;
        const end = scans.get(tracks.get(rows[last], "scan"), "time");
        if (end < from) continue;
        const points = [];
        let begin = last;
        while (begin > 0 && scans.get(tracks.get(rows[begin - 1], "scan"), "time") >= from) --begin;
        for (let i = begin; i <= last; ++i) {
          if (tracks.get(rows[i], "status") === 0 && !state.shows("tentative")) continue;
          points.push([tracks.get(rows[i], "x"), tracks.get(rows[i], "y")]);
        }
        if (points.length === 0) continue;
        pen.strokeStyle = state.colours.of(answer.followed[rows[last]]);
        pen.globalAlpha = live.has(id) ? 1 : 0.4;
        pen.lineWidth = id === state.selectedTrack[this.tracker] ? 4 : 2.5;
        this.line(points);
        pen.stroke();
      }
    }
    pen.globalAlpha = 1;
    const since = state.time - scans.get(now, "time");
    for (let row = first; row < first + scans.get(now, "count"); ++row) {
      const get = (field) => tracks.get(row, field);
      const status = get("status");
      if (status === 0 && !state.shows("tentative")) continue;
      const colour = status === 0 ? state.colours.muted : state.colours.of(get("object"));
      pen.strokeStyle = pen.fillStyle = colour;
      pen.lineWidth = 1.3;
      if (state.shows("gates")) {
        this.ellipse(get("x_pred"), get("y_pred"), get("s_xx"), get("s_xy"), get("s_yy"), state.gate());
        pen.globalAlpha = 0.7;
        pen.setLineDash([4, 3]);
        pen.stroke();
        pen.setLineDash([]);
        pen.globalAlpha = 1;
      }
      if (state.shows("residuals") && !Number.isNaN(get("rx"))) {
        this.line([[get("x_pred"), get("y_pred")], [get("x_pred") + get("rx"), get("y_pred") + get("ry")]]);
        pen.lineWidth = 2;
        pen.stroke();
      }
      if (state.shows("tracks")) {
        // The filter's own prediction from its latest scan to this instant.
        const at = [get("x") + since * (get("vx") + 0.5 * since * get("ax")),
          get("y") + since * (get("vy") + 0.5 * since * get("ay"))];
        const [px, py] = [this.x(at[0]), this.y(at[1])];
        const size = get("id") === state.selectedTrack[this.tracker] ? 8 : 6;
        pen.lineWidth = 2.5;
        pen.beginPath();
        pen.rect(px - size, py - size, 2 * size, 2 * size);
        if (status === 2) pen.setLineDash([3, 3]);
        pen.stroke();
        pen.setLineDash([]);
        if (get("object") < 0 && status > 0) {
          pen.font = "12px system-ui, sans-serif";
          pen.textAlign = "left";
          pen.fillText(`track ${get("id")}: nobody`, px + size + 3, py - size);
        }
      }
    }
  }

  drawNames() {
    const { pen, state } = this;
    const taken = [];
    const spots = state.objects.map((object, i) => {
      const at = state.truth.at(i, state.time);
      return at && [this.x(at[0]), this.y(at[1])];
    });
    pen.font = "600 13px system-ui, sans-serif";
    pen.textAlign = "left";
    state.objects.forEach((object, i) => {
      const at = state.truth.at(i, state.time);
      if (!at) return;
      const width = pen.measureText(object.name).width;
      const [px, py] = [this.x(at[0]), this.y(at[1])];
      if (px < 0 || py < 0 || px > this.width || py > this.height) return;
      // Ahead of the object rather than on its path.
      const before = state.truth.at(i, Math.max(0, state.time - 0.3 * Math.min(state.trail, 10)));
      const left = -width - 11, aside = before && before[0] > at[0] ? [left, 11] : [11, left];
      const inside = (value, most) => Math.max(2, Math.min(value, most));
      const places = aside.flatMap((dx) => [[dx, -11], [dx, 21]]).concat([[aside[0], -27], [aside[0], 37]])
        .map(([dx, dy]) => [inside(px + dx, this.width - width - 2), inside(py + dy, this.height - 24)]);
      // A name that is nearer to another object would be taken for that one's.
      const distance = ([x, y], [left, base]) => Math.hypot(Math.max(left - x, 0, x - left - width),
        Math.max(base - 11 - y, 0, y - base - 3));
      const isNearest = (place) => !spots.some((spot, other) => spot && other !== i &&
        distance(spot, place) < distance([px, py], place));
      const isFree = (place) => isNearest(place) && !taken.some(([x, y, w]) =>
        place[0] < x + w + 4 && place[0] + width + 4 > x && Math.abs(place[1] - y) < 15);
      // In a crowd a name that has no room is left out: two on top of each other say nothing.
      const place = places.find(isFree) ?? (i === state.selected ? places[0] : null);
      if (!place) return;
      taken.push([...place, width]);
      this.write(object.name, ...place, state.colours.of(i));
    });
  }

  /** The track, or else the object, nearest to a place in the picture. */
  pick(px, py) {
    const { state } = this;
    const answer = state.result.answers[this.tracker];
    let best = { distance: 30, object: -1, track: null };
    const now = lab.latest(null, state.time, (i) => answer.scans.get(i, "time"), answer.scans.length);
    const first = now < 0 ? 0 : answer.scans.get(now, "first");
    for (let row = first; now >= 0 && row < first + answer.scans.get(now, "count"); ++row) {
      const get = (field) => answer.tracks.get(row, field);
      if (get("status") === 0 && !state.shows("tentative")) continue;
      const distance = Math.hypot(this.x(get("x")) - px, this.y(get("y")) - py);
      if (distance < best.distance) best = { distance, object: get("object"), track: get("id") };
    }
    state.objects.forEach((_, object) => {
      const at = state.truth.at(object, state.time);
      if (!at) return;
      const distance = Math.hypot(this.x(at[0]) - px, this.y(at[1]) - py) + 6;
      if (distance < best.distance) best = { distance, object, track: null };
    });
    return best.object < 0 && best.track === null ? null : best;
  }

  listen() {
    const { canvas, state } = this;
    const fingers = new Map();
    let moved = 0;
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, place(event));
      if (fingers.size === 1) moved = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const now = place(event);
      moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
      if (fingers.size === 2) {
        const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
        const spread = (p) => Math.max(10, Math.hypot(p[0] - other[0], p[1] - other[1]));
        state.camera.magnify(spread(now) / spread(before),
          this.toWorld((now[0] + other[0]) / 2, (now[1] + other[1]) / 2));
      } else if (moved > 4) {
        state.camera.pan((before[0] - now[0]) / this.scale, (now[1] - before[1]) / this.scale);
        state.followed();
      }
      fingers.set(event.pointerId, now);
      state.redraw();
    });
    const lift = (event) => {
      const wasClick = event.type === "pointerup" && fingers.size === 1 && moved <= 4;
      fingers.delete(event.pointerId);
      if (wasClick) state.select(this.pick(...place(event)), this.tracker);
    };
    canvas.addEventListener("pointerup", lift);
    canvas.addEventListener("pointercancel", lift);
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      state.camera.magnify(1.0015 ** -event.deltaY, this.toWorld(...place(event)));
      state.redraw();
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const step = 60 / this.scale;
      const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
      if (moves[event.key]) { state.camera.pan(...moves[event.key]); state.followed(); }
      else if (event.key === "+" || event.key === "=") state.camera.magnify(1.25);
      else if (event.key === "-") state.camera.magnify(0.8);
      else return;
      event.preventDefault();
      event.stopPropagation();
      state.redraw();
    });
  }
};
