"use strict";
// Curves over time beside the view; the cursor is the scene's time, a click goes there.

lab.Plot = class {
  /**
   * @param curves  () => [{ colour, width, dash, dots, points: [[t, value]…] }], breaks where a value is NaN
   * @param bands   () => [{ colour, points: [[t, low, high]…] }]
   * @param empty   what is said where there is nothing to be drawn
   * @param around  values are around zero: a few far ones do not set the scale, but are said
   */
  constructor(canvas, state, { unit, floor, xUnit, curves, bands, empty, around }) {
    Object.assign(this, { canvas, state, unit, floor, xUnit: xUnit ?? " s", curves, bands: bands ?? (() => []), empty: empty ?? "", around });
    this.pen = canvas.getContext("2d");
    this.still = document.createElement("canvas");
    const seek = (event) => {
      if (event.type === "pointermove" && event.buttons === 0) return;
      const box = canvas.getBoundingClientRect();
      const share = (event.clientX - box.left - this.left) / (this.right - this.left);
      state.seek(Math.min(1, Math.max(0, share)) * state.duration);
    };
    canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); seek(event); });
    canvas.addEventListener("pointermove", seek);
  }

  /** Draws the curves into a picture of their own, which draw() puts below the cursor. */
  refresh() {
    const ratio = devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0) return;
    this.canvas.width = this.still.width = Math.round(width * ratio);
    this.canvas.height = this.still.height = Math.round(height * ratio);
    this.ratio = ratio;
    [this.left, this.right, this.top, this.bottom] = [44, width - 12, 8, height - 22];
    const curves = this.curves(), bands = this.bands();
    let low = this.floor ?? Infinity, high = -Infinity;
    for (const { points } of curves) {
      for (const [, value] of points) {
        if (!Number.isFinite(value)) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    const isEmpty = !(high > -Infinity);
    const far = this.around ? lab.farValues(curves) : null;
    if (far) [low, high] = [Math.max(low, -far.limit), Math.min(high, far.limit)];
    if (isEmpty) [low, high] = [0, 1];
    // A size begins at nothing, unless that leaves what varies a strip at the top.
    const isSize = this.floor === undefined && low >= 0 && low < high - low && bands.length === 0;
    if (isSize) low = 0;
    if (this.unit === "1") [low, high] = [0, 1.02];
    if (high === low) { high += 0.5; if (this.floor === undefined) low -= 0.5; }
    const margin = this.unit === "1" ? 0 : 0.05 * (high - low);
    high += margin;
    if (this.floor === undefined && !isSize) low -= margin;
    this.x = (t) => this.left + (this.right - this.left) * t / this.state.duration;
    this.y = (v) => this.bottom - (this.bottom - this.top) * (v - low) / (high - low);

    const { state: { colours } } = this;
    const pen = this.still.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = colours.page;
    pen.fillRect(0, 0, width, height);
    pen.font = "12px system-ui, sans-serif";
    pen.lineWidth = 1;
    pen.strokeStyle = colours.grid;
    pen.fillStyle = colours.muted;
    pen.textAlign = "right";
    for (const value of lab.ticks(low, high, Math.max(2, height / 45))) {
      const y = Math.round(this.y(value)) + 0.5;
      pen.beginPath(); pen.moveTo(this.left, y); pen.lineTo(this.right, y); pen.stroke();
      pen.fillText(lab.short(value), this.left - 6, y + 4);
    }
    pen.textAlign = "center";
    for (const t of lab.ticks(0, this.state.duration, Math.max(3, width / 90))) {
      const x = Math.round(this.x(t)) + 0.5;
      pen.beginPath(); pen.moveTo(x, this.top); pen.lineTo(x, this.bottom); pen.stroke();
      pen.fillText(`${lab.short(t)}${this.xUnit}`, Math.min(x, this.right - 12), this.bottom + 15);
    }
    pen.save();
    pen.beginPath(); pen.rect(this.left - 3, this.top - 3, this.right - this.left + 6, this.bottom - this.top + 6); pen.clip();
    for (const { colour, points } of bands) {
      pen.fillStyle = colour;
      pen.globalAlpha = 0.16;
      pen.beginPath();
      points.forEach(([t, , top]) => pen.lineTo(this.x(t), this.y(top)));
      [...points].reverse().forEach(([t, bottom]) => pen.lineTo(this.x(t), this.y(bottom)));
      pen.fill();
      pen.globalAlpha = 1;
    }
    pen.lineJoin = pen.lineCap = "round";
    for (const { colour, width: thick, dash, dots, points } of curves) {
      pen.strokeStyle = pen.fillStyle = colour;
      if (dots) {
        for (const [t, value] of points) {
          pen.beginPath(); pen.arc(this.x(t), this.y(value), 2.6, 0, 2 * Math.PI); pen.fill();
        }
        continue;
      }
      pen.lineWidth = thick ?? 1.5;
      pen.setLineDash(dash ?? []);
      pen.beginPath();
      let isDown = false;
      for (const [t, value] of points) {
        if (!Number.isFinite(value)) { isDown = false; continue; }
        if (!isDown) pen.moveTo(this.x(t), this.y(value));
        pen.lineTo(this.x(t), this.y(value));  // a value between gaps is a dot
        isDown = true;
      }
      pen.stroke();
    }
    pen.restore();
    if (far) {
      const said = `${far.count} beyond, up to ${lab.short(far.most)}`;
      pen.fillStyle = colours.page;
      pen.fillRect(this.right - 8 - pen.measureText(said).width, this.top, pen.measureText(said).width + 8, 17);
      pen.fillStyle = colours.muted;
      pen.textAlign = "right";
      pen.fillText(said, this.right - 4, this.top + 12);
    }
    if (isEmpty) {
      pen.fillStyle = colours.muted;
      pen.textAlign = "center";
      pen.fillText(this.empty, (this.left + this.right) / 2, (this.top + this.bottom) / 2, this.right - this.left);
    }
    this.draw();
  }

  draw() {
    if (!this.x || this.canvas.width !== this.still.width) return;  // not shown yet
    const { pen } = this;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.drawImage(this.still, 0, 0);
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    const x = this.x(this.state.time);
    pen.strokeStyle = this.state.colours.text;
    pen.lineWidth = 1.5;
    pen.beginPath(); pen.moveTo(x, this.top); pen.lineTo(x, this.bottom); pen.stroke();
  }
};

