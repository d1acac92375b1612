"use strict";
// Puts the parts together: time, what is selected, and what is computed when.
(async () => {
  const { byId } = lab;
  const scene = JSON.parse(byId("lab-scene").textContent);
  const recorded = byId("lab-recorded").textContent;
  const { objects } = JSON.parse(recorded);
  const truthBytes = lab.bytesOf("lab-truth");
  const gap = 2.5 / Math.min(...scene.sensors.map((sensor) => sensor.rate));  // [s] in which a curve breaks

  let engine;
  try {
    engine = new lab.Engine(await WebAssembly.compile(lab.bytesOf("lab-wasm")), truthBytes, recorded);
  } catch (error) {
    byId("lab-failure").hidden = false;
    byId("lab-failure").textContent = `The tracker cannot run in this browser: ${error.message}`;
    return;
  }
  byId("lab-live").hidden = false;

  const layers = { truth: true, names: true, detections: true, clutter: true, tracks: true, trails: true,
    gates: true, residuals: true, tentative: false, sensors: true, grid: true };
  const state = lab.state = {
    scene, objects, duration: scene.duration, scenery: scene.scenery,
    truth: new lab.Truth(truthBytes, objects.length),
    camera: new lab.Camera(scene.scenery.world), colours: new lab.Palette(scene.palette),
    time: 0, trail: 3, speed: 1, isPlaying: false,
    selected: -1, selectedTrack: [null, null], result: null,
    shows: (layer) => layers[layer],
    get sensors() { return controls.sensors; },
    gate: () => controls.trackers[0].gate,
    seek: (time) => { state.time = Math.min(state.duration, Math.max(0, time)); redraw(); say(); },
    select, followed: () => { byId("lab-follow").value = "-1"; }, redraw,
  };
  const controls = lab.controls = new lab.Controls(scene, () => { isStale = true; redraw(); });
  const views = lab.views = [0, 1].map((i) => new lab.WorldView(byId(`lab-view-${i}`), state, i));
  const plots = [
    new lab.Plot(byId("lab-error"), state, { floor: 0, around: true, curves: () => lab.errorCurves(state), empty: "no confirmed track" }),
    new lab.Plot(byId("lab-residual"), state, { around: true, curves: () => lab.residualCurves(state), bands: () => lab.residualBand(state), empty: "no track" }),
    new lab.Plot(byId("lab-existence"), state, { unit: "1", floor: 0, curves: () => lab.existenceCurves(state), empty: "no track" }),
  ];
  let isStale = true;      // the result is not that of the setting
  let isDrawn = false;     // the picture is that of the state
  let scoresAreDue, plotsAreDue;

  // ---- computing

  /** What the drawing needs of an answer: the rows of each track, the errors of each object. */
  function index(answer) {
    const { tracks, scans } = answer;
    answer.paths = new Map();
    answer.errors = new Map();
    answer.followed = [];  // by row: whom the track follows, or has followed before
    for (let row = 0; row < tracks.length; ++row) {
      const id = tracks.get(row, "id"), object = tracks.get(row, "object");
      if (!answer.paths.has(id)) answer.paths.set(id, []);
      const path = answer.paths.get(id);
      answer.followed.push(object < 0 && path.length > 0 ? answer.followed[path.at(-1)] : object);
      path.push(row);
      if (object < 0 || tracks.get(row, "status") === 0) continue;
      const time = scans.get(tracks.get(row, "scan"), "time");
      const way = state.truth.paths[object];
      const i = lab.latest(way.t, time);
      if (i < 0 || way.t[i] < time - 1e-6) continue;
      if (!answer.errors.has(object)) answer.errors.set(object, []);
      const errors = answer.errors.get(object);
      if (errors.length > 0 && errors.at(-1)[0] === time) continue;
      if (errors.length > 0 && time - errors.at(-1)[0] > gap) errors.push([time, NaN]);
      errors.push([time, Math.hypot(tracks.get(row, "x") - way.x[i], tracks.get(row, "y") - way.y[i])]);
    }
  }

  /** Where they are told whose a detection is, nothing is to be doubted. */
  function tracksKnowExistence(tracks) {
    for (let row = 0; row < tracks.length; ++row) {
      if (!Number.isNaN(tracks.get(row, "existence"))) return true;
    }
    return false;
  }

  function compute() {
    isStale = false;
    byId("lab-problem").textContent = "";
    if (controls.typed !== undefined) takeTyped();
    const start = performance.now();
    try {
      state.result = engine.run(controls.setting());
    } catch (error) {
      byId("lab-problem").textContent = error.message;
      showTheory();
      return;
    }
    showTheory();
    state.result.answers.forEach(index);
    choose();
    lab.computingTime = performance.now() - start;
    byId("lab-existence").parentElement.hidden = !state.result.answers.some(({ tracks }) => tracksKnowExistence(tracks));
    // While a slider moves, the world is drawn anew each time and the plots now and then.
    plotsAreDue ??= setTimeout(() => { plotsAreDue = undefined; for (const plot of plots) plot.refresh(); }, 90);
    clearTimeout(scoresAreDue);
    scoresAreDue = setTimeout(score, 180);
  }

  /** A filter that was typed is asked for in C++'s own reader before it replaces the one before. */
  function takeTyped() {
    const text = controls.typed;
    controls.typed = undefined;
    try {
      controls.filter = engine.filterOf(text);
      controls.showFilter();
    } catch (error) {
      byId("lab-problem").textContent = error.message;
    }
  }

  function showTheory() {
    const verdict = byId("lab-verdict"), facts = byId("lab-facts");
    let theory;
    try {
      theory = engine.theory(JSON.stringify(controls.filter));
    } catch (error) {
      verdict.dataset.stable = false;
      verdict.textContent = error.message;
      facts.replaceChildren();
      return;
    }
    if (!theory.settles) {
      verdict.dataset.stable = true;
      verdict.textContent = "Several models: the gains follow what the detections say of each.";
      facts.replaceChildren();
      return;
    }
    verdict.dataset.stable = theory.stable;
    verdict.textContent = theory.stable ? `Stable, ${theory.damping} damped.` : "Unstable.";
    const { order, sigma, dt } = theory;
    const unit = ["m/s", "m/s²", "m/s³"][order], what = ["a velocity", "an acceleration", "a jerk"][order];
    const rows = [[`gains at ${lab.short(dt)}\u00a0s, σ\u00a0${lab.short(sigma)}\u00a0m`, theory.gains]];
    if (theory.stable) {
      rows.push(["noise left", `${lab.short(Math.sqrt(theory.vrf.x) * sigma)}\u00a0m of ${lab.short(sigma)}\u00a0m`],
        [`lag behind ${what} of 1 ${unit}`, `${lab.short(theory.lag.x)} m`],
        ["forgets a start in", `${lab.short(theory.settling_updates)}\u00a0scans, ${lab.short(theory.settling_updates * dt)}\u00a0s`]);
    }
    facts.replaceChildren(...rows.flatMap(([name, value]) => {
      const [dt_, dd] = [document.createElement("dt"), document.createElement("dd")];
      dt_.textContent = name;
      dd.textContent = value;
      return [dt_, dd];
    }));
  }

  const columns = [
    ["RMSE [m]", ["rmse"]], ["predicted", ["predicted"]],
    ["raw", ["raw"]], ["best fixed gains", ["best_fixed_gains"]],
    ["bound (CRLB)", ["crlb"]], ["|residual|", ["mai"]], ["used", ["detections_used"]], ["missed", ["detections_missed"]],
  ];
  const value = (from, keys) => keys.map((key) => from[key]).find((v) => v !== undefined && v !== null);

  function cell(tag, text, title) {
    const node = document.createElement(tag);
    node.textContent = text;
    if (title !== undefined) node.title = title;
    if (tag === "th") node.scope = "col";
    return node;
  }

  function sideNames() {
    return controls.trackers.length === 1 ? [""] : ["left", controls.otherName || "right"];
  }

  function score() {
    const texts = state.result.answers.map((_, i) => engine.metrics(i));
    state.metrics = texts;
    const reports = texts.map((text) => JSON.parse(text));
    const table = byId("lab-scores");
    table.classList.add("ends-in-words");
    const used = columns.filter(([, keys]) => reports[0].objects.some((object) => value(object, keys) !== undefined));
    const head = document.createElement("thead"), body = document.createElement("tbody");
    const headings = document.createElement("tr");
    // Numbers first: on a small screen the rest is to the right.
    headings.append(cell("th", "object"), ...used.map(([name]) => cell("th", name)), cell("th", "filter"));
    head.append(headings);
    reports[0].objects.forEach((_, i) => reports.forEach((report, which) => {
      const object = report.objects[i];
      const row = document.createElement("tr");
      const name = cell("th", reports.length > 1 ? `${object.name}, ${sideNames()[which]}` : object.name);
      name.scope = "row";
      const swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.color = state.colours.of(i);
      const chooser = document.createElement("button");
      chooser.type = "button";
      chooser.textContent = name.textContent;
      chooser.title = "Show its error, residual and history";
      chooser.setAttribute("aria-pressed", i === state.selected);
      chooser.dataset.object = i;
      chooser.addEventListener("click", () => select(i === state.selected ? null : { object: i, track: null }, which));
      name.replaceChildren(swatch, chooser);
      row.append(name);
      for (const [, keys] of used) {
        const v = value(object, keys);
        row.append(cell("td", v === undefined ? "–" : Number.isInteger(v) ? String(v) : lab.short(v), v === undefined ? undefined : String(v)));
      }
      row.append(cell("td", `${object.filter} ${object.gains ?? ""}`));
      body.append(row);
    }));
    table.replaceChildren(head, body);
    table.parentElement.classList.toggle("lab-table", body.rows.length > 20);
    byId("lab-totals").textContent = reports.map(({ total }, which) =>
      `${sideNames()[which] ? sideNames()[which] + ": " : ""}RMSE ${lab.short(value(total, ["rmse"]))} m, ` +
      `GOSPA ${lab.short(total.gospa)} m, ` +
      `MOTA ${lab.short(value(total, ["mota"]))}, IDF1 ${lab.short(value(total, ["idf1"]))}, ` +
      `${total.id_switches ?? 0} ${total.id_switches === 1 ? "switch" : "switches"} of identity`).join(" · ");
    showHistory();
  }

  // ---- what is selected

  function rowsNow(answer) {
    const now = lab.latest(null, state.time, (i) => answer.scans.get(i, "time"), answer.scans.length);
    if (now < 0) return [];
    const first = answer.scans.get(now, "first");
    return Array.from({ length: answer.scans.get(now, "count") }, (_, i) => first + i);
  }

  /** The track of each side that follows the selected object: now, or most of the time. */
  function choose() {
    state.result.answers.forEach((answer, which) => {
      if (state.selected < 0) {
        if (!answer.paths.has(state.selectedTrack[which])) state.selectedTrack[which] = null;
        if (state.selectedTrack[which] !== null && which === 1) state.selectedTrack[1] = null;
        return;
      }
      const follows = (row) => answer.tracks.get(row, "object") === state.selected;
      const now = rowsNow(answer).find(follows);
      if (now !== undefined) { state.selectedTrack[which] = answer.tracks.get(now, "id"); return; }
      let best = null, most = 0;
      for (const [id, rows] of answer.paths) {
        const count = rows.filter(follows).length;
        if (count > most) [best, most] = [id, count];
      }
      state.selectedTrack[which] = best;
    });
  }

  function select(found, tracker) {
    state.selected = found ? found.object : -1;
    state.selectedTrack = [null, null];
    if (found && found.object < 0) state.selectedTrack[tracker] = found.track;
    choose();
    for (const plot of plots) plot.refresh();
    for (const chooser of document.querySelectorAll("#lab-scores button")) {
      chooser.setAttribute("aria-pressed", Number(chooser.dataset.object) === state.selected);
    }
    showHistory();
    redraw();
    say();
  }

  function showHistory() {
    const section = byId("lab-history");
    const which = state.selectedTrack[0] !== null ? 0 : 1;
    const answer = state.result.answers[which];
    const rows = answer?.paths.get(state.selectedTrack[which]);
    section.hidden = !rows;
    byId("lab-error-caption").textContent = state.selected >= 0 ? `Error of ${objects[state.selected].name} [m]` : "Error of every target [m]";
    byId("lab-residual-caption").textContent = rows ? "Residual in x and y (dotted), and where 95 % should lie [m]" : "Size of every track's residual [m]";
    if (!rows) return;
    const { tracks, scans } = answer;
    const get = (row, field) => tracks.get(row, field);
    const time = (row) => scans.get(get(row, "scan"), "time");
    const confirmed = rows.find((row) => get(row, "status") === 1);
    const hits = rows.filter((row) => !Number.isNaN(get(row, "rx"))).length;
    byId("lab-history-title").textContent = `Track ${state.selectedTrack[which]}` +
      (state.selected >= 0 ? `, which follows ${objects[state.selected].name}` : ", which follows nobody");
    byId("lab-history-summary").textContent = `Begun at ${lab.short(time(rows[0]))} s, ` +
      (confirmed === undefined ? "never confirmed, " : `confirmed at ${lab.short(time(confirmed))} s, `) +
      `${hits} detections in ${rows.length} scans, filter ${state.result.words[get(rows.at(-1), "filter")]}.`;
    const head = document.createElement("thead"), body = document.createElement("tbody");
    const headings = document.createElement("tr");
    const fields = [["t [s]", (r) => time(r)], ["status", (r) => lab.statuses[get(r, "status")]],
      ["x [m]", (r) => get(r, "x")], ["y [m]", (r) => get(r, "y")], ["vx [m/s]", (r) => get(r, "vx")], ["vy [m/s]", (r) => get(r, "vy")],
      ["residual x [m]", (r) => get(r, "rx")], ["residual y [m]", (r) => get(r, "ry")], ["σx [m]", (r) => get(r, "sigma_x")],
      ["NIS", (r) => get(r, "nis")], ["real", (r) => get(r, "existence")]];
    headings.append(...fields.map(([name]) => cell("th", name)));
    head.append(headings);
    for (const row of rows) {
      const line = document.createElement("tr");
      line.dataset.time = time(row);
      for (const [, read] of fields) {
        const v = read(row);
        line.append(cell("td", typeof v === "string" ? v : Number.isNaN(v) ? "–" : lab.short(v), String(v)));
      }
      body.append(line);
    }
    byId("lab-history-table").replaceChildren(head, body);
    markHistory();
  }

  function markHistory() {
    const body = byId("lab-history-table").tBodies[0];
    if (byId("lab-history").hidden || !body) return;
    const now = lab.latest(null, state.time, (i) => Number(body.rows[i].dataset.time), body.rows.length);
    body.querySelector(".now")?.classList.remove("now");
    if (now >= 0) body.rows[now].classList.add("now");
  }

  // ---- time and drawing

  function redraw() {
    if (isDrawn === "due") return;
    isDrawn = "due";
    requestAnimationFrame(draw);
  }

  lab.draw = draw;
  function draw() {
    isDrawn = true;
    if (isStale) compute();
    if (!state.result) return;
    const both = state.result.answers.length === 2;
    byId("lab-views").dataset.count = both ? 2 : 1;
    byId("lab-view-1").parentElement.hidden = !both;
    views.forEach((view) => view.shape());
    const names = sideNames();
    const filters = controls.trackers.map((tracker) => Object.entries(tracker.filters)
      .map(([name, filter]) => Object.keys(tracker.filters).length === 1 ? Object.keys(filter)[0] : `${name} ${Object.keys(filter)[0]}`).join(", ") || "default filter");
    state.result.answers.forEach((_, i) => {
      byId(`lab-caption-${i}`).textContent = both ? `${names[i]}: ${filters[i]}` : filters[i];
      views[i].draw();
    });
    for (const plot of plots) plot.draw();
    byId("lab-time").value = state.time;
    byId("lab-time").setAttribute("aria-valuetext", `${state.time.toFixed(2)} seconds`);
    byId("lab-clock").textContent = `${state.time.toFixed(2)} / ${lab.short(state.duration)} s`;
    byId("lab-command").textContent = controls.trackers.map((_, i) => controls.command(i)).join("\n");
    if (!state.isPlaying) markHistory();
  }

  /** For those who do not see the picture. */
  function say() {
    if (state.isPlaying || !state.result) return;
    const there = objects.filter((_, i) => state.truth.at(i, state.time)).length;
    const texts = state.result.answers.map((answer, which) => {
      const rows = rowsNow(answer).filter((row) => answer.tracks.get(row, "status") > 0);
      const followed = new Set(rows.map((row) => answer.tracks.get(row, "object")).filter((object) => object >= 0));
      const name = sideNames()[which];
      return `${name ? name + ": " : ""}${rows.length} tracks follow ${followed.size} of them`;
    });
    byId("lab-said").textContent = `At ${state.time.toFixed(2)} s there are ${there} targets; ${texts.join("; ")}.`;
  }

  function play(isPlaying) {
    if (isPlaying && state.time >= state.duration) state.time = 0;
    state.isPlaying = isPlaying;
    byId("lab-play").textContent = isPlaying ? "Pause" : "Play";
    let before = performance.now();
    const go = (now) => {
      if (!state.isPlaying) return;
      state.time = Math.min(state.duration, state.time + (now - before) / 1000 * state.speed);
      before = now;
      if (state.time >= state.duration) play(false);
      redraw();
      requestAnimationFrame(go);
    };
    if (isPlaying) requestAnimationFrame(go); else { redraw(); say(); }
  }

  function stepBy(direction) {
    play(false);
    const { scans } = state.result;
    const now = lab.latest(null, state.time, (i) => scans.get(i, "time"), scans.length);
    const time = scans.get(Math.max(0, now), "time");
    let next = now;
    while (next + direction >= 0 && next + direction < scans.length && Math.abs(scans.get(next, "time") - time) < 1e-9) next += direction;
    if (next >= 0) state.seek(scans.get(next, "time"));
  }

  // ---- what people do

  const on = (id, event, action) => byId(id).addEventListener(event, action);
  on("lab-play", "click", () => play(!state.isPlaying));
  on("lab-back", "click", () => stepBy(-1));
  on("lab-forth", "click", () => stepBy(1));
  byId("lab-time").max = scene.duration;
  on("lab-time", "input", (event) => { play(false); state.seek(Number(event.target.value)); });
  on("lab-speed", "change", (event) => { state.speed = Number(event.target.value); });
  on("lab-nearer", "click", () => { state.camera.magnify(1.4); redraw(); });
  on("lab-farther", "click", () => { state.camera.magnify(1 / 1.4); redraw(); });
  const fit = () => { state.camera.fit(); state.followed(); redraw(); };
  on("lab-fit", "click", fit);
  objects.forEach((object, i) => byId("lab-follow").append(lab.option(i, object.name)));
  on("lab-follow", "change", (event) => {
    state.camera.follow = Number(event.target.value);
    if (state.camera.follow >= 0 && state.camera.zoom < 4) {
      const { span } = state.camera;
      state.camera.zoom = Math.max(1, Math.max(...span) / 40);
    }
    redraw();
  });
  // As in a video: an eighth of the scene.
  byId("lab-trail").value = [...byId("lab-trail").options].map((option) => option.value)
    .find((value) => Number(value) >= Math.max(3, scene.duration / 8));
  state.trail = Math.min(Number(byId("lab-trail").value), 1e9);
  on("lab-trail", "change", (event) => { state.trail = Math.min(Number(event.target.value), 1e9); redraw(); });
  for (const name of Object.keys(layers)) {
    const label = document.createElement("label"), box = document.createElement("input");
    Object.assign(box, { type: "checkbox", checked: layers[name] });
    box.dataset.layer = name;
    box.addEventListener("change", () => { layers[name] = box.checked; redraw(); });
    label.append(box, name);
    byId("lab-layers").append(label);
  }
  if (scene.sensors.length > 1) {
    const marks = ["×", "◇", "+"];
    byId("lab-marks").textContent = scene.sensors.map((sensor, i) => `${marks[i % 3]} ${sensor.name}`).join(", ") + "; red: false";
  }
  document.addEventListener("keydown", (event) => {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (target.matches("input:not([type=checkbox]), select, textarea")) return;
    if (event.key === " " && target.matches("button, input, summary")) return;
    const actions = { " ": () => play(!state.isPlaying), ",": () => stepBy(-1), ".": () => stepBy(1), "0": fit,
      "+": () => byId("lab-nearer").click(), "-": () => byId("lab-farther").click(),
      Home: () => state.seek(0), End: () => state.seek(state.duration) };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    state.colours.refresh();
    for (const plot of plots) plot.refresh();
    redraw();
  });
  new ResizeObserver(() => { for (const plot of plots) if (state.result) plot.refresh(); redraw(); }).observe(byId("lab-views"));

  const regimes = new Map();
  for (const { regime } of objects) regimes.set(regime, (regimes.get(regime) ?? 0) + 1);
  byId("lab-summary").textContent = `${[...regimes].map(([regime, n]) => `${n} ${regime}${n > 1 ? "s" : ""}`).join(", ")}; ` +
    `${scene.sensors.map((sensor) => `${sensor.name} at ${lab.short(sensor.rate)} Hz`).join(", ")}; ${lab.short(scene.duration)} s. ` +
    "Everything is computed here, by the same code as the program's.";
  state.time = Math.min(scene.duration, 0.35 * scene.duration);
  compute();
  redraw();
  say();
})();
