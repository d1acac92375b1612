"use strict";
// A series of measurements, its filters, and sliders for every number that they have.
(async () => {
  const { byId } = lab;
  const { series: original, command, palette } = JSON.parse(byId("lab-scene").textContent);
  let engine;
  try {
    engine = new lab.Engine(await WebAssembly.compile(lab.bytesOf("lab-wasm")));
  } catch (error) {
    byId("lab-failure").hidden = false;
    byId("lab-failure").textContent = `The filters cannot run in this browser: ${error.message}`;
    return;
  }
  byId("lab-live").hidden = false;

  let series = lab.copy(original);
  let chosen = series.filters.length - 1;
  let isDue = false;
  const state = lab.state = { time: 0, duration: 1, colours: new lab.Palette(palette), seek(time) { state.time = time; draw(); } };

  const points = (track, column) => track.t.map((t, i) => [t, track[column][i] ?? NaN]);
  const valueCurves = () => {
    const { tracks, ring, is_of_readings: isOfReadings } = state.result;
    // Not across the whole ring where its ends meet.
    const path = (track, column) => points(track, column).flatMap((point, i, all) =>
      ring && i > 0 && Math.abs(point[1] - all[i - 1][1]) > ring / 2 ? [[point[0], NaN], point] : [point]);
    return [{ colour: state.colours.text, dash: [6, 5], points: path(tracks[0], "truth") },
      ...tracks.map((track, i) => ({ colour: state.colours.of(i), width: i === chosen ? 3 : 1.5, points: path(track, "x") })),
      ...isOfReadings ? [] : [{ colour: state.colours.muted, dots: true, points: points(tracks[0], "z") }]];
  };
  const plots = lab.plots = [
    new lab.Plot(byId("lab-values"), state, { xUnit: "", curves: valueCurves }),
    new lab.Plot(byId("lab-residuals"), state, { xUnit: "", around: true, curves: () => [{ colour: state.colours.of(chosen), points: points(state.result.tracks[chosen], "residual") }] }),
  ];

  function redraw() {
    if (isDue) return;
    isDue = true;
    requestAnimationFrame(compute);
  }

  function compute() {
    isDue = false;
    byId("lab-problem").textContent = "";
    try {
      state.result = engine.runSeries(JSON.stringify(series));
    } catch (error) {
      byId("lab-problem").textContent = error.message;
      return;
    }
    state.duration = state.result.tracks[0].t.at(-1);
    draw();
    const rows = state.result.tracks.map((track, i) => {
      const row = document.createElement("tr");
      const swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.color = state.colours.of(i);
      const name = document.createElement("th");
      name.scope = "row";
      name.append(swatch, track.filter);
      row.append(name);
      for (const v of [track.gains, track.rmse, track.mai]) {
        const cell = document.createElement("td");
        cell.textContent = typeof v === "number" ? lab.short(v) : v ?? "–";
        cell.title = String(v ?? "");
        row.append(cell);
      }
      return row;
    });
    const head = document.createElement("tr");
    for (const text of ["filter", "gains", "error (RMSE)", "mean |residual|"]) {
      const cell = document.createElement("th");
      cell.scope = "col";
      cell.textContent = text;
      head.append(cell);
    }
    const thead = document.createElement("thead"), body = document.createElement("tbody");
    thead.append(head);
    body.append(...rows);
    byId("lab-scores").replaceChildren(thead, body);
    const mine = state.result.tracks[chosen];
    byId("lab-said").textContent = `${mine.t.length} measurements; ${mine.filter}: ` +
      (mine.rmse === null ? "" : `error ${lab.short(mine.rmse)}, raw ${lab.short(state.result.measurement_rmse)}.`);
    byId("lab-command").textContent = commandLine();
  }

  function draw() {
    byId("lab-values-caption").textContent = `${series.plot.y_label} over ${series.plot.x_label}: truth dashed, ${state.result.is_of_readings ? "" : "measurements as dots, "}estimates as lines`;
    for (const plot of plots) plot.refresh();
  }

  const dataKey = ["generate", "given"].find((key) => original[key]) ?? "";

  function commandLine() {
    const changes = [];
    const compare = (path, now, before) => {
      for (const [key, value] of Object.entries(now)) {
        if (!lab.same(value, before[key])) changes.push(`--set '${path}.${key}=${lab.flow(value)}'`);
      }
    };
    series.filters.forEach((filter, i) => compare(`filters[${i}]`, filter, original.filters[i]));
    if (dataKey) compare(dataKey, series[dataKey], original[dataKey]);
    return [command, ...changes].join(" ");
  }

  const span = () => {
    const { z } = state.result.tracks[0];
    return [Math.min(...z), Math.max(...z)];
  };

  const meanings = { sigma: "1 sigma that it assumes", noise: "1 sigma", rate: "of the truth, a step",
    acceleration: "of the truth", start: "of the truth", accuracy: "that it believes the sensor to have",
    cells: "places that there are", movement: "places a step" };
  const whole = new Set(["cells", "movement", "n", "order"]);

  /** Whether a number of a filter makes a difference to what it says. */
  function matters({ filter, k, order, map }, key) {
    if (filter === "discrete-bayes") return [...map?.length > 0 ? ["accuracy"] : ["cells", "noise"], "movement"].includes(key);
    if (key === "sigma" || key === "initial_speed") return /kalman/.test(filter);
    return key !== "ddx0" || k !== undefined || order === 2 || filter === "kalman-ca";
  }

  function sliders(target, keys, prefix) {
    const [low, high] = span(), reach = Math.max(1, high - low);
    return keys.filter((key) => typeof target[key] === "number").map((key) => {
      const value = target[key];
      const rate = 5 * reach / state.result.tracks[0].t.length;
      const range = { g: [0, 2, "fine"], h: [0, 2, "fine"], k: [0, 1, "fine"], theta: [0, 0.999, "even"],
        x0: [low - reach, high + reach, "even"], dx0: [-rate, rate, "even"], ddx0: [-rate, rate, "even"],
        noise: [0, Math.max(1, 4 * value), "fine"], rate: [-rate, rate, "even"], acceleration: [-30, 30, "even"],
        start: [low - reach, high + reach, "even"], accuracy: [0.01, 0.99, "even"], movement: [-3, 3, "even"] }[key] ?? [Math.abs(value || 1) / 50, Math.abs(value || 1) * 50, "factors"];
      return lab.slider({ id: `lab-${prefix}-${key}`, label: lab.spoken(key), meaning: meanings[key] ?? "", unit: "",
        low: Math.min(range[0], value), high: Math.max(range[1], value), scale: range[2], value, whole: whole.has(key),
        onInput: (v) => { target[key] = v; redraw(); } });
    });
  }

  function show() {
    byId("lab-filters").replaceChildren(...series.filters.map((filter, i) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = filter.name;
      button.setAttribute("aria-pressed", i === chosen);
      button.addEventListener("click", () => { chosen = i; show(); redraw(); });
      return button;
    }));
    const filter = series.filters[chosen];
    const keys = [...new Set(["x0", "dx0", "ddx0", ...Object.keys(filter)])].filter((key) => matters(filter, key));
    byId("lab-filter-sliders").replaceChildren(...sliders(filter, keys, "filter"));
    byId("lab-data").hidden = dataKey !== "generate";
    if (dataKey === "generate") {
      byId("lab-data-sliders").replaceChildren(...sliders(series.generate, ["noise", "rate", "acceleration", "start"], "data"));
    }
  }

  byId("lab-controls").addEventListener("submit", (event) => event.preventDefault());
  byId("lab-reset").addEventListener("click", () => { series = lab.copy(original); show(); redraw(); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { state.colours.refresh(); redraw(); });
  new ResizeObserver(() => { if (state.result) draw(); }).observe(byId("lab-values"));
  byId("lab-summary").textContent = `${series.filters.length} filters on the same measurements. Everything is computed here, by the same code as the program's.`;
  compute();
  if (state.result) show();
})();
