"use strict";
// Sliders in, picture and figures out. Every number shown comes from the C++ filter (exports.cpp).
(async () => {
  const byId = (id) => document.getElementById(id);
  const form = byId("playground-form");
  const plot = byId("playground-plot");
  const rows = byId("playground-rows");
  const sliders = [...form.querySelectorAll("input[type=range]")];
  const presets = [...form.querySelectorAll("button[data-values]")];
  // The textbook's series 5 + 5 i with 100 points; seed 7 is that of scenes/textbook/interactive.yaml.
  const bookSeries = { points: 100, start: 5, rate: 5, acceleration: 0 };
  const seed = 7;
  const largestDrawn = 1e30;  // SVG counts in single precision
  const columns = ["truth", "z", "x_pred", "residual", "x", "dx"];
  let series = bookSeries;
  const tableDelay = 120;  // [ms]; laying out a table takes longer than a frame, so it waits for rest
  let tableIsDue;
  let filter;

  const fixed = (value, digits) =>
    Math.abs(value) >= 1e7 ? value.toExponential(3) : value.toFixed(digits).replace(/^-(?=[0.]+$)/, "");
  const short = (value) =>
    Math.abs(value) >= 1e6 ? value.toExponential(2) : String(Number(value.toPrecision(3)));

  function settings() {
    const values = { ...series };
    for (const slider of sliders) values[slider.name] = Number(slider.value);
    return values;
  }

  function textAt(address) {
    const bytes = new Uint8Array(filter.memory.buffer, address);
    return String.fromCharCode(...bytes.subarray(0, bytes.indexOf(0)));
  }

  function run(s) {
    filter.run(seed, s.points, s.start, s.rate, s.acceleration, s.noise, s.x0, s.dx0, s.g, s.h, s.k);
    const answer = {};
    for (const name of columns) {
      answer[name] = Array.from(new Float64Array(filter.memory.buffer, filter[name](), s.points));
    }
    return answer;
  }

  function element(name, attributes, text) {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (text !== undefined) node.textContent = text;
    return node;
  }

  function ticks(low, high, count) {
    const least = (high - low) / count;
    const power = 10 ** Math.floor(Math.log10(least));
    const step = power * [1, 2, 5, 10].find((factor) => factor * power >= least * (1 - 1e-9));
    const all = [];
    for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) {
      all.push(Number((n * step).toPrecision(12)));
    }
    return all;
  }

  /** The data fill the picture; a filter that strays shows as far as half their height beyond. */
  function verticalRange(answer) {
    let low = Math.min(...answer.truth, ...answer.z);
    let high = Math.max(...answer.truth, ...answer.z);
    const reach = 0.5 * (high - low) || 1;
    const [floor, ceiling] = [low - reach, high + reach];
    for (const x of answer.x) {
      low = Math.min(low, Math.max(x, floor));
      high = Math.max(high, Math.min(x, ceiling));
    }
    const margin = 0.04 * (high - low) || 1;
    return [low - margin, high + margin];
  }

  function draw(answer, points) {
    const [width, height] = [plot.clientWidth || 800, plot.clientHeight || 400];
    const [left, top, right, bottom] = [52, 10, width - 10, height - 36];
    const [low, high] = verticalRange(answer);
    const last = points + 1;
    const sx = (right - left) / last;
    const sy = (bottom - top) / (low - high);
    const x = (step) => left + sx * step;
    const y = (value) => top + sy * (value - high);
    plot.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const picture = [];
    for (const value of ticks(low, high, Math.max(3, height / 60))) {
      picture.push(element("path", { class: "grid", d: `M${left},${y(value)}H${right}` }));
      picture.push(element("text", { x: left - 7, y: y(value) + 4, "text-anchor": "end" }, short(value)));
    }
    for (const step of ticks(0, last, Math.max(4, width / 110))) {
      picture.push(element("path", { class: "grid", d: `M${x(step)},${top}V${bottom}` }));
      picture.push(element("text", { x: x(step), y: bottom + 16, "text-anchor": "middle" }, short(step)));
    }
    picture.push(element("text", { x: right, y: bottom + 31, "text-anchor": "end" }, "step"));
    picture.push(element("rect", {
      class: "frame", x: left, y: top, width: right - left, height: bottom - top }));
    const window_ = element("clipPath", { id: "playground-window" });
    window_.append(element("rect", { x: left, y: top, width: right - left, height: bottom - top }));
    picture.push(window_);

    // Curves keep the numbers themselves as coordinates; one transformation puts them into place.
    const world = element("g", {
      transform: `matrix(${sx} 0 0 ${sy} ${left} ${top - sy * high})` });
    const clipped = element("g", { "clip-path": "url(#playground-window)" });
    clipped.append(world);
    const drawn = (values) => values.map((value, i) => [i + 1, value])
      .filter(([, value]) => Math.abs(value) < largestDrawn);
    const curve = (name) => element("polyline", {
      class: name, "vector-effect": "non-scaling-stroke",
      points: drawn(answer[name]).map((point) => point.join()).join(" ") });
    world.append(curve("truth"));
    world.append(element("path", {
      class: "z", "vector-effect": "non-scaling-stroke",
      d: drawn(answer.z).map((point) => `M${point.join()}h0`).join("") }));
    world.append(curve("x"));
    picture.push(clipped);
    plot.replaceChildren(...plot.querySelectorAll(":scope > title, :scope > desc"), ...picture);
  }

  function show(id, text, aside = "") {
    const node = byId(id);
    node.textContent = text;
    if (aside === "") return;
    const small = document.createElement("small");
    small.textContent = ` ${aside}`;
    node.append(small);
  }

  /** @returns {string} the verdict in one sentence */
  function analyse(s) {
    const broken = filter.violated();
    const order = s.k > 0 ? 2 : 1;
    const damping = { under: "under-damped: it rings", critical: "critically damped",
      over: "over-damped", alternating: "alternating: the error changes sign at each step" };
    show("figure-damping", textAt(filter.damping()), `ratio ${short(filter.damping_ratio())}`);
    show("figure-lag-label", `Lag behind ${order === 2 ? "a jerk" : "an acceleration"} of 1`);
    show("figure-rmse", short(filter.rmse()));
    show("figure-raw", short(filter.measurement_rmse()));
    show("figure-mai", short(filter.mai()));
    if (broken !== 0) {
      for (const id of ["settling", "noise", "vrf", "lag"]) show(`figure-${id}`, "–");
      const why = s.h === 0 ? ": the rate is never corrected" : "";
      return [false, `Not stable: ${textAt(broken)} does not hold${why}.`];
    }
    const vrf = filter.vrf_x();
    show("figure-settling", `${short(filter.settling_updates())} steps`);
    show("figure-noise", `${fixed(100 * Math.sqrt(vrf), 1)} % of σ`);
    show("figure-vrf", short(vrf), `prediction ${short(filter.vrf_prediction())}`);
    show("figure-lag", short(filter.lag_x()), `prediction ${short(filter.lag_prediction())}`);
    const expected = filter.predicted_rmse(s.noise, order === 2 ? 0 : s.acceleration);
    return [true, `Stable, ${damping[textAt(filter.damping())]}. ` +
      `Once settled, theory expects an RMSE of ${short(expected)}.`];
  }

  function tabulate(answer, s) {
    while (rows.rows.length > s.points) rows.deleteRow(-1);
    while (rows.rows.length < s.points) {
      const row = rows.insertRow();
      for (let i = 0; i <= columns.length; ++i) row.insertCell().append("");
    }
    for (let i = 0; i < s.points; ++i) {
      const cells = rows.rows[i].cells;
      cells[0].firstChild.data = i + 1;
      columns.forEach((name, c) => { cells[c + 1].firstChild.data = fixed(answer[name][i], 3); });
    }
  }

  function tellCommand(answer, s) {
    const kind = s.k > 0 ? `ghk --g ${s.g} --h ${s.h} --k ${s.k}` : `gh --g ${s.g} --h ${s.h}`;
    show("playground-command",
      `ghtrack filter measurements.csv --filter ${kind} --x0 ${s.x0} --dx0 ${s.dx0}`);
    const lines = answer.z.map((z, i) => `${z},${answer.truth[i]}`);
    byId("playground-download").href =
      "data:text/csv," + encodeURIComponent(["z,truth", ...lines, ""].join("\n"));
  }

  function describe(s) {
    const curved = s.acceleration === 0 ? "" : ` + ${s.acceleration / 2} i²`;
    const moving = s.rate === 0 ? "" : ` + ${s.rate} i`;
    show("playground-series", `truth ${s.start}${moving}${curved}`);
  }

  function refresh() {
    const s = settings();
    const answer = run(s);
    draw(answer, s.points);
    tellCommand(answer, s);
    describe(s);
    clearTimeout(tableIsDue);
    tableIsDue = setTimeout(() => tabulate(answer, s), rows.rows.length === 0 ? 0 : tableDelay);
    const [stable, verdict] = analyse(s);
    const output = byId("playground-verdict");
    output.className = stable ? "stable" : "unstable";
    output.textContent = verdict;
    byId("playground-plot-description").textContent = `${s.points} measurements with noise ${s.noise}. ` +
      `${verdict} RMSE of the estimates ${short(filter.rmse())}, of the measurements ` +
      `${short(filter.measurement_rmse())}.`;
    for (const slider of sliders) byId(`${slider.id}-value`).value = slider.value;
  }

  function choose(preset) {
    const values = JSON.parse(preset.dataset.values);
    for (const slider of sliders) slider.value = values[slider.name] ?? slider.defaultValue;
    series = Object.fromEntries(
      Object.entries(bookSeries).map(([name, value]) => [name, values[name] ?? value]));
    press(preset);
    refresh();
  }

  function press(pressed) {
    for (const preset of presets) preset.setAttribute("aria-pressed", preset === pressed);
  }

  try {
    const bytes = Uint8Array.from(atob(byId("playground-wasm").textContent), (c) => c.charCodeAt(0));
    filter = (await WebAssembly.instantiate(bytes, {})).instance.exports;
    filter._initialize();
  } catch (error) {
    byId("playground-failure").hidden = false;
    show("playground-failure", `The filter cannot run in this browser: ${error.message}`);
    return;
  }
  byId("playground-live").hidden = false;
  form.addEventListener("input", () => { press(null); refresh(); });
  form.addEventListener("submit", (event) => event.preventDefault());
  for (const preset of presets) preset.addEventListener("click", () => choose(preset));
  new ResizeObserver(refresh).observe(plot);
  choose(presets[0]);
})();