/** Values that are few and so far from zero that the others could not be seen beside them, if any. */
lab.farValues = (curves) => {
  const sizes = curves.flatMap(({ points }) => points.map(([, value]) => Math.abs(value)))
    .filter(Number.isFinite).sort((a, b) => a - b);
  const usual = sizes[Math.floor(0.98 * sizes.length)] ?? 0;
  const most = sizes.at(-1), limit = 2 * usual;
  if (!(usual > 0 && most > 2 * limit)) return null;
  return { limit, most, count: sizes.filter((size) => size > limit).length };
};

/** Error of every object's track: distance of estimate and truth at each scan. */
lab.errorCurves = (state) => {
  const curves = [];
  state.result.answers.forEach((answer, which) => {
    for (const [object, points] of answer.errors) {
      if (state.selected >= 0 && object !== state.selected) continue;
      curves.push({ colour: state.colours.of(object), dash: which === 1 ? [5, 4] : [], points });
    }
  });
  return curves;
};

/** Of the selected track: one column over time, NaN where there is no value. */
lab.trackCurve = (state, which, value, dash) => {
  const answer = state.result.answers[which];
  const rows = answer?.paths.get(state.selectedTrack[which]);
  if (!rows) return null;
  const colour = state.colours.of(answer.followed[rows.at(-1)]);
  const points = rows.map((row) => [answer.scans.get(answer.tracks.get(row, "scan"), "time"),
    value((field) => answer.tracks.get(row, field))]);
  return { colour, dash, points };
};

/** Of every track, or of the selected ones, a value over time. */
lab.curvesOfTracks = (state, value) => state.result.answers.flatMap((answer, which) =>
  [...answer.paths].filter(([id]) => state.selected < 0 || id === state.selectedTrack[which])
    .map(([id, rows]) => ({
      colour: state.colours.of(answer.followed[rows.at(-1)]),
      dash: which === 1 ? [5, 4] : [],
      points: rows.map((row) => [answer.scans.get(answer.tracks.get(row, "scan"), "time"),
        value((field) => answer.tracks.get(row, field))]),
    })));

/** Of the selected track both coordinates, else of every track the size. */
lab.residualCurves = (state) => state.selected >= 0 || state.selectedTrack[0] !== null
  ? ["rx", "ry"].flatMap((field, axis) =>
    [lab.trackCurve(state, 0, (get) => get(field), axis === 1 ? [2, 3] : [])].filter(Boolean))
  : lab.curvesOfTracks(state, (get) => Math.hypot(get("rx"), get("ry")));

/** Where 95 % of the residuals are to be expected. */
lab.residualBand = (state) => {
  const curve = lab.trackCurve(state, 0, (get) => 1.96 * Math.sqrt(Math.max(get("s_xx"), 0)), []);
  return curve ? [{ colour: curve.colour, points: curve.points.map(([t, half]) => [t, -half, half]) }] : [];
};

lab.existenceCurves = (state) => lab.curvesOfTracks(state, (get) => get("existence"));
